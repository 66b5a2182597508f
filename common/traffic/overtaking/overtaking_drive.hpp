// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_changes.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/overtaking/oncoming.hpp"
#include "common/traffic/overtaking/overtaking.hpp"
#include "common/traffic/overtaking/overtaking_start.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// How a vehicle drives that overtakes, and when it goes back.
class OvertakingDrive {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::int64_t& time_ns;
    std::span<const std::uint8_t> is_overtaken;
    std::span<const std::uint8_t> passes;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const CarFollowing& following;
    const LaneChanges& lane_changes;
    const OncomingLane& oncoming;
  };
  struct Writes {
    std::span<Agent> agents;
    OvertakingStart& overtaking_start;
  };
  OvertakingDrive(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // One that falls back brakes as long as it is beside that one, and the one passed does not go faster.
  double WantedBeside(std::uint32_t id, double wanted_mps2) const;
  // Overtaking on the lane of oncoming traffic.
  void Overtake(std::int64_t step_ns);

 private:
  bool MayStopInWay(std::uint32_t id, const Leader& passed) const;
  bool MayGoBack(std::uint32_t id, bool behind) const;
  void GoBack(std::uint32_t id, bool behind);
  void DriveOvertaking(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
