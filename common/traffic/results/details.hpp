// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/motors/motors_driving.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/results/agent_detail.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Lamps of vehicles, and what drivers and engines do.
class DetailReport {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::optional<FullCars>& full;
    const std::vector<MotorsDriver>& motors;
    const std::vector<AgentPose>& poses;
    std::span<const RouteSegments> stretches;
    const SpeedLimits& limits;
    const MotorsDriving& motors_driving;
  };
  struct Writes {
    Ways& ways;
  };
  DetailReport(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Which lights it shows, bits as in vehicle.idl: brake 1, left 2, right 4. One that changes lanes, or is to turn
  // within 30 m or three seconds, indicates; in a roundabout only one that leaves it.
  std::uint32_t LightsOf(const AgentPose& pose) const;
  // Of those on the road, in the order of poses().
  std::vector<AgentDetail> Details();

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
