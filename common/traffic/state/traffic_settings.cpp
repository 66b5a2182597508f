// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/state/traffic_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rodeira::traffic {
TrafficSettings ReadTraffic(const config::Map& map, std::uint64_t seed) {
  TrafficSettings t;
  t.seed = seed;
  t.demand = ReadDemand(map);
  if (!t.demand.flows.empty()) t.vehicles = TrafficSettings::kMaxOfFlows;
  t.vehicles = static_cast<std::uint32_t>(map.Integer("vehicles", 0, 100000, t.vehicles));
  t.threads = static_cast<std::uint32_t>(map.Integer("threads", 1, 64, t.threads));
  t.physics = map.Choice("physics", {"planar", "full"}, "planar") == "full" ? Physics::kFull : Physics::kPlanar;
  if (map.Choice("driver", {"standard", "motors"}, "standard") == "motors") {
    if (map.Has("physics") && t.physics == Physics::kPlanar)
      map.Problem("physics", "config.conflicting_keys",
                  "the driver 'motors' holds pedals and steering wheel; 'physics: full' was expected");
    if (map.Has("pedestrians"))
      map.Problem("pedestrians", "config.conflicting_keys",
                  "the driver 'motors' sees nobody on foot; no 'pedestrians' were expected");
    t.driver = DriverKind::kMotors;
    t.physics = Physics::kFull;
  }
  t.variety = map.Number("variety", {0.0, 0.5}, t.variety);
  t.speed_factor_low = map.Number("speed_factor_low", {0.2, 2.0}, t.speed_factor_low);
  t.speed_factor_high = map.Number("speed_factor_high", {0.2, 2.0}, t.speed_factor_high);
  if (t.speed_factor_high < t.speed_factor_low) {
    map.Problem(map.Has("speed_factor_high") ? "speed_factor_high" : "speed_factor_low", "config.wrong_order",
                fmt::format("'speed_factor_high' is {}, below 'speed_factor_low', which is {}", t.speed_factor_high,
                            t.speed_factor_low));
  }
  t.side_margin_m = map.Number("side_margin_m", {0.0, 2.0}, t.side_margin_m);
  t.sight_m = map.Number("sight_m", {20.0, 2000.0}, t.sight_m);
  const config::Map follow = map.OptionalChild("following");
  t.idm.time_gap_s = follow.Number("time_gap_s", {0.2, 10.0}, t.idm.time_gap_s);
  t.idm.standing_gap_m = follow.Number("standing_gap_m", {0.5, 20.0}, t.idm.standing_gap_m);
  t.idm.acceleration_mps2 = follow.Number("acceleration_mps2", {0.2, 5.0}, t.idm.acceleration_mps2);
  t.idm.braking_mps2 = follow.Number("braking_mps2", {0.5, 8.0}, t.idm.braking_mps2);
  t.idm.hardest_mps2 = follow.Number("hardest_mps2", {1.0, 12.0}, t.idm.hardest_mps2);
  const config::Map comfort = map.OptionalChild("comfort");
  t.speed.lateral_mps2 = comfort.Number("lateral_mps2", {0.3, 8.0}, t.speed.lateral_mps2);
  t.speed.vertical_mps2 = comfort.Number("vertical_mps2", {0.3, 8.0}, t.speed.vertical_mps2);
  t.speed.braking_mps2 = comfort.Number("braking_mps2", {0.3, 6.0}, t.speed.braking_mps2);
  t.speed.steep_grade = comfort.Number("steep_grade", {0.0, 1.0}, t.speed.steep_grade);
  t.speed.steep_factor = comfort.Number("steep_factor", {0.2, 1.0}, t.speed.steep_factor);
  t.smooth.planned_mps3 = comfort.Number("jerk_mps3", {0.5, 1e6}, t.smooth.planned_mps3);
  t.smooth.emergency_mps3 =
      comfort.Number("emergency_jerk_mps3", {0.5, 1e6}, std::max(t.smooth.emergency_mps3, t.smooth.planned_mps3));
  if (t.smooth.emergency_mps3 < t.smooth.planned_mps3)
    comfort.Problem("emergency_jerk_mps3", "config.wrong_order", "'emergency_jerk_mps3' is below 'jerk_mps3'");
  const config::Map enter = map.OptionalChild("entering");
  t.enters = enter.Choice("rule", {"safe", "free"}, "safe") == "free" ? EnterRule::kFree : EnterRule::kSafe;
  t.free_m = enter.Number("free_m", {0.5, 100.0}, t.free_m);
  const config::Map change = map.OptionalChild("lane_changes");
  t.changes_lanes = change.Flag("allowed", t.changes_lanes);
  t.lane_changes.politeness = change.Number("politeness", {0.0, 1.0}, t.lane_changes.politeness);
  t.lane_changes.threshold_mps2 = change.Number("threshold_mps2", {0.0, 2.0}, t.lane_changes.threshold_mps2);
  t.lane_changes.bias_mps2 = change.Number("bias_mps2", {0.0, 2.0}, t.lane_changes.bias_mps2);
  t.lane_changes.safe_mps2 = change.Number("safe_mps2", {0.5, 8.0}, t.lane_changes.safe_mps2);
  t.overtaking.allowed = change.Flag("overtaking", t.overtaking.allowed);
  t.overtaking.sight_m = change.Number("overtaking_sight_m", {50.0, 2000.0}, t.overtaking.sight_m);
  t.overtaking.margin_s = change.Number("overtaking_margin_s", {1.0, 20.0}, t.overtaking.margin_s);
  if (map.Has("pedestrians")) t.pedestrians = ReadPedestrians(map.Child("pedestrians"));
  if (map.Has("mix")) t.mix = ReadMix(map.Child("mix"));
  t.scripted = ReadKinds(map.OptionalItems("scripted"));
  return t;
}

base::Result<TrafficSettings> LoadTraffic(const std::filesystem::path& path, std::uint64_t seed) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  (void)file.value().root().Choice("rodeira", {"traffic/1"});
  const TrafficSettings settings = ReadTraffic(file.value().root(), seed);
  if (auto status = file.value().Finish(); !status) return status.error();
  return settings;
}

}  // namespace rodeira::traffic
