// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// A run with a process for each part: starts them, shows what the clock says, hands on what the operator asks for,
// tells the clock which died, restarts those that the clock calls for, and ends them all. The exit status of the
// program comes back.
int RunProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
                 launch::Overrides overrides);

}  // namespace rodeira::cli
