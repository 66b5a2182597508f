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

  // The least of the plan, the leader, and the line before zones that are not its own.
  double Wanted(std::uint32_t id) const;
  // By no more than the planned jerk, so that it also comes to rest without one. In an emergency by the emergency's: it
  // would have to brake harder than is comfortable, and sooner than it can so; or as hard as it may, but not for
  // traffic that drives away from it; or it has come to brake harder than it could let go of so. What a scenario
  // commands is done exactly. A car with full physics may brake a little harder than it is asked to, and so be slower
  // than the deceleration that it has come to would be let go of from: that is let go of by the planned jerk all the
  // same, as long as what is left of it is taken by the foot that ends the stop. Nor are the last centimetres before a
  // line, which ask for as much as one likes, an emergency for it: it comes to stand a hand's breadth behind; before a
  // vehicle they are.
  double Smoothed(std::uint32_t id, double wanted_mps2, double dt_s);

 private:
  double SeekingSpeed(std::uint32_t id, double planned_mps) const;
  double WantedByPlan(std::uint32_t id, const driver::SpeedPlan::Allowed& here) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
