// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/controls.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

double CutTo(double value, double low, double high) { return std::isnan(value) ? 0.0 : std::clamp(value, low, high); }

}  // namespace

Controls Clamp(const Controls& controls) {
  constexpr double kAnyWheel_rad = 100.0;  // the car's own stops are nearer
  Controls cut = controls;
  cut.steering_wheel_rad = CutTo(controls.steering_wheel_rad, -kAnyWheel_rad, kAnyWheel_rad);
  cut.throttle = CutTo(controls.throttle, 0.0, 1.0);
  cut.brake = CutTo(controls.brake, 0.0, 1.0);
  cut.clutch = CutTo(controls.clutch, 0.0, 1.0);
  cut.handbrake = CutTo(controls.handbrake, 0.0, 1.0);
  cut.gear = std::max(controls.gear, -1);
  cut.gearbox = controls.gearbox == GearboxMode::kManual ? GearboxMode::kManual : GearboxMode::kAutomatic;
  return cut;
}

void Controls::Save(base::StateWriter& writer) const {
  writer.Put("steering_wheel_rad", steering_wheel_rad);
  writer.Put("throttle", throttle);
  writer.Put("brake", brake);
  writer.Put("clutch", clutch);
  writer.Put("handbrake", handbrake);
  writer.Put("gear", gear);
  writer.Put("gearbox", gearbox);
  writer.Put("starter", starter);
}

void Controls::Restore(base::StateReader& reader) {
  reader.Get("steering_wheel_rad", steering_wheel_rad);
  reader.Get("throttle", throttle);
  reader.Get("brake", brake);
  reader.Get("clutch", clutch);
  reader.Get("handbrake", handbrake);
  reader.Get("gear", gear);
  reader.Get("gearbox", gearbox);
  reader.Get("starter", starter);
}

}  // namespace rodeira::dynamics
