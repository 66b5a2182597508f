// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "common/world/opendrive/import.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::LaneKey;
using network::Network;

constexpr double kOpenWidth_m = 1.0;  // narrower at its end, a lane opens or ends beside another one

// Whether traffic comes onto a lane at its beginning, or leaves it at its end, without another lane: at the edge of the
// network, where the file says so, and where the lane opens or ends beside another one.
bool IsOpen(const Network& network, const LaneKey& key, bool at_beginning) {
  const network::Lane& lane = *network.Find(key);
  if (at_beginning ? lane.traffic_begins : lane.traffic_ends) return true;
  const network::RoadSpec& road = network.roads()[key.road].spec();
  const network::LaneSection& section = network.Section(key);
  const bool along = lane.direction >= 0;
  const End end = along == at_beginning ? End::kStart : End::kEnd;
  if (network.Span(key, end == End::kStart ? section.s_m : section.end_s_m)->width_m() < kOpenWidth_m) return true;
  const bool outer = end == End::kStart ? key.section == 0 : key.section + 1 == road.sections.size();
  return outer && road.junction.empty() && !(end == End::kStart ? road.predecessor : road.successor);
}

// The lanes that are open at their beginning or have one before them that counts, and so on.
std::vector<bool> Reached(const Network& network, const std::vector<LaneKey>& lanes, bool forward) {
  std::vector<bool> counts(network.LaneNumbers(), false);
  std::vector<std::size_t> before(network.LaneNumbers(), 0);
  std::vector<LaneKey> out;
  for (const LaneKey& key : lanes) counts[network.Number(key)] = true;
  for (const LaneKey& key : lanes) {
    const std::size_t number = network.Number(key);
    for (const network::LaneEnd& end : forward ? network.Predecessors(key) : network.Successors(key)) {
      if (counts[network.Number(end.lane)]) ++before[number];
    }
    if (before[number] == 0 && !IsOpen(network, key, forward)) out.push_back(key);
  }
  for (const LaneKey& key : out) counts[network.Number(key)] = false;
  while (!out.empty()) {
    const LaneKey key = out.back();
    out.pop_back();
    for (const network::LaneEnd& end : forward ? network.Successors(key) : network.Predecessors(key)) {
      const std::size_t number = network.Number(end.lane);
      if (!counts[number] || before[number] == 0 || --before[number] > 0 || IsOpen(network, end.lane, forward))
        continue;
      counts[number] = false;
      out.push_back(end.lane);
    }
  }
  return counts;
}

}  // namespace

Reach ReachOf(const Network& network) {
  std::vector<LaneKey> lanes;
  for (const LaneKey& key : network.Lanes()) {
    if (network::IsDrivable(network.Find(key)->type)) lanes.push_back(key);
  }
  const std::vector<bool> from = Reached(network, lanes, true), to = Reached(network, lanes, false);
  Reach reach;
  for (const LaneKey& key : lanes) {
    const double length_m = network.Section(key).end_s_m - network.Section(key).s_m;
    reach.lanes_m += length_m;
    const std::size_t number = network.Number(key);
    if (from[number] && to[number]) reach.reached_m += length_m;
  }
  return reach;
}

}  // namespace rodeira::opendrive
