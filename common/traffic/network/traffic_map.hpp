// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/traffic/demand/demand.hpp"
#include "common/traffic/network/lane_ends.hpp"
#include "common/traffic/network/track_plan.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/edge_marks.hpp"
#include "common/world/lanes/opposite.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// What does not change about a traffic: the network and all that is computed from it.
struct TrafficMap {
  std::shared_ptr<const network::Network> network;
  lanes::Graph graph;
  lanes::Zones zones;
  lanes::EdgeMarks marks;
  LaneEnds lane_ends;
  std::vector<std::int64_t> opposites;  // by track
  lanes::NoOvertaking no_overtaking;
  std::vector<TrackPlan> plans;  // by track
  std::vector<std::uint32_t> entries;
  std::vector<std::uint64_t>
      entry_keys;            // by entry: of its road's id, its lane and section, whatever else the network holds
  std::vector<bool> enters;  // by track: a vehicle may begin its way there
  std::vector<bool>
      watched;  // by track: a vehicle on it is in the way of one that begins there or on one that parts from it
  std::vector<bool> reached;  // by track: by ways from where a vehicle may begin; every one where the network does not
                              // say where that is
  std::vector<bool> zips;     // by zone: two adjacent lanes merge without a sign; at low speed vehicles of both lanes
                              // merge alternately (zip merge)
  std::vector<std::int8_t> waits_side;  // by zone: the side that turns across oncoming traffic and yields; -1: neither
  Demand demand;

  TrafficMap(std::shared_ptr<const network::Network> of, const TrafficSettings& settings);

  // Adds a track to the entries, where vehicles may begin their trips.
  void LetEnter(std::uint32_t track);

  // A random entry, all equally likely: the one with the highest hash of itself and `draw` (rendezvous hashing; Thaler,
  // Ravishankar 1998). A further entry takes its share of all draws; every other draw gives the same entry as before.
  // Returns the entry's track.
  std::uint32_t DrawEntry(std::uint64_t draw) const;
};

}  // namespace rodeira::traffic
