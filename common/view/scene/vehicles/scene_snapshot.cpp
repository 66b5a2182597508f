// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/scene_snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/view/scene/vehicles/equal_ids.hpp"

namespace rodeira::scene {
namespace {

double InterpolateValue(double a, double b, double alpha) { return a + alpha * (b - a); }

// Angles are known up to full turns: the number of turns is the one that the speeds tell.
double BetweenSpins(double a_rad, double b_rad, double expected_rad, double alpha) {
  const double turned = expected_rad + geometry::WrapAngle(b_rad - a_rad - expected_rad);
  return geometry::WrapAngle(a_rad + alpha * turned);
}

WheelPose BetweenWheels(const WheelPose& a, const WheelPose& b, double alpha, double interval_s) {
  WheelPose wheel;
  wheel.hub_B = a.hub_B + alpha * (b.hub_B - a.hub_B);
  wheel.steer_rad = InterpolateValue(a.steer_rad, b.steer_rad, alpha);
  wheel.spin_rad = BetweenSpins(a.spin_rad, b.spin_rad, 0.5 * (a.spin_radps + b.spin_radps) * interval_s, alpha);
  wheel.spin_radps = InterpolateValue(a.spin_radps, b.spin_radps, alpha);
  return wheel;
}

// It was put elsewhere: no car drives so far.
bool WasPlaced(const CarPose& a, const CarPose& b, double interval_s) {
  constexpr double kFastest_mps = 150.0, kLeast_m = 1.0;
  return (b.p_WB_W - a.p_WB_W).norm() > kLeast_m + kFastest_mps * interval_s;
}

CarPose BetweenCars(const CarPose& a, const CarPose& b, double alpha, double interval_s) {
  CarPose car = alpha < 0.5 ? a : b;  // what does not move smoothly
  if (WasPlaced(a, b, interval_s)) return car;
  car.blow = std::max(a.blow, b.blow);
  car.p_WB_W = a.p_WB_W + alpha * (b.p_WB_W - a.p_WB_W);
  car.q_WB = a.q_WB.slerp(alpha, b.q_WB);
  car.speed_mps = InterpolateValue(a.speed_mps, b.speed_mps, alpha);
  car.engine_rpm = InterpolateValue(a.engine_rpm, b.engine_rpm, alpha);
  car.fuel_used_l = InterpolateValue(a.fuel_used_l, b.fuel_used_l, alpha);
  car.steering_wheel_rad = InterpolateValue(a.steering_wheel_rad, b.steering_wheel_rad, alpha);
  for (std::size_t i = 0; i < car.wheels.size(); ++i)
    car.wheels[i] = BetweenWheels(a.wheels[i], b.wheels[i], alpha, interval_s);
  return car;
}

AgentPose BetweenAgents(const AgentPose& a, const AgentPose& b, double alpha, double interval_s) {
  AgentPose agent = alpha < 0.5 ? a : b;
  agent.p_WB_W = a.p_WB_W + alpha * (b.p_WB_W - a.p_WB_W);
  agent.q_WB = a.q_WB.slerp(alpha, b.q_WB);
  agent.speed_mps = InterpolateValue(a.speed_mps, b.speed_mps, alpha);
  agent.steer_rad = InterpolateValue(a.steer_rad, b.steer_rad, alpha);
  agent.wheel_spin_rad = BetweenSpins(a.wheel_spin_rad, b.wheel_spin_rad,
                                      0.5 * (a.speed_mps + b.speed_mps) / a.wheel_radius_m * interval_s, alpha);
  return agent;
}

}  // namespace

Eigen::Quaterniond Attitude(double heading_rad, double pitch_rad, double roll_rad) {
  return Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

SceneSnapshot Interpolate(const SceneSnapshot& a, const SceneSnapshot& b, double alpha) {
  RODEIRA_ASSERT(alpha >= 0.0 && alpha <= 1.0);
  if (alpha == 0.0) return a;
  if (alpha == 1.0) return b;
  SceneSnapshot moment;
  moment.time_ns = a.time_ns + std::llround(alpha * static_cast<double>(b.time_ns - a.time_ns));
  const double interval_s = static_cast<double>(b.time_ns - a.time_ns) * 1e-9;
  ForEqualIds(a.cars, b.cars,
              [&](const CarPose& p, const CarPose& q) { moment.cars.push_back(BetweenCars(p, q, alpha, interval_s)); });
  ForEqualIds(a.agents, b.agents, [&](const AgentPose& p, const AgentPose& q) {
    moment.agents.push_back(BetweenAgents(p, q, alpha, interval_s));
  });
  moment.lights = alpha < 0.5 ? a.lights : b.lights;
  moment.weather = alpha < 0.5 ? a.weather : b.weather;
  return moment;
}

void PoseHistory::Add(SceneSnapshot moment) {
  if (!moments_.empty() && moments_.back().time_ns == moment.time_ns) moments_.pop_back();
  RODEIRA_ASSERT(moments_.empty() || moments_.back().time_ns < moment.time_ns);
  moments_.push_back(std::move(moment));
  if (moments_.size() > kKept) moments_.pop_front();
}

std::int64_t PoseHistory::interval_ns() const {
  return moments_.size() < 2 ? 0 : moments_.back().time_ns - moments_[moments_.size() - 2].time_ns;
}

SceneSnapshot PoseHistory::At(double time_ns) const {
  RODEIRA_ASSERT(!moments_.empty());
  if (time_ns <= static_cast<double>(moments_.front().time_ns)) return moments_.front();
  for (std::size_t i = 1; i < moments_.size(); ++i) {
    const auto from = static_cast<double>(moments_[i - 1].time_ns), to = static_cast<double>(moments_[i].time_ns);
    if (time_ns <= to)
      return Interpolate(moments_[i - 1], moments_[i], std::clamp((time_ns - from) / (to - from), 0.0, 1.0));
  }
  return moments_.back();
}

}  // namespace rodeira::scene
