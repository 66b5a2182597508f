// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/assists/motion_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rodeira::assists {
namespace {

constexpr double kDrift_mps2 = 1.0;  // by which an integrated acceleration may be wrong
constexpr double kForget_s = 2.0;    // in which a lateral speed that is only integrated fades
constexpr double kForceSmooth_s = 0.03;
constexpr double kRollsFreely = 0.05;  // braking force over load
constexpr double kMinShare = 0.2;      // of the load at rest that a wheel is held to bear
constexpr double kBackward_mps = 0.5;  // faster, a car goes backward and does not only rock as it stops

double HalfTrack(const AssistCar& car, std::size_t wheel) {
  return (wheel % 2 == 0 ? 0.5 : -0.5) * car.track_m[wheel / 2];
}

// From the centre of gravity to the front axle.
double FrontArm(const AssistCar& car) {
  const double front = car.static_load_N[0] + car.static_load_N[1], rear = car.static_load_N[2] + car.static_load_N[3];
  return front + rear > 0.0 ? car.wheelbase_m * rear / (front + rear) : 0.5 * car.wheelbase_m;
}

}  // namespace

double MotionEstimator::GroundSpeed(const AssistCar& car, const AssistInput& input, std::size_t wheel) const {
  const double along = speed_mps_ - input.yaw_rate_radps * HalfTrack(car, wheel);
  if (wheel >= 2) return along;
  const double across = lateral_mps_ + input.yaw_rate_radps * FrontArm(car);
  return along * std::cos(input.front_wheel_rad) + across * std::sin(input.front_wheel_rad);
}

double MotionEstimator::Load(const AssistCar& car, const AssistInput& input, std::size_t wheel) const {
  const double along = car.mass_kg * input.forward_mps2 * car.cg_height_m / car.wheelbase_m;
  const double across = car.mass_kg * input.lateral_mps2 * car.cg_height_m / (car.track_m[0] + car.track_m[1]);
  const double load =
      car.static_load_N[wheel] + (wheel < 2 ? -0.5 : 0.5) * along + (wheel % 2 == 0 ? -1.0 : 1.0) * across;
  return std::max(load, kMinShare * car.static_load_N[wheel]);
}

void MotionEstimator::Step(const AssistCar& car, const AssistInput& input, const PerWheel& brake_Nm, double dt_s) {
  // Brakes that the driver does not press are those of the stability control, unless the engine pulls.
  const bool brakes = input.is_braking || (input.throttle == 0.0 &&
                                           std::ranges::any_of(brake_Nm, [](double torque) { return torque > 0.0; }));
  PerWheel by_wheel_mps{};
  double mean_mps = 0.0;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    by_wheel_mps[i] = input.wheel_radps[i] * car.rolling_radius_m + input.yaw_rate_radps * HalfTrack(car, i);
    mean_mps += 0.25 * by_wheel_mps[i];
  }
  // Speeds are counted along the way that the car goes, 1 forward, -1 backward; at standstill that its wheels turn.
  const double way = speed_mps_ + mean_mps < 0.0 ? -1.0 : 1.0;
  double fastest = 0.0, slowest = 1e9;
  std::size_t leads = 0;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    const double speed = way * by_wheel_mps[i];
    if (speed > fastest) fastest = speed, leads = i;
    slowest = std::min(slowest, speed);
  }
  slowest = std::max(0.0, slowest);
  const double carried = way * (speed_mps_ + dt_s * (input.forward_mps2 + input.yaw_rate_radps * lateral_mps_)),
               drift = dt_s * kDrift_mps2;
  lateral_mps_ += dt_s * (input.lateral_mps2 - input.yaw_rate_radps * speed_mps_ - lateral_mps_ / kForget_s);
  double speed = fastest;
  if (begun_ && brakes)  // a braked wheel turns too slowly, but one that is hardly braked is right
    speed = std::max(fastest, braking_N_[leads] < kRollsFreely * car.static_load_N[leads] ? carried - drift : carried);
  else if (begun_)  // a driven one too fast
    speed = std::clamp(slowest, carried - drift, carried + drift);
  speed_mps_ = way * speed;
  const double turns = speed_mps_ < -kBackward_mps ? -1.0 : 1.0;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    const double slows_radps2 = begun_ ? turns * (before_radps_[i] - input.wheel_radps[i]) / dt_s : 0.0;
    const double force = (brake_Nm[i] - car.wheel_inertia_kgm2 * slows_radps2) / car.rolling_radius_m;
    braking_N_[i] += (std::max(0.0, force) - braking_N_[i]) * dt_s / (kForceSmooth_s + dt_s);
  }
  before_radps_ = input.wheel_radps;
  begun_ = true;
}

void MotionEstimator::Save(base::StateWriter& writer) const {
  writer.Put("speed_mps", speed_mps_);
  writer.Put("lateral_mps", lateral_mps_);
  writer.Put("begun", begun_);
  writer.Put("before_radps", std::span<const double>(before_radps_));
  writer.Put("braking_N", std::span<const double>(braking_N_));
}

void MotionEstimator::Restore(base::StateReader& reader) {
  reader.Get("speed_mps", speed_mps_);
  reader.Get("lateral_mps", lateral_mps_);
  reader.Get("begun", begun_);
  reader.Get("before_radps", std::span<double>(before_radps_));
  reader.Get("braking_N", std::span<double>(braking_N_));
}

}  // namespace rodeira::assists
