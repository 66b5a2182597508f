// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fiala_tyre.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {

TyreForces FialaTyre::Forces(const TyreSlip& slip, double load_N, double friction) const {
  if (!(load_N > 0.0) || !(friction > 0.0)) return {};
  const FialaSettings& s = settings_;
  const double whole = std::min(1.0, std::hypot(slip.kappa, slip.tan_alpha));
  const double bears_N = (s.umax - (s.umax - s.umin) * whole) * friction * load_N;
  const double kappa = std::fabs(slip.kappa), tan_alpha = std::fabs(slip.tan_alpha);
  const double linear_N = s.cslip_N * kappa;
  const double along_N = 2.0 * linear_N < bears_N ? linear_N : bears_N - bears_N * bears_N / (4.0 * linear_N);
  const double adhesion = std::max(0.0, 1.0 - s.calpha_N * tan_alpha / (3.0 * bears_N));
  const double across_N = bears_N * (1.0 - adhesion * adhesion * adhesion);
  return {std::copysign(along_N, slip.kappa), -std::copysign(across_N, slip.tan_alpha)};
}

double FialaTyre::LongitudinalStiffness(double load_N) const { return load_N > 0.0 ? settings_.cslip_N : 0.0; }
double FialaTyre::CorneringStiffness(double load_N) const { return load_N > 0.0 ? settings_.calpha_N : 0.0; }
double FialaTyre::LongitudinalPeak(double load_N, double friction) const {
  return friction * std::max(0.0, load_N) * settings_.umax;
}
double FialaTyre::LateralPeak(double load_N, double friction) const { return LongitudinalPeak(load_N, friction); }

}  // namespace rodeira::dynamics
