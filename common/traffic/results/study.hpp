// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/traffic/results/lane_intervals.hpp"
#include "common/traffic/results/lane_statistics.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::traffic {

// How a run of the model alone is done and watched.
struct StudySettings {
  TrafficSettings traffic;
  double duration_s = 60.0;
  double step_s = 0.01;
  double watch_s = 0.1;  // how often contacts, lanes and speeds are looked at; a multiple of the step
  bool checks = true;    // whether faults are looked for every watch_s: overlaps, reds, wheels off the road
  bool feels = false;    // whether it is told what a passenger feels: jerk, lateral and yaw acceleration
  double cell_m = 0.0;   // length of the cells of lanes that are summed up in; 0: none
  double warm_s = 0.0;   // lanes, trips and queues are watched from then on: roads that begin empty fill first
  double every_s = 0.0;  // the lanes' sums are noted so often, too; 0: they are not
};

// What came out of a run of the model alone. All but the way driven is counted from the published poses.
struct StudyResult {
  std::int64_t steps = 0;
  double driven_km = 0.0;  // by all, with what they drove in the step in which they left
  double vehicle_s = 0.0;  // on the road, summed over all
  double standing_s = 0.0;
  double longest_stand_s = 0.0;
  std::uint32_t longest_stand_id = 0;
  double longest_with_room_s = 0.0;  // the part of one stand in which there was room ahead (TrafficModel::RoomAhead)
  std::uint32_t longest_with_room_id = 0;
  bool checked = false;                // the next four were looked for
  std::int64_t collisions = 0;         // times that two boxes on one level came to overlap
  std::int64_t reds = 0;               // times that a front passed a red light
  std::int64_t off_lane = 0;           // times that a middle was seen beside every drivable lane
  std::int64_t wheels_off = 0;         // times that a wheel was seen beside all lanes and shoulders
  double worst_step_m = 0.0;           // |distance between two poses - mean speed · step|, in plan
  double max_deceleration_mps2 = 0.0;  // deceleration with a foot on the brake, whatever else slows the car down
  double foot_mps2 = 0.0;  // what a foot asks of the brake: its share of what the brake can, faster than 0.5 m/s (a car
                           // that stands is held by it)
  double planned_jerk_mps3 = 0.0;    // largest change of acceleration from one step to the next, but …
  double emergency_jerk_mps3 = 0.0;  // … in an emergency
  std::int64_t hurried_steps = 0;    // steps driven in an emergency (TrafficModel::Hurries), each vehicle's counted
  double lateral_mps2 = 0.0;         // largest speed times yaw rate, and change of the yaw rate
  double yaw_radps2 = 0.0;
  double max_deceleration_any_mps2 =
      0.0;  // and by whatever: on a hill that the engine is too weak for, in overrun, while a gear changes
  std::int64_t arrivals = 0;  // trips that ended
  std::int64_t began = 0, entered = 0,
               left = 0;  // on the road at first; came onto it, and left it, since: began + entered - left = on_road
  std::array<std::int64_t, kLeaveReasons> left_because{};  // of those that left, by LeaveReason
  double fuel_mg = 0.0;                                    // burnt on the road
  std::size_t on_road = 0, waiting = 0;
  std::vector<std::string> incidents;  // the first ones, as sentences
  std::optional<LaneStatistics> lanes;
  std::optional<LaneIntervals> intervals;

  double mean_speed_mps() const { return vehicle_s > 0.0 ? 1000.0 * driven_km / vehicle_s : 0.0; }
};

// One moment of a study, for tables.
struct StudyMoment {
  double time_s = 0.0;
  const TrafficModel& model;
};

// Runs the model without any network or node. `watch`, where there is one, sees the beginning and every watch_s.
base::Result<StudyResult> RunStudy(const StudySettings& settings, std::shared_ptr<const network::Network> network,
                                   const std::function<void(const StudyMoment&)>& watch = {});
// The same on a world's roads and ground, with no vehicle beginning where a driver's car would (KeptClear): to the bit
// what a traffic node with these settings publishes in a run of that world, as long as it meets no other vehicle and is
// told nothing.
base::Result<StudyResult> RunStudy(const StudySettings& settings, const std::shared_ptr<const road::World>& world,
                                   const std::function<void(const StudyMoment&)>& watch = {});

}  // namespace rodeira::traffic
