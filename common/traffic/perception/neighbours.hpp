// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::traffic {

// Leaders and followers of a vehicle.
class Neighbours {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const double& longest_half_m;
    std::span<const RouteSegments> stretches;
    const Occupancy& occupants;
    std::span<const std::uint8_t> parts;
    std::span<const std::vector<Block>> blocks;
    const bool& any_block;
    const bool& any_overtaking;
  };
  explicit Neighbours(const Reads& reads) : in_(reads) {}

  // The lane that it is leaving, beside a stretch of its way, as long as something of it at this odometer reaches into
  // it.
  std::optional<std::uint32_t> LaneLeft(std::uint32_t id, const RouteSegment& stretch, double odometer_m) const;
  // The leader, with the gap to it: the next vehicle on the agent's way.
  Leader FindLeader(std::uint32_t id) const;
  // Those on which a vehicle may be.
  std::span<const lanes::DivergeZone> DivergeZonesOf(std::uint32_t track) const;
  // The follower of a rectangle with its middle and rear there on a track: on it, or on those that lead to it.
  Follower FindFollower(std::uint32_t id, std::uint32_t track, double middle_m, double rear_m) const;
  // Where the one is that it passes, from its front bumper on: behind it, below 0.
  std::optional<Leader> FindOvertaken(std::uint32_t id) const;

 private:
  Reads in_;
};

}  // namespace rodeira::traffic
