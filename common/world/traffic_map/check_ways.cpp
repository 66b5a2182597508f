// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/world/traffic_map/check_rules.hpp"
#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic_map {
namespace {

using Ways = std::vector<std::vector<std::size_t>>;  // a lane: the lanes next to it

// Which lanes are reached from those given, along the ways.
std::vector<bool> Reach(std::vector<std::size_t> open, const Ways& ways) {
  std::vector<bool> reached(ways.size(), false);
  for (const std::size_t lane : open) reached[lane] = true;
  while (!open.empty()) {
    const std::size_t lane = open.back();
    open.pop_back();
    for (const std::size_t next : ways[lane]) {
      if (!reached[next]) open.push_back(next);
      reached[next] = true;
    }
  }
  return reached;
}

std::vector<std::size_t> LanesOf(const MapFile& map, LaneMode mode) {
  std::vector<std::size_t> lanes;
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    if (map.lanes[i].value.mode == mode) lanes.push_back(i);
  }
  return lanes;
}

}  // namespace

void CheckWays(const MapFile& map, Findings& findings) {
  const NumberIndex index(map.lanes);
  Ways onward(map.lanes.size()), back(map.lanes.size());
  std::vector<bool> leaves(map.lanes.size(), false),
      arrives(map.lanes.size(), false);  // by any connection, broken ones too
  for (const auto& line : map.connections) {
    const auto from = index.Find(line.value.from), to = index.Find(line.value.to);
    if (from) leaves[*from] = true;
    if (to) arrives[*to] = true;
    if (!from || !to) continue;
    onward[*from].push_back(*to);
    back[*to].push_back(*from);
  }
  const std::vector<std::size_t> starts = LanesOf(map, LaneMode::kStart), ends = LanesOf(map, LaneMode::kEnd);
  const std::vector<bool> reached = Reach(starts, onward), finishes = Reach(ends, back);
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const auto& line = map.lanes[i];
    if (index.Find(line.value.id) != i) continue;  // its number is another lane's
    const LaneMode mode = line.value.mode;
    if (!leaves[i] && !arrives[i]) {
      findings.Add(Severity::kError, line, "map.unconnected_lane", "it has neither predecessor nor successor");
    } else if (mode != LaneMode::kEnd && !leaves[i]) {
      findings.Add(Severity::kError, line, "map.dead_end",
                   "it is a dead end: it has no successor and is not an end lane");
    } else if (mode == LaneMode::kEnd && leaves[i]) {
      findings.Add(Severity::kWarning, line, "map.goes_on_behind_end", "it has a successor, but is an end lane");
    }
    if (!starts.empty() && !reached[i] && (leaves[i] || arrives[i]))
      findings.Add(Severity::kWarning, line, "map.unreachable_lane", "no start lane leads to it");
    if (!ends.empty() && !finishes[i] && leaves[i]) {
      const Severity severity = mode == LaneMode::kStart ? Severity::kError : Severity::kWarning;
      findings.Add(severity, line, "map.no_way_to_end", "no end lane can be reached from it");
    }
  }
}

}  // namespace rodeira::traffic_map
