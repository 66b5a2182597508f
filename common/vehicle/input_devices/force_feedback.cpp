// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/force_feedback.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::input_devices {
namespace {

constexpr double kSmooth_s = 0.03;

}  // namespace

// `passed_s` below 0: it begins anew, and what is now is what is usual.
double ForceFeedback::RoadFeel(double difference_N, double passed_s) {
  if (!std::isfinite(difference_N)) return 0.0;
  if (passed_s < 0.0)
    slow_N_ = difference_N;
  else
    slow_N_ += (difference_N - slow_N_) * passed_s / (passed_s + kFeelSlow_s);
  return std::clamp(settings_.road_feel * kFeelArm_m * (difference_N - slow_N_), -kFeelMost_Nm, kFeelMost_Nm);
}

double ForceFeedback::Step(const ForceMoment& moment, double now_s) {
  const double since_s = before_ ? now_s - before_->now_s : -1.0,
               passed_s = since_s > settings_.stale_s ? -1.0 : since_s;
  if (passed_s < 0.0) {
    fade_ = 0.0;
    speed_radps_ = 0.0;
  } else if (passed_s > 0.0) {
    fade_ = std::min(1.0, fade_ + passed_s / settings_.fade_s);
    const double speed_radps = (moment.wheel_rad - before_->wheel_rad) / passed_s;
    speed_radps_ += (speed_radps - speed_radps_) * passed_s / (passed_s + kSmooth_s);
  }
  before_ = Before{now_s, moment.wheel_rad};
  const double beyond_rad = std::max(std::fabs(moment.wheel_rad) - moment.lock_rad, 0.0);
  const double driven_Nm = settings_.share * moment.car_torque_Nm + RoadFeel(moment.front_load_difference_N, passed_s) -
                           settings_.friction_Nm * std::tanh(speed_radps_ / kStill_radps) -
                           settings_.damping_Nmsprad * speed_radps_;
  const double stop_Nm = -std::copysign(settings_.stop_Nmprad * beyond_rad, moment.wheel_rad);
  const double torque_Nm = fade_ * driven_Nm + stop_Nm;
  if (!std::isfinite(torque_Nm)) return 0.0;
  return std::clamp(torque_Nm, -settings_.most_Nm, settings_.most_Nm) / settings_.device_Nm;
}

}  // namespace rodeira::input_devices
