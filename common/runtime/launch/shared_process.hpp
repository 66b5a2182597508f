// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// One process of a run: a node by itself, or the nodes of one `process`, each on a thread of its own.
struct NodeProcess {
  std::string name;                        // the key `process`; empty: a node by itself
  std::vector<lockstep::NodeIndex> nodes;  // ascending, at least one

  bool is_shared() const { return !name.empty(); }
};

// All processes but the clock's, in the order of their first nodes.
std::vector<NodeProcess> ProcessesOf(const Launch& launch);
// The nodes of the shared process `name`, ascending; empty if there is none.
std::vector<lockstep::NodeIndex> NodesOfProcess(const Launch& launch, std::string_view name);
// The nodes of the node's process, ascending, itself included.
std::vector<lockstep::NodeIndex> NodesBeside(const Launch& launch, lockstep::NodeIndex node);

// Adds a problem to the file for each process on two hosts, each external node without a shared object in a shared
// process, and each node with a `recovery` of its own beside another one. Then gives all nodes of a process one policy:
// the first of stop, pause, restart that one of them has. `maps`: one for each node.
void SettleProcesses(const std::vector<config::Map>& maps, std::vector<LaunchNode>& nodes);

}  // namespace rodeira::launch
