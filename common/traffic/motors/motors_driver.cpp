// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motors/motors_driver.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFrames_Hz = 50.0;  // Unity's; the source states none
constexpr double kRpm = 2.0 * base::kPi / 60.0;
constexpr double kFree_deg = 10.0, kBend_deg = 20.0, kSharp_deg = 40.0;
constexpr double kBend_mps = 12.0, kSharp_mps = 5.0;
constexpr double kUp_radps = 1500.0 * kRpm, kDown_radps = 1100.0 * kRpm;
constexpr double kRevLimit_radps = 6500.0 * kRpm, kRevAgain_radps = 6300.0 * kRpm;
constexpr double kRamp_1ps = 0.08 * kFrames_Hz, kPause_s = 100.0 / kFrames_Hz;
constexpr double kIdleThrottle = 0.1, kStopBrake = 0.1;

// Of two points of a function the value between.
double Between(double x, double x0, double y0, double x1, double y1) { return y0 + (x - x0) / (x1 - x0) * (y1 - y0); }

}  // namespace

double TargetWeight(double distance_m) {
  return 2.0 / base::kPi * std::atan(2.0 * (0.5 * distance_m) * (0.5 * distance_m));
}

double SteeringAngle(double to_path_rad, double to_target_rad, double weight, double most_rad) {
  return std::clamp((to_path_rad + weight * to_target_rad) / (1.0 + weight), -most_rad, most_rad);
}

double TurningSpeed_mps(double angle_rad, double limit_mps) {
  const double angle = std::fabs(angle_rad) / base::kRadiansPerDegree;
  double speed = kSharp_mps;
  if (angle <= kFree_deg)
    speed = limit_mps;
  else if (angle <= kBend_deg)
    speed = Between(angle, kFree_deg, limit_mps, kBend_deg, kBend_mps);
  else if (angle <= kSharp_deg)
    speed = Between(angle, kBend_deg, kBend_mps, kSharp_deg, kSharp_mps);
  return std::min(speed, limit_mps);
}

double MotorsThrottle(double to_path_rad) {
  const double angle = to_path_rad / base::kRadiansPerDegree;
  return 0.5 * std::exp2(-0.0006 * angle * angle);
}

double MotorsBrake(double excess_mps, bool stops) {
  return std::min(1.0, 2.0 / base::kPi * std::atan(excess_mps) + (stops ? kStopBrake : 0.0));
}

bool SegmentsCross(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
                   const Eigen::Vector2d& b1) {
  const auto side = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& p) {
    return geometry::Cross(to - from, p - from);
  };
  return side(a0, a1, b0) * side(a0, a1, b1) < 0.0 && side(b0, b1, a0) * side(b0, b1, a1) < 0.0;
}

MotorsDriver::MotorsDriver(double responsiveness, double aggression_deg)
    : responsiveness_(responsiveness), aggression_radps_(aggression_deg * base::kRadiansPerDegree * kFrames_Hz) {}

void MotorsDriver::Begin(int gear) {
  *this = MotorsDriver(responsiveness_, aggression_radps_ / base::kRadiansPerDegree / kFrames_Hz);
  gear_ = std::max(1, gear);
}

// A change goes on: the clutch comes up evenly, without throttle. The next one waits for its pause.
void MotorsDriver::Shift(double engine_radps, int gears, double dt_s) {
  if (engine_radps > kRevLimit_radps)
    throttle_let_ = false;
  else if (engine_radps < kRevAgain_radps)
    throttle_let_ = true;
  if (changes_) {
    change_ += kRamp_1ps * dt_s;
    clutch_ = std::max(0.0, 1.0 - change_);
    throttle_let_ = false;
    if (change_ > 1.0) changes_ = false, change_ = 0.0;
  }
  pause_s_ = std::max(0.0, pause_s_ - dt_s);
  const int shift = engine_radps > kUp_radps ? 1 : engine_radps < kDown_radps ? -1 : 0;
  if (shift == 0 || pause_s_ > 0.0 || gear_ + shift < 1 || gear_ + shift > gears) return;
  gear_ += shift;
  changes_ = true;
  pause_s_ = kPause_s;
}

dynamics::Controls MotorsDriver::Step(const MotorsView& view, const MotorsCar& car, double dt_s) {
  const double wanted = responsiveness_ * SteeringAngle(view.to_path_rad, view.to_target_rad,
                                                        TargetWeight(view.distance_m), car.most_steer_rad);
  const double most = aggression_radps_ * dt_s;
  steer_rad_ += std::clamp(wanted - steer_rad_, -most, most);
  dynamics::Controls controls;
  const double target = view.stops ? 0.0 : TurningSpeed_mps(view.turn_rad, view.limit_mps);
  if (view.speed_mps < target)
    controls.throttle = MotorsThrottle(view.to_path_rad);
  else
    controls.brake = MotorsBrake(view.speed_mps - target, view.stops);
  if (view.engine_radps < car.stall_radps) controls.throttle += kIdleThrottle;
  Shift(view.engine_radps, car.gears, dt_s);
  if (!throttle_let_) controls.throttle = 0.0;
  const double slow =
      std::clamp((car.closed_radps - view.engine_radps) / (car.closed_radps - car.bite_radps), 0.0, 1.0);
  controls.clutch = std::max(changes_ ? clutch_ : 0.0, slow);
  controls.steering_wheel_rad = steer_rad_ * car.steering_ratio;
  controls.gear = gear_;
  controls.starter = !view.engine_runs;
  controls.gearbox = dynamics::GearboxMode::kManual;
  return controls;
}

void MotorsDriver::Save(base::StateWriter& writer) const {
  writer.Put("track", track);
  writer.Put("zero_m", zero_m);
  writer.Put("lanes", lanes);
  writer.Put("trip", trip);
  writer.Put("checkpoint", checkpoint);
  writer.Put("weight", weight);
  writer.Put("join_W", std::span<const double>(join_W.data(), 2));
  writer.Put("stops", stops);
  writer.Put("steer_rad", steer_rad_);
  writer.Put("gear", gear_);
  writer.Put("changes", changes_);
  writer.Put("change", change_);
  writer.Put("pause_s", pause_s_);
  writer.Put("clutch", clutch_);
  writer.Put("throttle_let", throttle_let_);
}

void MotorsDriver::Restore(base::StateReader& reader) {
  reader.Get("track", track);
  reader.Get("zero_m", zero_m);
  reader.Get("lanes", lanes);
  reader.Get("trip", trip);
  reader.Get("checkpoint", checkpoint);
  reader.Get("weight", weight);
  reader.Get("join_W", std::span<double>(join_W.data(), 2));
  reader.Get("stops", stops);
  reader.Get("steer_rad", steer_rad_);
  reader.Get("gear", gear_);
  reader.Get("changes", changes_);
  reader.Get("change", change_);
  reader.Get("pause_s", pause_s_);
  reader.Get("clutch", clutch_);
  reader.Get("throttle_let", throttle_let_);
}

}  // namespace rodeira::traffic
