// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// Where the recording goes: --record, else the launch file's own, else a dated file in the user's data folder. A
// recorder that the launch file does not have is added; --no-record takes those away that it has. On a PC of a
// laboratory only its own recorder counts, and none is added: all PCs must agree on what takes part. What is decided is
// written into options.record and the overrides.
base::Status ResolveRecording(const launch::Launch& launch, const Placement& placement, RunOptions& options,
                              launch::Overrides& overrides);

// The name, or name2, name3 …: what no node of the launch file is called.
std::string FreeName(const launch::Launch& launch, const std::string& name);

// A new name among the user's recordings: NAME-DATE-TIME-PROCESS.mcap, distinct for runs that start in one second.
std::string DatedRecording(const std::string& launch_name);

}  // namespace rodeira::cli
