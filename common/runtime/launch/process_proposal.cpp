// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/process_proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace rodeira::launch {
namespace {

using lockstep::NodeIndex;

// Nodes of one process.
using Unit = std::vector<NodeIndex>;
// Units of one host and one policy. The second joins the first, again and again.
using Bucket = std::vector<Unit>;

bool CanShare(const LaunchNode& node) {
  return node.process.empty() && node.kind->name != "view" && !node.is_live() &&
         !(node.is_external() && node.kind->library.empty());
}

// Stepped nodes join first. A recorder joins last: a crash of another node takes it along.
enum class Rank { kStepped, kServer, kSink };
Rank RankOf(const lockstep::RosterNode& node) {
  if (node.role == lockstep::Role::kService) return Rank::kServer;
  return node.is_sink() ? Rank::kSink : Rank::kStepped;
}

std::size_t ProcessesBefore(const Launch& launch, const RunOnOnePc& pc) {
  std::size_t alone = 0;
  std::set<std::string> shared;
  for (const NodeIndex n : pc.nodes) {
    const std::string& process = launch.node(n).process;
    if (process.empty())
      ++alone;
    else
      shared.insert(process);
  }
  return alone + shared.size() + (pc.has_clock ? 1 : 0);
}

std::vector<Bucket> BucketsOf(const Launch& launch, const RunOnOnePc& pc) {
  std::map<std::pair<std::string, lockstep::Policy>, Bucket> buckets;
  for (const Rank rank : {Rank::kStepped, Rank::kServer, Rank::kSink}) {
    for (const NodeIndex n : pc.nodes) {
      const LaunchNode& node = launch.node(n);
      if (!CanShare(node) || RankOf(launch.roster().node(n)) != rank) continue;
      Bucket& bucket = buckets[{node.host, node.recovery}];
      if (rank == Rank::kStepped && !bucket.empty())
        bucket.front().push_back(n);
      else
        bucket.push_back({n});
    }
  }
  std::vector<Bucket> all;
  for (auto& [key, bucket] : buckets) all.push_back(std::move(bucket));
  return all;
}

std::size_t ProcessesOf(const std::vector<Bucket>& buckets, std::size_t others) {
  for (const Bucket& bucket : buckets) others += bucket.size();
  return others;
}

std::string FreeName(const Launch& launch, std::size_t number) {
  std::string name = number == 0 ? "shared" : fmt::format("shared{}", number + 1);
  while (!NodesOfProcess(launch, name).empty()) name += "_";
  return name;
}

}  // namespace

std::vector<NodeProcess> ProposeProcesses(const Launch& launch, const RunOnOnePc& pc) {
  const std::size_t before = ProcessesBefore(launch, pc);
  if (before <= pc.processors) return {};
  std::size_t others = before;
  for (const NodeIndex n : pc.nodes) others -= std::size_t{CanShare(launch.node(n))};
  std::vector<Bucket> buckets = BucketsOf(launch, pc);
  while (ProcessesOf(buckets, others) > pc.processors) {
    const auto most = std::ranges::max_element(buckets, {}, &Bucket::size);
    if (most == buckets.end() || most->size() < 2) break;
    Unit& first = most->front();
    const Unit& second = *(most->begin() + 1);
    first.insert(first.end(), second.begin(), second.end());
    most->erase(most->begin() + 1);
  }
  std::vector<NodeProcess> proposed;
  for (const Bucket& bucket : buckets) {
    for (const Unit& unit : bucket) {
      if (unit.size() < 2) continue;
      proposed.push_back({FreeName(launch, proposed.size()), unit});
      std::ranges::sort(proposed.back().nodes);
    }
  }
  return proposed;
}

std::string ProposalText(const Launch& launch, const RunOnOnePc& pc) {
  const std::vector<NodeProcess> proposed = ProposeProcesses(launch, pc);
  if (proposed.empty()) return {};
  std::string text = fmt::format(
      "{} processes run on {} processor{}; nodes that share a process take less time. In the launch file:\n  nodes:\n",
      ProcessesBefore(launch, pc), pc.processors, pc.processors == 1 ? "" : "s");
  for (const NodeProcess& process : proposed) {
    for (const NodeIndex n : process.nodes)
      fmt::format_to(std::back_inserter(text), "    {}: {{process: {}}}\n", launch.node(n).name, process.name);
  }
  text.pop_back();
  return text;
}

}  // namespace rodeira::launch
