// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/assists/traction_control.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rodeira::assists {

double TractionControl::Step(const TractionSettings& settings, const AssistCar& car, const AssistInput& input,
                             const MotionEstimator& motion, PerWheel& brake_Nm, double dt_s) {
  PerWheel slip{};
  double mean = 0.0;
  int driven = 0;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    if (!car.driven[i]) continue;
    // Along the way that the wheel turns: a wheel that turns backward against a ground that goes backward.
    const double turns = input.wheel_radps[i] * car.rolling_radius_m;
    const double ground = std::copysign(1.0, turns) * motion.GroundSpeed(car, input, i);
    slip[i] = (std::fabs(turns) - ground) / std::max(std::fabs(ground), settings.least_mps);
    mean += slip[i];
    ++driven;
  }
  if (driven == 0) return input.throttle;
  mean /= driven;
  throttle_ += dt_s * std::min(settings.open_ps, settings.cut_ps * (settings.slip - mean));
  throttle_ = std::clamp(throttle_, 0.0, 1.0);
  const bool helps = motion.speed_mps() < settings.most_brake_mps && input.throttle > 0.0 && !input.is_braking;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    if (!car.driven[i]) continue;
    // Of both wheels that spin the engine takes care.
    const bool alone = slip[i] > slip[i ^ 1u];
    const double rate = settings.brake_Nmps * (slip[i] - settings.brake_slip);
    brake_Nm_[i] += dt_s * (helps && (alone || rate < 0.0) ? rate : -settings.brake_Nmps);
    brake_Nm_[i] = std::clamp(brake_Nm_[i], 0.0, settings.most_brake_Nm);
    brake_Nm[i] += brake_Nm_[i];
  }
  return std::min(input.throttle, throttle_);
}

void TractionControl::Save(base::StateWriter& writer) const {
  writer.Put("throttle", throttle_);
  writer.Put("brake_Nm", std::span<const double>(brake_Nm_));
}

void TractionControl::Restore(base::StateReader& reader) {
  reader.Get("throttle", throttle_);
  reader.Get("brake_Nm", std::span<double>(brake_Nm_));
}

}  // namespace rodeira::assists
