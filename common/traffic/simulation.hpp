// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/core/base/state.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/traffic/demand/appearing.hpp"
#include "common/traffic/demand/arriving.hpp"
#include "common/traffic/demand/entering.hpp"
#include "common/traffic/demand/placing.hpp"
#include "common/traffic/following/acceleration.hpp"
#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/decisions.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_changes.hpp"
#include "common/traffic/lane_change/lane_ways.hpp"
#include "common/traffic/motion/crashes.hpp"
#include "common/traffic/motion/full_motion.hpp"
#include "common/traffic/motion/motion.hpp"
#include "common/traffic/motion/paths.hpp"
#include "common/traffic/motion/planar_motion.hpp"
#include "common/traffic/motion/poses.hpp"
#include "common/traffic/motors/motors_driving.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/overtaking/oncoming.hpp"
#include "common/traffic/overtaking/overtaking_drive.hpp"
#include "common/traffic/overtaking/overtaking_start.hpp"
#include "common/traffic/pedestrians/crosswalks.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/observation.hpp"
#include "common/traffic/perception/reaction.hpp"
#include "common/traffic/perception/seen.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/results/details.hpp"
#include "common/traffic/right_of_way/arbitration.hpp"
#include "common/traffic/right_of_way/claimed.hpp"
#include "common/traffic/right_of_way/claims.hpp"
#include "common/traffic/right_of_way/deadlock.hpp"
#include "common/traffic/right_of_way/grants.hpp"
#include "common/traffic/right_of_way/merging.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/right_of_way/room.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/vehicle_store.hpp"
#include "common/traffic/step_columns.hpp"

namespace rodeira::traffic {

// All data of a traffic: what a run saves, and what its steps find anew.
struct TrafficData {
  TrafficData(const TrafficSettings& of, std::shared_ptr<const TrafficMap> on);

  TrafficSettings settings;
  std::shared_ptr<const TrafficMap> map;
  std::shared_ptr<base::ThreadPool> pool;  // null: one thread
  VehicleStore store;
  Seen seen;
  Claimed claimed;
  StepColumns step;
};

// The phases of a step on data of their own. The modules hold nothing but references to the columns that they read and
// write (simulation_modules.cpp says which), and to modules declared before them; a copy has modules of its own.
struct Simulation : TrafficData {
  explicit Simulation(TrafficData data);
  Simulation(const Simulation& other) : Simulation(TrafficData(other)) {}
  Simulation& operator=(const Simulation&) = delete;

  // One step of dt_s, over 0; one longer than a quarter of a second is driven in equal parts that are not: longer ones
  // brake too late. `others`: vehicles and people that are no agents.
  void Step(double dt_s, std::span<const driver::Footprint> others);
  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

  Signals signals;
  Ways ways;
  CurrentTracks tracks;
  Neighbours neighbours;
  Observation observation;
  SpeedLimits limits;
  CarFollowing following;
  LaneWays lanes_beside;
  LaneChanges lane_changes;
  OncomingLane oncoming;
  OvertakingStart overtaking_start;
  OvertakingDrive overtaking;
  Reaction reaction;
  Acceleration acceleration;
  Decisions decisions;
  Passages passages_ahead;
  Merging merging;
  Room room;
  Claims claims;
  Grants grants;
  Deadlocks deadlocks;
  RightOfWay right_of_way;
  Crosswalks crosswalks;
  Poses body_poses;
  PlanarMotion planar;
  FullMotion full_motion;
  Paths paths;
  Motion motion;
  Crashes crashes;
  MotorsDriving motors_driving;
  Arriving arriving;
  Entering entering;
  Spawning appearing_vehicles;
  Placing placing;
  DetailReport details;

 private:
  void SaveRoutes(base::StateWriter& writer) const;
  void RestoreRoutes(base::StateReader& reader);
  void RestorePast(base::StateReader& reader);
  void StepPart(double dt_s, std::span<const driver::Footprint> others);
  void Decide(double dt_s, std::span<const driver::Footprint> others);
  void Observe(std::span<const driver::Footprint> others);
  void LetPeopleCross(double dt_s);
  bool LooksAnew(std::span<const driver::Footprint> others) const;
  std::int64_t NextLook_ns(std::int64_t step_ns) const;
  void Reserve(double dt_s, std::int64_t turn_ns);
  void ChangeLanes(std::int64_t step_ns);
  void Overtake(std::int64_t step_ns);
  void Accelerate(double dt_s, std::int64_t turn_ns);
  void KeepOn(double dt_s);
  void DriveCars(double dt_s);
  void LeaveOrSlide(double dt_s);
  void RemoveRequested();
  void Enter(std::int64_t step_ns, bool looks);
  void Show(std::int64_t step_ns);
};

}  // namespace rodeira::traffic
