// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The tracks on the way of each vehicle, as far as it looks.
class Ways {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
  };
  struct Writes {
    std::span<RouteSegments> stretches;
    std::span<WayKey> way_keys;
    std::span<std::uint32_t> way_numbers;
  };
  Ways(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // How far along its way it looks, m from its middle.
  double SightOf(const Agent& agent) const;
  // Whether its stretches go as far as that, or to the end of its way.
  bool SeesTo(std::uint32_t id, double odometer_m) const;
  // From the piece under the rear bumper to `range` beyond the front one.
  void FindRouteSegments(std::uint32_t id, double range_m);

 private:
  bool KeepRouteSegments(std::uint32_t id, double far_m);
  RouteSegment SegmentOn(std::uint32_t track, double zero_m, double begin_m, double end_m, bool changes) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
