// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/driving/driver/footprint.hpp"
#include "common/traffic/demand/entering.hpp"
#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motion/full_motion.hpp"
#include "common/traffic/motion/poses.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/crosswalks.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/observation.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/flow_count.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles that a scenario puts onto a lane.
class Spawning {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::optional<FullCars>& full;
    const std::optional<Pedestrians>& people;
    const std::vector<driver::Footprint>& bodies;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<OncomingOvertaker>> facing;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const CarFollowing& following;
    const Crosswalks& crosswalks;
    const Poses& body_poses;
  };
  struct Writes {
    std::span<Agent> agents;
    std::vector<SpawningVehicle>& appearing;
    Occupancy& occupants;
    std::span<Leader> ahead;
    Ways& ways;
    Observation& observation;
    FullMotion& full_motion;
    Entering& entering;
  };
  Spawning(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Whether it waits to come onto its lane.
  bool IsSpawning(std::uint32_t id) const;
  // Whether it ever could; Wrong input as Spawn's.
  base::Status CheckSpawn(std::uint32_t id, const std::string& lane, double s_m) const;
  // One of the settings' `scripted` comes onto a lane (ROAD:LANE), with its middle at a station of the road, no faster
  // than asked and than lets it stop before what is ahead: in this step's end, or the first one in which there is room
  // for it. Wrong input with a sentence where there can never be room; false where it is on the road already, or waits
  // to be.
  base::Result<bool> Spawn(std::uint32_t id, const std::string& lane, double s_m, double speed_mps);
  // Vehicles with room come onto the road; the others go on waiting.
  void SpawnAll();

 private:
  base::Status CheckPlace(std::uint32_t id, std::uint32_t track, double d_m) const;
  base::Result<std::pair<std::uint32_t, double>> PlaceToSpawn(std::uint32_t id, const std::string& lane,
                                                              double s_m) const;
  bool IsClearFor(const SpawningVehicle& next) const;
  bool IsTakenUp(std::uint32_t id) const;
  bool TrySpawn(const SpawningVehicle& next);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
