// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/traffic/following/decided.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/pedestrians/yielding.hpp"
#include "common/traffic/perception/reaction.hpp"
#include "common/traffic/signals/light_holds.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/flow_count.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// All vehicles and people of the traffic, as a value: columns by vehicle number, and what a run needs to go on. Traits
// follow from the settings, or from flow and arrival number; poses follow from the rest.
struct VehicleStore {
  explicit VehicleStore(const TrafficSettings& settings);

  std::vector<AgentTraits> traits;
  std::vector<Agent> agents;
  std::vector<Decided> decided;      // empty where drivers decide in every step
  std::deque<PastLeaders> past;      // the oldest first; empty without a reaction time
  std::vector<Yielding> yielding;    // empty without people
  std::vector<MotorsDriver> motors;  // empty where other drivers drive
  std::optional<FullCars> full;      // none: planar
  std::optional<Pedestrians> people;
  double longest_half_m = 0.0;             // of all vehicles that there may be
  std::vector<std::uint32_t> waiting;      // to enter, first come first
  std::vector<SpawningVehicle> appearing;  // in the order of the commands
  std::vector<FlowCount> flows;
  LightHolds light_holds;
  std::uint64_t next_grant = 1;
  std::uint64_t ended = 0, missed = 0;  // trips; lanes for routes
  std::int64_t time_ns = 0;             // since the beginning
  std::int64_t looked_ns = -1;          // when all was looked for last; below 0: in every step, or not yet
  std::vector<AgentPose> poses;         // of vehicles on the road, by ascending number
};

}  // namespace rodeira::traffic
