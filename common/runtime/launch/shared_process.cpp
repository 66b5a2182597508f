// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/shared_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace rodeira::launch {
namespace {

using lockstep::NodeIndex;

std::string HostText(const LaunchNode& node) {
  return node.host.empty() ? "the clock's host" : fmt::format("host '{}'", node.host);
}

void CheckMember(const config::Map& map, const LaunchNode& node, const LaunchNode& first) {
  if (node.host != first.host)
    map.Problem("process", "launch.process_on_two_hosts",
                fmt::format("process '{}' has node '{}' on {} and node '{}' on {}; one host was expected", node.process,
                            first.name, HostText(first), node.name, HostText(node)));
  if (node.is_external() && node.kind->library.empty())
    map.Problem("process", "launch.process_without_library",
                fmt::format("node '{}' shares process '{}' but is a program of its own; its shared object was expected "
                            "as 'library'",
                            node.name, node.process));
}

}  // namespace

std::vector<NodeProcess> ProcessesOf(const Launch& launch) {
  std::vector<NodeProcess> processes;
  for (NodeIndex n = 0; n < launch.nodes().size(); ++n) {
    const std::string& name = launch.node(n).process;
    const auto known = std::ranges::find(processes, name, &NodeProcess::name);
    if (name.empty() || known == processes.end())
      processes.push_back({name, {n}});
    else
      known->nodes.push_back(n);
  }
  return processes;
}

std::vector<NodeIndex> NodesOfProcess(const Launch& launch, std::string_view name) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex n = 0; n < launch.nodes().size(); ++n) {
    if (!name.empty() && launch.node(n).process == name) nodes.push_back(n);
  }
  return nodes;
}

std::vector<NodeIndex> NodesBeside(const Launch& launch, NodeIndex node) {
  const std::string& name = launch.node(node).process;
  return name.empty() ? std::vector<NodeIndex>{node} : NodesOfProcess(launch, name);
}

void SettleProcesses(const std::vector<config::Map>& maps, std::vector<LaunchNode>& nodes) {
  const auto is_stricter = [](const LaunchNode& a, const LaunchNode& b) { return a.recovery < b.recovery; };
  std::vector<lockstep::Policy> settled;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    settled.push_back(nodes[n].recovery);
    if (nodes[n].process.empty()) continue;
    std::vector<LaunchNode> beside;
    std::ranges::copy_if(nodes, std::back_inserter(beside),
                         [&](const LaunchNode& other) { return other.process == nodes[n].process; });
    CheckMember(maps[n], nodes[n], beside.front());
    const LaunchNode& strictest = *std::ranges::min_element(beside, is_stricter);
    settled.back() = strictest.recovery;
    if (maps[n].Has("recovery") && nodes[n].recovery != strictest.recovery)
      maps[n].Problem(
          "recovery", "launch.process_with_two_policies",
          fmt::format("node '{}' shares process '{}' with node '{}' of another 'recovery', and all are lost "
                      "together; one for both was expected",
                      nodes[n].name, nodes[n].process, strictest.name));
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n].recovery = settled[n];
}

}  // namespace rodeira::launch
