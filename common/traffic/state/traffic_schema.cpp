// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/traffic_schema.hpp"

#include "common/traffic/demand/demand_schema.hpp"
#include "common/traffic/pedestrians/pedestrian_schema.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {
namespace {

using config::FlagKey;
using config::IntegerKey;
using config::MappingKey;
using config::NumberKey;
using config::WordKey;

config::Key FollowingKey(const driver::IdmSettings& idm) {
  return MappingKey("following",
                    {NumberKey("time_gap_s", {0.2, 10.0}, idm.time_gap_s, "T of the IDM."),
                     config::Renamed("standing_gap_m", NumberKey("min_gap_m", {0.5, 20.0}, idm.min_gap_m,
                                                                 "s0 of the IDM, bumper to bumper.")),
                     NumberKey("acceleration_mps2", {0.2, 5.0}, idm.acceleration_mps2, "a of the IDM."),
                     NumberKey("braking_mps2", {0.5, 8.0}, idm.braking_mps2,
                               "b of the IDM: comfortable braking, also for lines and lights."),
                     config::Renamed("hardest_mps2", NumberKey("max_deceleration_mps2", {1.0, 12.0},
                                                               idm.max_deceleration_mps2, "Largest deceleration."))},
                    "Car following.");
}

config::Key ComfortKey(const TrafficSettings& t) {
  return MappingKey(
      "comfort",
      {NumberKey("lateral_mps2", {0.3, 8.0}, t.speed.lateral_mps2, "Lateral acceleration in bends."),
       NumberKey("vertical_mps2", {0.3, 8.0}, t.speed.vertical_mps2,
                 "Vertical acceleration over crests and through sags."),
       NumberKey("braking_mps2", {0.3, 6.0}, t.speed.braking_mps2, "Planned braking before bends and lower limits."),
       NumberKey("steep_grade", {0.0, 1.0}, t.speed.steep_grade, "Downhill grade from which on `steep_factor` holds."),
       NumberKey("steep_factor", {0.2, 1.0}, t.speed.steep_factor, "Share of the speed on steep grades."),
       NumberKey("jerk_mps3", {0.5, 1e6}, t.smooth.planned_mps3, "Largest planned jerk."),
       config::ComputedNumberKey("emergency_jerk_mps3", {0.5, 1e6}, "15, or `jerk_mps3` if larger",
                                 "Jerk in an emergency.")},
      "Comfort and speed plan.");
}

config::Key LaneChangesKey(const TrafficSettings& t) {
  return MappingKey(
      "lane_changes",
      {FlagKey("allowed", t.changes_lanes, "Vehicles change lanes."),
       NumberKey("politeness", {0.0, 1.0}, t.lane_changes.politeness, "p of MOBIL."),
       NumberKey("threshold_mps2", {0.0, 2.0}, t.lane_changes.threshold_mps2, "Advantage that a change needs."),
       NumberKey("bias_mps2", {0.0, 2.0}, t.lane_changes.bias_mps2, "Advantage of the side to keep to."),
       NumberKey("safe_mps2", {0.5, 8.0}, t.lane_changes.safe_mps2, "Hardest braking that a change may cause."),
       FlagKey("overtaking", t.overtaking.allowed, "Vehicles overtake on the lane of oncoming traffic."),
       NumberKey("overtaking_sight_m", {50.0, 2000.0}, t.overtaking.sight_m, "Sight of oncoming traffic."),
       NumberKey("overtaking_margin_s", {1.0, 20.0}, t.overtaking.margin_s,
                 "Time to oncoming traffic at the end of the manoeuvre.")},
      "Lane changes and overtaking.");
}

config::Schema MakeTrafficSchema() {
  const TrafficSettings t;
  std::vector<config::Key> keys{
      IntegerKey("vehicles", 0, kMaxVehicles, t.vehicles,
                 "Vehicles at a time. With flows at most so many, by default 1000."),
      IntegerKey("threads", 1, 64, t.threads, "Threads of a step; they change no result."),
      WordKey("physics", {"planar", "full"}, "planar", "How vehicles move."),
      WordKey("driver", {"standard", "motors"}, "standard", "`motors` needs `physics: full`."),
      NumberKey("variety", {0.0, 0.5}, t.variety, "Spread of each driver's time gap, acceleration and braking."),
      NumberKey("speed_factor_low", {0.2, 2.0}, t.speed_factor_low,
                "Lowest share of the planned speed; drawn evenly up to the highest."),
      NumberKey("speed_factor_high", {0.2, 2.0}, t.speed_factor_high, "Highest share; not below the lowest."),
      NumberKey("decide_s", {0.0, 1.0}, t.decide_s, "Time between two decisions of a driver; 0: in every step."),
      NumberKey("reaction_s", {0.0, 2.0}, t.reaction_s, "So much later a driver sees what its leader does."),
      NumberKey("side_margin_m", {0.0, 2.0}, t.side_margin_m, "Nearer vehicles are in the way."),
      NumberKey("sight_m", {20.0, 2000.0}, t.sight_m, "Sight ahead, and for followers on a lane beside."),
      FollowingKey(t.idm),
      ComfortKey(t),
      MappingKey(
          "entering",
          {WordKey("rule", {"safe", "free"}, "safe", "`safe`: no hard braking behind the leader; `free`: as MOTORS."),
           NumberKey("free_m", {0.5, 100.0}, t.free_m, "Free length of the lane for `free`.")},
          "When a vehicle enters the network."),
      LaneChangesKey(t),
      MappingKey("pedestrians", PedestrianKeys(), "Pedestrians at crossings; none without this key."),
      MappingKey("mix", MixKeys(), "Kinds of vehicles; by default four fifths cars and one fifth vans."),
      KindsKey("scripted", "Vehicles for the event traffic.appear.")};
  keys.insert(keys.end(), DemandKeys().begin(), DemandKeys().end());
  return {"traffic", "traffic/1", "Vehicles, drivers and demand of the traffic.",
          config::FileKeys("traffic/1", std::move(keys))};
}

}  // namespace

const config::Schema& TrafficSchema() {
  static const config::Schema schema = MakeTrafficSchema();
  return schema;
}

}  // namespace rodeira::traffic
