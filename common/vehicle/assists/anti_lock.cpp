// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/assists/anti_lock.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rodeira::assists {
namespace {

constexpr double kDamping = 1.8;  // twice the damping ratio
constexpr double kFree = -1.0;
constexpr double kBelief_s = 0.15;
constexpr double kStabilitySlip = 0.3;     // of a wheel that the stability control brakes: it shall give up side force
constexpr double kMinGain_Nmps = 60000.0;  // a unit of slip: on the stable branch the torque must follow the tyre's
constexpr double kFarBelow = 0.7;          // a front brake's torque against the other one's

// Above 0 where it has the direction in which the car goes: a car that goes backward is braked as one that goes
// forward.
double AlongWay(const MotionEstimator& motion, double forward) { return motion.speed_mps() < 0.0 ? -forward : forward; }

}  // namespace

// In proportion to the friction that the tyre has found, as the slip of its largest force is. A braking force that is
// larger than expected is believed at once, a smaller one after a while, for it may still grow.
double AntiLock::SlipWanted(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
                            const MotionEstimator& motion, std::size_t wheel, double dt_s) {
  if (!input.is_braking) return kStabilitySlip;
  const double found = motion.braking_N()[wheel] / motion.Load(car, input, wheel);
  double& friction = friction_[wheel];
  if (found > friction)
    friction = found;
  else if (acts(wheel))
    friction += (found - friction) * dt_s / (kBelief_s + dt_s);
  else
    friction = 1.0;
  friction = std::min(friction, 1.0);
  return std::clamp(settings.slip * friction, settings.min_slip, settings.slip);
}

void AntiLock::Control(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
                       const MotionEstimator& motion, std::size_t wheel, double wanted_Nm, double dt_s) {
  const double ground = AlongWay(motion, motion.GroundSpeed(car, input, wheel)), before = slip_[wheel];
  const bool is_slow = ground <= settings.min_speed_mps;
  slip_[wheel] = is_slow ? 0.0 : 1.0 - AlongWay(motion, input.wheel_radps[wheel]) * car.rolling_radius_m / ground;
  double& cap_Nm = cap_Nm_[wheel];
  if (is_slow || !(wanted_Nm > 0.0)) {
    cap_Nm = kFree;
    return;
  }
  const double wanted_slip = SlipWanted(settings, car, input, motion, wheel, dt_s);
  if (!acts(wheel)) {
    if (slip_[wheel] < wanted_slip) return;
    cap_Nm = std::min(wanted_Nm, given_Nm_[wheel]);
  }
  const double w = std::min(settings.fast_radps, 0.5 * ground / settings.relaxation_m);
  const double per_slip = car.wheel_inertia_kgm2 * ground / car.rolling_radius_m;
  const double gain = std::max(per_slip * w * w, kMinGain_Nmps), damping = kDamping * std::sqrt(gain * per_slip);
  const double rate_Nmps = gain * (wanted_slip - slip_[wheel]) - damping * (slip_[wheel] - before) / dt_s;
  cap_Nm = std::max(0.0, cap_Nm + dt_s * std::clamp(rate_Nmps, -settings.release_Nmps, settings.build_Nmps));
  if (cap_Nm > wanted_Nm) cap_Nm = kFree;
}

PerWheel AntiLock::Step(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
                        const MotionEstimator& motion, const PerWheel& wanted_Nm, double dt_s) {
  PerWheel brake_Nm = wanted_Nm;
  for (std::size_t i = 0; i < kAssistWheels; ++i) {
    Control(settings, car, input, motion, i, wanted_Nm[i], dt_s);
    if (acts(i)) brake_Nm[i] = cap_Nm_[i];
    if (AlongWay(motion, motion.GroundSpeed(car, input, i)) > settings.min_speed_mps)
      brake_Nm[i] = std::min(brake_Nm[i], given_Nm_[i] + dt_s * settings.build_Nmps);
  }
  if (wanted_Nm[2] == wanted_Nm[3]) brake_Nm[2] = brake_Nm[3] = std::min(brake_Nm[2], brake_Nm[3]);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t other = i ^ 1u;
    if (acts(other) && brake_Nm[other] < kFarBelow * brake_Nm[i])
      brake_Nm[i] = std::min(brake_Nm[i], std::max(given_Nm_[i], brake_Nm[other]) + dt_s * settings.yaw_delay_Nmps);
  }
  given_Nm_ = brake_Nm;
  return brake_Nm;
}

void AntiLock::Save(base::StateWriter& writer) const {
  writer.Put("cap_Nm", std::span<const double>(cap_Nm_));
  writer.Put("slip", std::span<const double>(slip_));
  writer.Put("given_Nm", std::span<const double>(given_Nm_));
  writer.Put("friction", std::span<const double>(friction_));
}

void AntiLock::Restore(base::StateReader& reader) {
  reader.Get("cap_Nm", std::span<double>(cap_Nm_));
  reader.Get("slip", std::span<double>(slip_));
  reader.Get("given_Nm", std::span<double>(given_Nm_));
  reader.Get("friction", std::span<double>(friction_));
}

}  // namespace rodeira::assists
