// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/runtime/launch/shared_process.hpp"

namespace rodeira::launch {

// The part of a run on one PC.
struct RunOnOnePc {
  std::vector<lockstep::NodeIndex> nodes;
  bool has_clock = true;
  unsigned processors = 1;
};

// Nodes that can share processes where there are more processes than processors; empty where there are not, or no two
// nodes can. Stepped nodes share one process; servers, then sinks, join until there are no more processes than
// processors. Left as they are: windows, nodes that a person drives, external nodes without a shared object, and nodes
// with a `process` already. Nodes of different hosts or with different recovery policies never share one.
std::vector<NodeProcess> ProposeProcesses(const Launch& launch, const RunOnOnePc& pc);

// "6 processes run on 2 processors; ...", with a line for each node as the launch file has it; empty where there is no
// proposal.
std::string ProposalText(const Launch& launch, const RunOnOnePc& pc);

}  // namespace rodeira::launch
