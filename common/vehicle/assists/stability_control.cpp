// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/assists/stability_control.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::assists {
namespace {

constexpr double kRearShare = 0.4;  // of the outer front brake's torque that the outer rear one gets

}  // namespace

double StabilityControl::Step(const StabilitySettings& settings, const AssistCar& car, const AssistInput& input,
                              const MotionEstimator& motion, double throttle, PerWheel& brake_Nm, double dt_s) {
  const double v = motion.speed_mps(), over = v / settings.characteristic_mps;
  double wanted = v * input.front_wheel_rad / (car.wheelbase_m * (1.0 + over * over));
  const double most = (std::fabs(input.lateral_mps2) + settings.margin_mps2) / std::max(v, 1.0);
  wanted = std::clamp(wanted, -most, most);
  wanted_radps_ += (wanted - wanted_radps_) * dt_s / (settings.lag_s + dt_s);
  if (v < settings.min_speed_mps) return throttle;
  // Cars differ in how much they understeer: none is off that turns less than a neutral one and more than the wanted.
  const double neutral = std::clamp(wanted_radps_ * (1.0 + over * over), -most, most);
  const auto [least, largest] = std::minmax(wanted_radps_, neutral);
  const double off = input.yaw_rate_radps - std::clamp(input.yaw_rate_radps, least, largest);
  const double beyond = off - std::clamp(off, -settings.dead_radps, settings.dead_radps);
  if (beyond == 0.0) return throttle;
  // Turning on the spot faster than the way bends: the sideslip grows.
  const double slip_rate = input.yaw_rate_radps - input.lateral_mps2 / v;
  const bool too_much = beyond * input.yaw_rate_radps > 0.0;
  double moment = settings.gain_Nmspr * std::fabs(beyond);
  if (too_much && slip_rate * beyond > 0.0) moment += settings.slip_rate_gain_Nms * std::fabs(slip_rate);
  const bool brakes_left = beyond < 0.0;  // the car shall turn to the left
  const double torque = moment * car.rolling_radius_m / (0.5 * car.track_m[0]);
  if (too_much) {
    brake_Nm[brakes_left ? 0 : 1] += std::min(torque, settings.most_Nm);
    brake_Nm[brakes_left ? 2 : 3] += std::min(kRearShare * torque, settings.most_Nm);
    return 0.0;
  }
  brake_Nm[brakes_left ? 2 : 3] += std::min(0.5 * torque, 0.3 * settings.most_Nm);
  return 0.5 * throttle;
}

void StabilityControl::Save(base::StateWriter& writer) const { writer.Put("wanted_radps", wanted_radps_); }
void StabilityControl::Restore(base::StateReader& reader) { reader.Get("wanted_radps", wanted_radps_); }

}  // namespace rodeira::assists
