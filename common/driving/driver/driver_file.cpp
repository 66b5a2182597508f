// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/declared.hpp"
#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/driver_schema.hpp"

namespace rodeira::driver {
namespace {

using config::MappingKey;
using config::NumberKey;

config::Schema Make() {
  const AutopilotSettings a;
  config::Schema schema{"driver", "driver/1", "How the autopilot drives, for an input with 'source: autopilot'.", {}};
  schema.keys = config::FileKeys(
      "driver/1",
      {config::TextKey("name", "", "Name, for the reader."),
       NumberKey("speed_factor", {0.1, 2.0}, a.speed_factor, "Share of the legal limit."),
       NumberKey("anticipation_s", {0.0, 3.0}, a.anticipation_s, "How far ahead the speed plan is read."),
       NumberKey("tracking_s", {0.1, 10.0}, a.tracking_s, "Time constant of the speed control."),
       NumberKey("side_margin_m", {0.0, 2.0}, a.side_margin_m, "Nearer objects are in its way."),
       NumberKey("range_m", {10.0, 1000.0}, a.range_m, "Sight."),
       MappingKey("following",
                  {NumberKey("time_gap_s", {0.2, 10.0}, a.idm.time_gap_s, "T of the IDM."),
                   config::Renamed("standing_gap_m", NumberKey("min_gap_m", {0.5, 20.0}, a.idm.min_gap_m,
                                                               "s0 of the IDM, bumper to bumper.")),
                   NumberKey("acceleration_mps2", {0.2, 5.0}, a.idm.acceleration_mps2, "a of the IDM."),
                   NumberKey("braking_mps2", {0.5, 8.0}, a.idm.braking_mps2, "b of the IDM: comfortable braking."),
                   config::Renamed("hardest_mps2", NumberKey("max_deceleration_mps2", {1.0, 12.0},
                                                             a.idm.max_deceleration_mps2, "Largest deceleration."))},
                  "Car following."),
       MappingKey("comfort",
                  {NumberKey("lateral_mps2", {0.3, 8.0}, a.speed.lateral_mps2, "Lateral acceleration in bends."),
                   NumberKey("vertical_mps2", {0.3, 8.0}, a.speed.vertical_mps2,
                             "Vertical acceleration over crests and through sags."),
                   NumberKey("braking_mps2", {0.3, 6.0}, a.speed.braking_mps2,
                             "Planned braking before bends and lower limits."),
                   NumberKey("steep_grade", {0.0, 1.0}, a.speed.steep_grade,
                             "Downhill grade from which on `steep_factor` holds."),
                   NumberKey("steep_factor", {0.2, 1.0}, a.speed.steep_factor, "Share of the speed on steep grades.")},
                  "The speed plan."),
       MappingKey(
           "steering",
           {NumberKey("preview_s", {0.2, 3.0}, a.steering.preview_s, "Preview time."),
            NumberKey("preview_least_m", {1.0, 20.0}, a.steering.preview_least_m, "Shortest preview."),
            NumberKey("preview_most_m", {5.0, 100.0}, a.steering.preview_most_m,
                      "Longest preview; not below the shortest."),
            NumberKey("understeer_radps2pm", {-0.05, 0.05}, a.steering.understeer_radps2pm, "Understeer of the car."),
            NumberKey("rate_radps", {0.5, 30.0}, a.steering.rate_radps, "Fastest turn of the steering wheel."),
            NumberKey("smoothing_s", {0.0, 1.0}, a.steering.smoothing_s, "Time constant of the smoothing.")},
           "Steering.")});
  return schema;
}

}  // namespace

const config::Schema& DriverSchema() {
  static const config::Schema schema = Make();
  return schema;
}

AutopilotSettings ReadAutopilot(const config::Map& map) {
  const config::DeclaredMap root(map, DriverSchema().keys);
  AutopilotSettings a;
  (void)root.Word("rodeira");
  (void)root.Text("name");
  a.speed_factor = root.Number("speed_factor");
  a.anticipation_s = root.Number("anticipation_s");
  a.tracking_s = root.Number("tracking_s");
  a.side_margin_m = root.Number("side_margin_m");
  a.range_m = root.Number("range_m");

  const config::DeclaredMap follow = root.Child("following");
  a.idm.time_gap_s = follow.Number("time_gap_s");
  a.idm.min_gap_m = follow.Number("min_gap_m");
  a.idm.acceleration_mps2 = follow.Number("acceleration_mps2");
  a.idm.braking_mps2 = follow.Number("braking_mps2");
  a.idm.max_deceleration_mps2 = follow.Number("max_deceleration_mps2");

  const config::DeclaredMap comfort = root.Child("comfort");
  a.speed.lateral_mps2 = comfort.Number("lateral_mps2");
  a.speed.vertical_mps2 = comfort.Number("vertical_mps2");
  a.speed.braking_mps2 = comfort.Number("braking_mps2");
  a.speed.steep_grade = comfort.Number("steep_grade");
  a.speed.steep_factor = comfort.Number("steep_factor");

  const config::DeclaredMap steering = root.Child("steering");
  a.steering.preview_s = steering.Number("preview_s");
  a.steering.preview_least_m = steering.Number("preview_least_m");
  a.steering.preview_most_m = steering.Number("preview_most_m");
  a.steering.understeer_radps2pm = steering.Number("understeer_radps2pm");
  a.steering.rate_radps = steering.Number("rate_radps");
  a.steering.smoothing_s = steering.Number("smoothing_s");
  if (a.steering.preview_most_m < a.steering.preview_least_m) {
    steering.map().Problem("preview_most_m", "config.wrong_order",
                           "'steering.preview_most_m' is below 'steering.preview_least_m'");
  }
  return a;
}

base::Result<AutopilotSettings> LoadDriver(const std::filesystem::path& path) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  const AutopilotSettings settings = ReadAutopilot(file.value().root());
  if (const base::Status status = file.value().Finish(); !status) return status.error();
  return settings;
}

}  // namespace rodeira::driver
