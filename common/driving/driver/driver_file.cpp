// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/autopilot.hpp"

namespace rodeira::driver {

AutopilotSettings ReadAutopilot(const config::Map& root) {
  using config::Range;
  AutopilotSettings a;
  (void)root.Choice("rodeira", {"driver/1"});
  (void)root.Text("name", "");
  a.speed_factor = root.Number("speed_factor", {0.1, 2.0}, a.speed_factor);
  a.anticipation_s = root.Number("anticipation_s", {0.0, 3.0}, a.anticipation_s);
  a.tracking_s = root.Number("tracking_s", {0.1, 10.0}, a.tracking_s);
  a.side_margin_m = root.Number("side_margin_m", {0.0, 2.0}, a.side_margin_m);
  a.range_m = root.Number("range_m", {10.0, 1000.0}, a.range_m);

  const config::Map follow = root.OptionalChild("following");
  a.idm.time_gap_s = follow.Number("time_gap_s", {0.2, 10.0}, a.idm.time_gap_s);
  a.idm.standing_gap_m = follow.Number("standing_gap_m", {0.5, 20.0}, a.idm.standing_gap_m);
  a.idm.acceleration_mps2 = follow.Number("acceleration_mps2", {0.2, 5.0}, a.idm.acceleration_mps2);
  a.idm.braking_mps2 = follow.Number("braking_mps2", {0.5, 8.0}, a.idm.braking_mps2);
  a.idm.hardest_mps2 = follow.Number("hardest_mps2", {1.0, 12.0}, a.idm.hardest_mps2);

  const config::Map comfort = root.OptionalChild("comfort");
  a.speed.lateral_mps2 = comfort.Number("lateral_mps2", {0.3, 8.0}, a.speed.lateral_mps2);
  a.speed.vertical_mps2 = comfort.Number("vertical_mps2", {0.3, 8.0}, a.speed.vertical_mps2);
  a.speed.braking_mps2 = comfort.Number("braking_mps2", {0.3, 6.0}, a.speed.braking_mps2);
  a.speed.steep_grade = comfort.Number("steep_grade", {0.0, 1.0}, a.speed.steep_grade);
  a.speed.steep_factor = comfort.Number("steep_factor", {0.2, 1.0}, a.speed.steep_factor);

  const config::Map steering = root.OptionalChild("steering");
  a.steering.preview_s = steering.Number("preview_s", {0.2, 3.0}, a.steering.preview_s);
  a.steering.preview_least_m = steering.Number("preview_least_m", {1.0, 20.0}, a.steering.preview_least_m);
  a.steering.preview_most_m = steering.Number("preview_most_m", {5.0, 100.0}, a.steering.preview_most_m);
  a.steering.understeer_radps2pm =
      steering.Number("understeer_radps2pm", {-0.05, 0.05}, a.steering.understeer_radps2pm);
  a.steering.rate_radps = steering.Number("rate_radps", {0.5, 30.0}, a.steering.rate_radps);
  a.steering.smoothing_s = steering.Number("smoothing_s", {0.0, 1.0}, a.steering.smoothing_s);
  if (a.steering.preview_most_m < a.steering.preview_least_m) {
    steering.Problem("preview_most_m", "config.wrong_order",
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
