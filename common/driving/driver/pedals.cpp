// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/pedals.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::driver {
namespace {

constexpr double kRolling_mps = 0.03;
constexpr double kGentle_1ps = 0.5;
constexpr double kMaxLag_mps = 0.8;
constexpr double kMaxTrim_mps2 = 1.5;

double Toward(double now, double wanted, double most) { return now + std::clamp(wanted - now, -most, most); }

}  // namespace

void Pedals::Step(const PedalSettings& settings, double wanted_mps2, double speed_mps, double grade, double dt_s) {
  if (standing_ && wanted_mps2 > kGoes_mps2) standing_ = false;
  if (!standing_ && wanted_mps2 < kGoes_mps2 && std::fabs(speed_mps) < kEnds_mps) standing_ = true;
  const double climb = base::kGravity_mps2 * grade / std::sqrt(1.0 + grade * grade);
  if (standing_) {
    reference_mps_ = 0.0;
    trim_mps2_ = 0.0;
    const double hold = std::min(1.0, settings.holding_brake + 1.5 * std::fabs(climb) / settings.full_brake_mps2);
    throttle_ = 0.0;
    // Still rolling it comes to rest without a jerk; then the brake is set before a hill takes over.
    brake_ = Toward(brake_, hold, (speed_mps > kRolling_mps ? kGentle_1ps : settings.brake_rate_1ps) * dt_s);
    return;
  }
  reference_mps_ = std::clamp(reference_mps_ + wanted_mps2 * dt_s, speed_mps - kMaxLag_mps, speed_mps + kMaxLag_mps);
  reference_mps_ = std::max(reference_mps_, 0.0);
  const double lag = reference_mps_ - speed_mps;
  trim_mps2_ = std::clamp(trim_mps2_ + settings.trim_1ps2 * lag * dt_s, -kMaxTrim_mps2, kMaxTrim_mps2);

  const double resisting = settings.rolling_mps2 + settings.air_1pm * speed_mps * speed_mps + climb;
  const double needed = wanted_mps2 + resisting + settings.follow_1ps * lag + trim_mps2_;
  const double available = std::min(settings.most_mps2, settings.power_Wpkg / std::max(1.0, std::fabs(speed_mps)));
  const double throttle = std::clamp(needed / available, 0.0, 1.0);
  const double brake = std::clamp((-needed - settings.coasting_mps2) / settings.full_brake_mps2, 0.0, 1.0);
  throttle_ = Toward(throttle_, throttle, settings.throttle_rate_1ps * dt_s);
  // On a hill the brake is let go as the engine takes over.
  const double kept =
      climb > 0.0 && speed_mps < kEnds_mps ? 1.5 * (climb - throttle_ * available) / settings.full_brake_mps2 : 0.0;
  brake_ = Toward(brake_, std::max(brake, kept), settings.brake_rate_1ps * dt_s);
  if (brake_ > 0.0 && throttle == 0.0) throttle_ = 0.0;
}

void Pedals::InitialiseFrom(double throttle, double brake) {
  InitialiseFrom(throttle, brake, 0.0);
}  // Step holds the reference near the speed

void Pedals::InitialiseFrom(double throttle, double brake, double speed_mps) {
  throttle_ = throttle;
  brake_ = brake;
  reference_mps_ = speed_mps;
  trim_mps2_ = 0.0;
  standing_ = false;
}

void Pedals::Save(base::StateWriter& writer) const {
  writer.Put("throttle", throttle_);
  writer.Put("brake", brake_);
  writer.Put("reference_mps", reference_mps_);
  writer.Put("trim_mps2", trim_mps2_);
  writer.Put("standing", standing_);
}

void Pedals::Restore(base::StateReader& reader) {
  reader.Get("throttle", throttle_);
  reader.Get("brake", brake_);
  reader.Get("reference_mps", reference_mps_);
  reader.Get("trim_mps2", trim_mps2_);
  reader.Get("standing", standing_);
}

}  // namespace rodeira::driver
