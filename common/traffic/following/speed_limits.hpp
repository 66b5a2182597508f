// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/driving/driver/speed_plan.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

inline constexpr double kMinDivisorSpeed_mps = 0.01;  // speeds are divided by no less

// The speed that limits, bends, crests and the driver allow along the way. Odometers are those of the agent's path.
class SpeedLimits {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    std::span<const RouteSegments> stretches;
    std::span<const CurrentTrackCache> below;
    std::span<const std::array<PlannedAt, 2>> known;
  };
  explicit SpeedLimits(const Reads& reads) : in_(reads) {}

  // The plan of the track at a place of its way, and what the beginnings of those beyond leave, braked for as the plans
  // are.
  driver::SpeedPlan::Allowed Allowed(std::uint32_t id, double odometer_m) const;
  // The limit of a track, m/s; with the driver's own factor and cap as Limit_mps.
  double LimitOn(std::uint32_t track, double d_m) const;
  double Limit_mps(std::uint32_t id, std::uint32_t track, double d_m) const;
  // By the limit where it is: the speed without any vehicle and any bend.
  double Desired_mps(std::uint32_t id) const;
  // What the plan of the track there allows this driver, m/s; 0 beyond its stretches.
  double AllowedAt(std::uint32_t id, double odometer_m) const;

 private:
  Reads in_;
};

}  // namespace rodeira::traffic
