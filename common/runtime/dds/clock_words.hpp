// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/hash.hpp"
#include "common/runtime/dds/clock_run.hpp"

// What the clock says of a run on standard output, as text (docs/reference/run-control.md names the lines).
namespace rodeira::dds {

// "waiting for NAMES" before the first grant, "progress …" behind it.
std::string ProgressLine(const ClockRun& run);
// A line a node, each with its line break.
std::string NodeLines(const ClockRun& run);
// The last line: `how` is ok or aborted.
std::string EndLine(const ClockRun& run, const char* how, lockstep::Step last_step, base::Digest digest, int status);

}  // namespace rodeira::dds
