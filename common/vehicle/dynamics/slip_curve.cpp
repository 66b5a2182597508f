// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/slip_curve.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

// The parabola's slope at the origin, over the load.
double Slope(const SlipCurve& curve) { return 2.0 * curve.extremum_value / curve.extremum_slip; }

}  // namespace

double Evaluate(const SlipCurve& curve, double slip) {
  const double size = std::fabs(slip);
  double value = curve.asymptote_value;
  if (size < curve.extremum_slip) {
    const double s = size / curve.extremum_slip;
    value = curve.extremum_value * s * (2.0 - s);
  } else if (size < curve.asymptote_slip) {
    const double s = (size - curve.extremum_slip) / (curve.asymptote_slip - curve.extremum_slip);
    value += (curve.extremum_value - curve.asymptote_value) * (1.0 - s * s * (3.0 - 2.0 * s));
  }
  return std::copysign(value, slip);
}

TyreForces SteadyForces(const SlipCurveSettings& tyre, const TyreSlip& slip, double load_N, double friction) {
  if (!(load_N > 0.0) || !(friction > 0.0)) return {};
  const double x = slip.kappa / (friction * tyre.longitudinal.extremum_slip);
  const double y = slip.tan_alpha / (friction * tyre.lateral.extremum_slip);
  const double s = std::hypot(x, y);
  if (!(s > 0.0)) return {};
  const double bears = friction * load_N;
  return {bears * Evaluate(tyre.longitudinal, s * tyre.longitudinal.extremum_slip) * (x / s),
          -bears * Evaluate(tyre.lateral, s * tyre.lateral.extremum_slip) * (y / s)};
}

double LongitudinalStiffness(const SlipCurveSettings& tyre, double load_N) {
  return std::max(0.0, load_N) * Slope(tyre.longitudinal);
}
double CorneringStiffness(const SlipCurveSettings& tyre, double load_N) {
  return std::max(0.0, load_N) * Slope(tyre.lateral);
}
double LongitudinalPeak(const SlipCurveSettings& tyre, double load_N, double friction) {
  return friction * std::max(0.0, load_N) * tyre.longitudinal.extremum_value;
}
double LateralPeak(const SlipCurveSettings& tyre, double load_N, double friction) {
  return friction * std::max(0.0, load_N) * tyre.lateral.extremum_value;
}

}  // namespace rodeira::dynamics
