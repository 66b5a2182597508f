// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/traffic_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/config/declared.hpp"
#include "common/traffic/state/traffic_schema.hpp"

namespace rodeira::traffic {

TrafficSettings ReadTraffic(const config::Map& map, std::uint64_t seed) {
  const config::DeclaredMap declared(map, TrafficSchema().keys);
  TrafficSettings t;
  t.seed = seed;
  t.demand = ReadDemand(map);
  if (!t.demand.flows.empty()) t.vehicles = TrafficSettings::kMaxOfFlows;
  t.vehicles =
      static_cast<std::uint32_t>(declared.MapWith("vehicles").Integer("vehicles", 0, kMaxVehicles, t.vehicles));
  t.threads = static_cast<std::uint32_t>(declared.Integer("threads"));
  t.physics = declared.Word("physics") == "full" ? Physics::kFull : Physics::kPlanar;
  if (declared.Word("driver") == "motors") {
    if (map.Has("physics") && t.physics == Physics::kPlanar)
      map.Problem("physics", "config.conflicting_keys",
                  "the driver 'motors' holds pedals and steering wheel; 'physics: full' was expected");
    if (map.Has("pedestrians"))
      map.Problem("pedestrians", "config.conflicting_keys",
                  "the driver 'motors' sees no pedestrians; no 'pedestrians' were expected");
    t.driver = DriverKind::kMotors;
    t.physics = Physics::kFull;
  }
  t.variety = declared.Number("variety");
  t.speed_factor_low = declared.Number("speed_factor_low");
  t.speed_factor_high = declared.Number("speed_factor_high");
  if (t.speed_factor_high < t.speed_factor_low) {
    map.Problem(map.Has("speed_factor_high") ? "speed_factor_high" : "speed_factor_low", "config.wrong_order",
                fmt::format("'speed_factor_high' is {}, below 'speed_factor_low', which is {}", t.speed_factor_high,
                            t.speed_factor_low));
  }
  t.decide_s = declared.Number("decide_s");
  t.reaction_s = declared.Number("reaction_s");
  t.side_margin_m = declared.Number("side_margin_m");
  t.sight_m = declared.Number("sight_m");
  const config::DeclaredMap follow = declared.Child("following");
  t.idm.time_gap_s = follow.Number("time_gap_s");
  t.idm.min_gap_m = follow.Number("min_gap_m");
  t.idm.acceleration_mps2 = follow.Number("acceleration_mps2");
  t.idm.braking_mps2 = follow.Number("braking_mps2");
  t.idm.max_deceleration_mps2 = follow.Number("max_deceleration_mps2");
  const config::DeclaredMap comfort = declared.Child("comfort");
  t.speed.lateral_mps2 = comfort.Number("lateral_mps2");
  t.speed.vertical_mps2 = comfort.Number("vertical_mps2");
  t.speed.braking_mps2 = comfort.Number("braking_mps2");
  t.speed.steep_grade = comfort.Number("steep_grade");
  t.speed.steep_factor = comfort.Number("steep_factor");
  t.smooth.planned_mps3 = comfort.Number("jerk_mps3");
  t.smooth.emergency_mps3 =
      comfort.Number("emergency_jerk_mps3", std::max(t.smooth.emergency_mps3, t.smooth.planned_mps3));
  if (t.smooth.emergency_mps3 < t.smooth.planned_mps3)
    comfort.map().Problem("emergency_jerk_mps3", "config.wrong_order", "'emergency_jerk_mps3' is below 'jerk_mps3'");
  const config::DeclaredMap enter = declared.Child("entering");
  t.enters = enter.Word("rule") == "free" ? EnterRule::kFree : EnterRule::kSafe;
  t.free_m = enter.Number("free_m");
  const config::DeclaredMap change = declared.Child("lane_changes");
  t.changes_lanes = change.Flag("allowed");
  t.lane_changes.politeness = change.Number("politeness");
  t.lane_changes.threshold_mps2 = change.Number("threshold_mps2");
  t.lane_changes.bias_mps2 = change.Number("bias_mps2");
  t.lane_changes.safe_mps2 = change.Number("safe_mps2");
  t.overtaking.allowed = change.Flag("overtaking");
  t.overtaking.sight_m = change.Number("overtaking_sight_m");
  t.overtaking.margin_s = change.Number("overtaking_margin_s");
  if (map.Has("pedestrians")) t.pedestrians = ReadPedestrians(declared.MapWith("pedestrians").Child("pedestrians"));
  if (map.Has("mix")) t.mix = ReadMix(declared.MapWith("mix").Child("mix"));
  t.scripted = ReadKinds(declared.Items("scripted").list());
  return t;
}

base::Result<TrafficSettings> LoadTraffic(const std::filesystem::path& path, std::uint64_t seed) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  (void)config::DeclaredMap(file.value().root(), TrafficSchema().keys).Word("rodeira");
  const TrafficSettings settings = ReadTraffic(file.value().root(), seed);
  if (auto status = file.value().Finish(); !status) return status.error();
  return settings;
}

}  // namespace rodeira::traffic
