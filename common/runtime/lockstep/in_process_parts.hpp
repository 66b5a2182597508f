// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/runner.hpp"

// What both ways of running nodes in one process share.
namespace rodeira::lockstep {

// Services take no part in the lockstep: for the clock they are ready and finished from the start.
void ReportServices(const Roster& roster, Clock& clock);
// By source: the nodes that are wired to it.
std::vector<std::vector<NodeIndex>> ConsumersOf(const Roster& roster);
// What of the run's settings is this node's.
Runner::Settings RunnerSettings(const InProcessSettings& settings, NodeIndex node);
// `fault`: why the run is not ok; empty: it is, if all nodes have finished and the clock has not aborted it.
RunOutcome OutcomeOf(const Clock& clock, const std::string& fault);

}  // namespace rodeira::lockstep
