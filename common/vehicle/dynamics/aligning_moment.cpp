// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/aligning_moment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/vehicle/dynamics/magic_formula_parts.hpp"

namespace rodeira::dynamics {
namespace {

using A = AligningSettings;
constexpr auto kAligning = std::to_array<AligningCoefficient>({{"UNLOADED_RADIUS", &A::unloaded_radius},
                                                               {"LTR", &A::ltr},
                                                               {"LRES", &A::lres},
                                                               {"LKZC", &A::lkzc},
                                                               {"LS", &A::ls},
                                                               {"LGAZ", &A::lgaz},
                                                               {"QBZ1", &A::qbz1},
                                                               {"QBZ2", &A::qbz2},
                                                               {"QBZ3", &A::qbz3},
                                                               {"QBZ4", &A::qbz4},
                                                               {"QBZ5", &A::qbz5},
                                                               {"QBZ9", &A::qbz9},
                                                               {"QBZ10", &A::qbz10},
                                                               {"QCZ1", &A::qcz1},
                                                               {"QDZ1", &A::qdz1},
                                                               {"QDZ2", &A::qdz2},
                                                               {"QDZ3", &A::qdz3},
                                                               {"QDZ4", &A::qdz4},
                                                               {"QDZ6", &A::qdz6},
                                                               {"QDZ7", &A::qdz7},
                                                               {"QDZ8", &A::qdz8},
                                                               {"QDZ9", &A::qdz9},
                                                               {"QDZ10", &A::qdz10},
                                                               {"QDZ11", &A::qdz11},
                                                               {"QEZ1", &A::qez1},
                                                               {"QEZ2", &A::qez2},
                                                               {"QEZ3", &A::qez3},
                                                               {"QEZ4", &A::qez4},
                                                               {"QEZ5", &A::qez5},
                                                               {"QHZ1", &A::qhz1},
                                                               {"QHZ2", &A::qhz2},
                                                               {"QHZ3", &A::qhz3},
                                                               {"QHZ4", &A::qhz4},
                                                               {"PPZ1", &A::ppz1},
                                                               {"PPZ2", &A::ppz2},
                                                               {"SSZ1", &A::ssz1},
                                                               {"SSZ2", &A::ssz2},
                                                               {"SSZ3", &A::ssz3},
                                                               {"SSZ4", &A::ssz4}});

// The slip angle that combined slip amounts to, with the sign of the shifted one.
double Equivalent(double shifted, double longitudinal) {
  return std::copysign(std::atan(std::hypot(std::tan(shifted), longitudinal)), shifted);
}

// What trail, residual moment and arm have in common. `slip` is as measured.
struct AligningState {
  double fz, dfz, dpi, mu, gamma, forward;
};

AligningState StateOf(const MagicFormulaSettings& tyre, const AligningSettings& a, const TyreSlip& slip, double load_N,
                      double friction) {
  const bool is_old = tyre.version == MagicFormulaVersion::k52;
  const double fz = std::min(load_N, tyre.fzmax), fz0 = tyre.fnomin * tyre.lfzo;
  return {fz,
          (fz - fz0) / fz0,
          (tyre.inflpres - tyre.nompres) / tyre.nompres,
          tyre.lmuy * friction,
          slip.camber_rad * (is_old ? a.lgaz : 1.0),
          1.0 / std::sqrt(1.0 + slip.tan_alpha * slip.tan_alpha)};
}

double TrailOf(const MagicFormulaSettings& tyre, const AligningSettings& a, const AligningState& s,
               const TyreSlip& slip, double longitudinal) {
  const double shift = a.qhz1 + a.qhz2 * s.dfz + (a.qhz3 + a.qhz4 * s.dfz) * s.gamma;
  const double alpha = slip.tan_alpha + shift;
  const double b = (a.qbz1 + a.qbz2 * s.dfz + a.qbz3 * s.dfz * s.dfz) *
                   (1.0 + a.qbz4 * s.gamma + a.qbz5 * std::fabs(s.gamma)) * tyre.lky / s.mu;
  const double d = s.fz * (a.qdz1 + a.qdz2 * s.dfz) * (1.0 - a.ppz1 * s.dpi) *
                   (1.0 + a.qdz3 * s.gamma + a.qdz4 * s.gamma * s.gamma) * a.unloaded_radius / tyre.fnomin * a.ltr;
  const double e =
      std::min(1.0, (a.qez1 + a.qez2 * s.dfz + a.qez3 * s.dfz * s.dfz) *
                        (1.0 + (a.qez4 + a.qez5 * s.gamma) * (2.0 / geometry::kPi) * std::atan(b * a.qcz1 * alpha)));
  const double bx = b * Equivalent(alpha, longitudinal);
  return d * std::cos(a.qcz1 * std::atan(bx - e * (bx - std::atan(bx)))) * s.forward;
}

}  // namespace

std::span<const AligningCoefficient> AligningCoefficients() { return kAligning; }

TyreForces SteadyForcesWithMoment(const MagicFormulaSettings& tyre, const AligningSettings& a, const TyreSlip& mounted,
                                  double load_N, double friction) {
  if (!(load_N > 0.0)) return {};
  const double side = tyre.mirrored ? -1.0 : 1.0;
  const TyreSlip slip{mounted.kappa, side * mounted.tan_alpha, side * mounted.camber_rad};
  const MagicFormulaParts parts = PartsOf(tyre, slip, load_N, friction);
  TyreForces forces{parts.forces.longitudinal_N, side * parts.forces.lateral_N, 0.0};
  if (!(friction > 0.0)) return forces;
  const AligningState s = StateOf(tyre, a, slip, load_N, friction);
  const double longitudinal = parts.slip_stiffness_N / parts.cornering_stiffness_N * slip.kappa;
  const double trail_m = TrailOf(tyre, a, s, slip, longitudinal);

  const double alpha_r = slip.tan_alpha + parts.shift_horizontal + parts.shift_vertical_N / parts.cornering_stiffness_N;
  const double b_residual = a.qbz9 * tyre.lky / s.mu + a.qbz10 * parts.stiffness_over_peak;
  const double by_camber =
      ((a.qdz8 + a.qdz9 * s.dfz) * (1.0 + a.ppz2 * s.dpi) + (a.qdz10 + a.qdz11 * s.dfz) * std::fabs(s.gamma)) *
      s.gamma * a.lkzc;
  const double d_residual =
      s.fz * a.unloaded_radius * ((a.qdz6 + a.qdz7 * s.dfz) * a.lres + by_camber) * s.mu * s.forward;
  const double residual_Nm = d_residual * std::cos(std::atan(b_residual * Equivalent(alpha_r, longitudinal)));

  const double arm_m = a.unloaded_radius *
                       (a.ssz1 + a.ssz2 * parts.forces.lateral_N / tyre.fnomin + (a.ssz3 + a.ssz4 * s.dfz) * s.gamma) *
                       a.ls;
  forces.aligning_Nm = side * (-trail_m * parts.trail_lateral_N + residual_Nm + arm_m * parts.forces.longitudinal_N);
  return forces;
}

double AligningMoment(const MagicFormulaSettings& tyre, const AligningSettings& aligning, const TyreSlip& slip,
                      double load_N, double friction) {
  return SteadyForcesWithMoment(tyre, aligning, slip, load_N, friction).aligning_Nm;
}

double PneumaticTrail(const MagicFormulaSettings& tyre, const AligningSettings& aligning, const TyreSlip& slip,
                      double stiffness_ratio, double load_N, double friction) {
  return TrailOf(tyre, aligning, StateOf(tyre, aligning, slip, load_N, friction), slip, stiffness_ratio * slip.kappa);
}

}  // namespace rodeira::dynamics
