// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// `rodeira run --in-process`: the same nodes, runner and mailboxes, one thread a node, no DDS. The digests equal those
// of separate processes.
int RunInProcess(const RunOptions& options, const launch::Launch& launch);

}  // namespace rodeira::cli
