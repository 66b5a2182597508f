// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/driving/driver/speed_plan.hpp"
#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_changes.hpp"
#include "common/traffic/lane_change/lane_ways.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/overtaking/oncoming.hpp"
#include "common/traffic/overtaking/overtaking_drive.hpp"
#include "common/traffic/overtaking/overtaking_start.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The acceleration that each driver wants, smoothed by the jerk.
class Acceleration {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::optional<FullCars>& full;
    std::span<const Leader> ahead;
    std::span<const ConflictPassage> passages;
    std::span<const double> leaves;
    std::span<const double> bars;
    const SpeedLimits& limits;
    const CarFollowing& following;
    const LaneWays& lanes_beside;
    const LaneChanges& lane_changes;
    const OncomingLane& oncoming;
    const OvertakingStart& overtaking_start;
    const OvertakingDrive& overtaking;
  };
  struct Writes {
    std::span<std::uint8_t> hurries;
  };
  Acceleration(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  double Wanted(std::uint32_t id) const;
  double Smoothed(std::uint32_t id, double wanted_mps2, double dt_s);

 private:
  double SeekingSpeed(std::uint32_t id, double planned_mps) const;
  double WantedByPlan(std::uint32_t id, const driver::SpeedPlan::Allowed& here) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
