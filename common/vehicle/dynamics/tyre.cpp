// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tyre.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kPeakReach = 3.0;  // peaks lie at two to three times D / K
constexpr double kSpeedReach =
    20.0;  // how far past D / K the deflection of a sliding tyre may go, a low_speed of motion
constexpr double kSlidingReach = 0.9;   // of a tyre that slides to a stop, nearly D / K
constexpr double kSticking_mps = 0.02;  // slower, a tyre that stands is pressed towards its peak
constexpr double kFadeInAir_s = 0.01;
constexpr double kTiny_N = 1.0;
constexpr double kTinyTwist_rad = 1e-12;

// 1 at standstill, 0 from low_speed on, smooth at both ends.
double LowSpeedShare(const TyreSettings& tyre, double vx_mps) {
  const double rest = 1.0 - std::min(1.0, std::fabs(vx_mps) / tyre.low_speed_mps);
  return rest * rest * (3.0 - 2.0 * rest);
}

// The largest slip that the deflection may stand for. At speed there is no bound in practice. A tyre that slides to a
// stop keeps the deflection D / K that its stiffness holds at the peak, and no more to throw the car back with. One
// that stands may be pressed just past its peak.
double SlipBound(double peak_N, double stiffness_N, double motion_mps, double low_speed_mps) {
  const double sticks = std::max(0.0, 1.0 - motion_mps / kSticking_mps);
  const double reach =
      kSlidingReach + kSpeedReach * motion_mps / low_speed_mps + (kPeakReach - kSlidingReach) * sticks * sticks;
  return reach * peak_N / std::max(stiffness_N, kTiny_N);
}

// The slip at which a tyre of full pressure has the same forces.
TyreSlip AtPressure(const TyreSettings& tyre, TyreSlip slip) {
  slip.kappa *= tyre.slip_share;
  slip.tan_alpha *= tyre.slip_share;
  return slip;
}

}  // namespace

std::array<TyreSettings, 4> OnWheels(const std::array<TyreSettings, 2>& axles) {
  std::array<TyreSettings, 4> wheels{axles[0], axles[0], axles[1], axles[1]};
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const bool left = i % 2 == 0;
    wheels[i].formula.mirrored = wheels[i].formula.measured_on == (left ? TyreSide::kRight : TyreSide::kLeft);
  }
  return wheels;
}

TyreForces SteadyForces(const TyreSettings& tyre, const TyreSlip& of, double load_N, double friction) {
  const TyreSlip slip = AtPressure(tyre, of);
  if (tyre.model) return tyre.model->Forces(slip, load_N, friction);
  return tyre.slip_curve ? SteadyForces(*tyre.slip_curve, slip, load_N, friction)
                         : SteadyForces(tyre.formula, slip, load_N, friction);
}
double LongitudinalStiffness(const TyreSettings& tyre, double load_N) {
  if (tyre.model) return tyre.slip_share * tyre.model->LongitudinalStiffness(load_N);
  return tyre.slip_share * (tyre.slip_curve ? LongitudinalStiffness(*tyre.slip_curve, load_N)
                                            : LongitudinalStiffness(tyre.formula, load_N));
}
double CorneringStiffness(const TyreSettings& tyre, double load_N) {
  if (tyre.model) return tyre.slip_share * tyre.model->CorneringStiffness(load_N);
  return tyre.slip_share *
         (tyre.slip_curve ? CorneringStiffness(*tyre.slip_curve, load_N) : CorneringStiffness(tyre.formula, load_N));
}
double LongitudinalPeak(const TyreSettings& tyre, double load_N, double friction) {
  if (tyre.model) return tyre.model->LongitudinalPeak(load_N, friction);
  return tyre.slip_curve ? LongitudinalPeak(*tyre.slip_curve, load_N, friction)
                         : LongitudinalPeak(tyre.formula, load_N, friction);
}
double LateralPeak(const TyreSettings& tyre, double load_N, double friction) {
  if (tyre.model) return tyre.model->LateralPeak(load_N, friction);
  return tyre.slip_curve ? LateralPeak(*tyre.slip_curve, load_N, friction)
                         : LateralPeak(tyre.formula, load_N, friction);
}

TyreForces SteadyForcesWithMoment(const TyreSettings& tyre, const TyreSlip& slip, double load_N, double friction) {
  if (tyre.aligning && !tyre.model && !tyre.slip_curve)
    return SteadyForcesWithMoment(tyre.formula, *tyre.aligning, AtPressure(tyre, slip), load_N, friction);
  TyreForces forces = SteadyForces(tyre, slip, load_N, friction);
  if (!(load_N > 0.0) || !(friction > 0.0)) return forces;
  if (tyre.aligning) {
    const double ratio = LongitudinalStiffness(tyre, load_N) / std::max(CorneringStiffness(tyre, load_N), kTiny_N);
    forces.aligning_Nm =
        -PneumaticTrail(tyre.formula, *tyre.aligning, AtPressure(tyre, slip), ratio, load_N, friction) *
        forces.lateral_N;
  } else if (tyre.pneumatic_trail_m > 0.0) {
    const double peak_N = LateralPeak(tyre, load_N, friction);
    const double sliding =
        peak_N > 0.0 ? std::fabs(slip.tan_alpha) * CorneringStiffness(tyre, load_N) / (3.0 * peak_N) : 1.0;
    forces.aligning_Nm = -tyre.pneumatic_trail_m * std::max(0.0, 1.0 - sliding) * forces.lateral_N;
  }
  return forces;
}

TurnedPatch TurnedPatchOf(const TyreSettings& tyre, double load_N, double friction) {
  if (!(load_N > 0.0)) return {};
  const double length_m = std::sqrt(load_N / tyre.formula.inflpres);
  TurnedPatch patch;
  patch.half_length_m = 0.5 * length_m;
  patch.stiffness_Nmprad = CorneringStiffness(tyre, load_N) * patch.half_length_m / 3.0;
  patch.most_Nm = LateralPeak(tyre, load_N, friction) * length_m / 3.0;
  return patch;
}

TyreSlip SteadySlip(const TyreSettings& tyre, const TyreMotion& motion, double load_N) {
  const double speed = std::fabs(motion.vx_mps);
  const double damping_N = speed * tyre.low_speed_damping_Nspm * LowSpeedShare(tyre, motion.vx_mps);
  return {-motion.vsx_mps / speed * (1.0 + damping_N / std::max(LongitudinalStiffness(tyre, load_N), kTiny_N)),
          motion.vsy_mps / speed * (1.0 + damping_N / std::max(CorneringStiffness(tyre, load_N), kTiny_N)),
          motion.camber_rad};
}

TyreForces Tyre::Forces(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction) {
  if (!(load_N > 0.0)) {
    slip_ = 0.0;
    slip_angle_tan_ = 0.0;
    return {};
  }
  const double standing = LowSpeedShare(tyre, motion.vx_mps);
  const double damping = tyre.low_speed_damping_Nspm * standing;
  slip_ = u_m_ / tyre.relaxation_longitudinal_m;
  slip_angle_tan_ = v_m_ / tyre.relaxation_lateral_m;
  if (damping > 0.0) {
    slip_ -= damping / std::max(LongitudinalStiffness(tyre, load_N), kTiny_N) * motion.vsx_mps;
    slip_angle_tan_ += damping / std::max(CorneringStiffness(tyre, load_N), kTiny_N) * motion.vsy_mps;
  }
  const TyreSlip slip{slip_, slip_angle_tan_, motion.camber_rad};
  TyreForces forces = standing < 1.0 ? SteadyForcesWithMoment(tyre, slip, load_N, friction)
                                     : SteadyForces(tyre, slip, load_N, friction);
  forces.aligning_Nm *= std::copysign(1.0 - standing, motion.vx_mps);
  if (std::fabs(twist_rad_) > kTinyTwist_rad) forces.aligning_Nm += TwistTorque(tyre, forces, load_N, friction);
  return forces;
}

// What the patch's twist gives while friction holds these forces, too.
double Tyre::TwistTorque(const TyreSettings& tyre, const TyreForces& forces, double load_N, double friction) const {
  const TurnedPatch patch = TurnedPatchOf(tyre, load_N, friction);
  const double along = LongitudinalPeak(tyre, load_N, friction), across = LateralPeak(tyre, load_N, friction);
  if (!(along > 0.0) || !(across > 0.0)) return 0.0;
  const double x = forces.longitudinal_N / along, y = forces.lateral_N / across;
  const double most_Nm = patch.most_Nm * std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
  return std::clamp(-patch.stiffness_Nmprad * twist_rad_, -most_Nm, most_Nm);
}

void Tyre::AdvanceTwist(const TyreSettings& tyre, double turned_rad, double rolled_m, double load_N, double friction) {
  if (turned_rad == 0.0 && twist_rad_ == 0.0) return;
  const TurnedPatch patch = TurnedPatchOf(tyre, load_N, friction);
  if (!(patch.stiffness_Nmprad > 0.0)) {
    twist_rad_ = 0.0;
    return;
  }
  const double most_rad = patch.most_Nm / patch.stiffness_Nmprad;
  twist_rad_ = std::clamp((twist_rad_ + turned_rad) / (1.0 + rolled_m / patch.half_length_m), -most_rad, most_rad);
}

void Tyre::Advance(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction, double dt_s) {
  if (!(load_N > 0.0)) return FadeInAir(dt_s);
  const double travel = std::fabs(motion.vx_mps) * dt_s;
  u_m_ = (u_m_ - dt_s * motion.vsx_mps) / (1.0 + travel / tyre.relaxation_longitudinal_m);
  v_m_ = (v_m_ + dt_s * motion.vsy_mps) / (1.0 + travel / tyre.relaxation_lateral_m);
  AdvanceTwist(tyre, dt_s * motion.turn_radps, travel, load_N, friction);
  CutNearThePeak(tyre, motion, load_N, friction);
}

void Tyre::Advance(const TyreSettings& tyre, const TyreMotion& before, const TyreMotion& after, double load_N,
                   double friction, double dt_s) {
  if (!(load_N > 0.0)) return FadeInAir(dt_s);
  const double half_s = 0.5 * dt_s;
  const double rolled = half_s * std::fabs(before.vx_mps), rolls = half_s * std::fabs(after.vx_mps);
  const double sigma_k = tyre.relaxation_longitudinal_m;
  const double sigma_a = tyre.relaxation_lateral_m;
  u_m_ = (u_m_ * (1.0 - rolled / sigma_k) - half_s * (before.vsx_mps + after.vsx_mps)) / (1.0 + rolls / sigma_k);
  v_m_ = (v_m_ * (1.0 - rolled / sigma_a) + half_s * (before.vsy_mps + after.vsy_mps)) / (1.0 + rolls / sigma_a);
  AdvanceTwist(tyre, half_s * (before.turn_radps + after.turn_radps), rolled + rolls, load_N, friction);
  CutNearThePeak(tyre, after, load_N, friction);
}

TyreForces Tyre::ForcesAfter(const TyreSettings& tyre, const TyreMotion& before, const TyreMotion& after, double load_N,
                             double friction, double dt_s) {
  Tyre then = *this;
  then.Advance(tyre, before, after, load_N, friction, dt_s);
  const TyreForces forces = then.Forces(tyre, after, load_N, friction);
  slip_ = then.slip_;
  slip_angle_tan_ = then.slip_angle_tan_;
  return forces;
}

void Tyre::FadeInAir(double dt_s) {
  const double left = std::max(0.0, 1.0 - dt_s / kFadeInAir_s);
  u_m_ *= left;
  v_m_ *= left;
  twist_rad_ *= left;
}

void Tyre::CutNearThePeak(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction) {
  const double moving = std::max({std::fabs(motion.vx_mps), std::fabs(motion.vsx_mps), std::fabs(motion.vsy_mps)});
  const double u_most =
      tyre.relaxation_longitudinal_m * SlipBound(LongitudinalPeak(tyre, load_N, friction),
                                                 LongitudinalStiffness(tyre, load_N), moving, tyre.low_speed_mps);
  const double v_most =
      tyre.relaxation_lateral_m *
      SlipBound(LateralPeak(tyre, load_N, friction), CorneringStiffness(tyre, load_N), moving, tyre.low_speed_mps);
  u_m_ = std::clamp(u_m_, -u_most, u_most);
  v_m_ = std::clamp(v_m_, -v_most, v_most);
}

void Tyre::SetToBear(const TyreSettings& tyre, const TyreForces& forces, double load_N, double friction,
                     double camber_rad) {
  Reset();
  if (!(load_N > 0.0)) return;
  const double along = std::max(LongitudinalStiffness(tyre, load_N), kTiny_N);
  const double across = std::max(CorneringStiffness(tyre, load_N), kTiny_N);
  const double kappa_most = kPeakReach * LongitudinalPeak(tyre, load_N, friction) / along;
  const double alpha_most = kPeakReach * LateralPeak(tyre, load_N, friction) / across;
  double kappa = 0.0;
  double alpha = 0.0;
  // The initial slope is the steepest, so each correction falls short and the iteration approaches from one side.
  for (int i = 0; i < 60; ++i) {
    const TyreForces now = SteadyForces(tyre, {kappa, alpha, camber_rad}, load_N, friction);
    kappa = std::clamp(kappa + (forces.longitudinal_N - now.longitudinal_N) / along, -kappa_most, kappa_most);
    alpha = std::clamp(alpha - (forces.lateral_N - now.lateral_N) / across, -alpha_most, alpha_most);
  }
  u_m_ = kappa * tyre.relaxation_longitudinal_m;
  v_m_ = alpha * tyre.relaxation_lateral_m;
}

void Tyre::SetToRoll(const TyreSettings& tyre, const TyreMotion& motion, double load_N, double friction) {
  Reset();
  const double speed = std::fabs(motion.vx_mps);
  if (speed < tyre.low_speed_mps) return;
  u_m_ = -tyre.relaxation_longitudinal_m * motion.vsx_mps / speed;
  v_m_ = tyre.relaxation_lateral_m * motion.vsy_mps / speed;
  Advance(tyre, motion, load_N, friction, 0.0);  // for the bounds
}

TyreMotion Tyre::SetToRollAndBear(const TyreSettings& tyre, const TyreForces& forces, double vx_mps, double load_N,
                                  double friction, double camber_rad) {
  SetToBear(tyre, forces, load_N, friction, camber_rad);
  if (!(load_N > 0.0)) return {vx_mps, 0.0, 0.0, camber_rad, 0.0};
  // Forces() adds the damping's part to the deflections' slip.
  const double damping_Nspm = tyre.low_speed_damping_Nspm * LowSpeedShare(tyre, vx_mps);
  u_m_ /= 1.0 + damping_Nspm * std::fabs(vx_mps) / std::max(LongitudinalStiffness(tyre, load_N), kTiny_N);
  v_m_ /= 1.0 + damping_Nspm * std::fabs(vx_mps) / std::max(CorneringStiffness(tyre, load_N), kTiny_N);
  const double speed = std::fabs(vx_mps);
  return {vx_mps, -speed * u_m_ / tyre.relaxation_longitudinal_m, speed * v_m_ / tyre.relaxation_lateral_m, camber_rad,
          0.0};
}

void Tyre::Save(base::StateWriter& writer) const {
  writer.Put("u_m", u_m_);
  writer.Put("v_m", v_m_);
  writer.Put("twist_rad", twist_rad_);
  writer.Put("slip", slip_);
  writer.Put("slip_angle_tan", slip_angle_tan_);
}

void Tyre::Restore(base::StateReader& reader) {
  reader.Get("u_m", u_m_);
  reader.Get("v_m", v_m_);
  reader.Get("twist_rad", twist_rad_);
  reader.Get("slip", slip_);
  reader.Get("slip_angle_tan", slip_angle_tan_);
}

}  // namespace rodeira::dynamics
