// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The lane of oncoming traffic, for vehicles that overtake and vehicles that come.
class OncomingLane {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const double& longest_half_m;
    std::span<const RouteSegments> stretches;
    const Occupancy& occupants;
    std::span<const std::vector<Block>> blocks;
    std::span<const std::vector<OncomingOvertaker>> facing;
    const bool& any_facing;
  };
  explicit OncomingLane(const Reads& reads) : in_(reads) {}

  // Along its way, as far as it sees: what comes, or could come from where it sees no further, or where vehicles begin
  // their way.
  Oncoming FindOncoming(std::uint32_t id) const;
  // Oncoming traffic goes on as long as an overtaker will be back in time by what it does; else it stops where both can
  // stop.
  double WantedForOvertaker(std::uint32_t id, double limit_mps) const;

 private:
  Reads in_;
};

}  // namespace rodeira::traffic
