// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tmeasy_tyre.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kMinTransport = 1e-6;  // of r |omega| over |v|: a locked wheel's slip is finite

// A force at a load ratio: the parabola through 0 and the two given ones, not below 0.
double TmeasyForce(const std::array<double, 2>& at, double ratio) {
  return std::max(0.0, ratio * (2.0 * at[0] - 0.5 * at[1] - (at[0] - 0.5 * at[1]) * ratio));
}
double TmeasySlip(const std::array<double, 2>& at, double ratio) {
  return std::max(1e-3, at[0] + (at[1] - at[0]) * (ratio - 1.0));
}

struct TmeasyCurve {
  double slope_N, maximum_N, sliding_N, slip_max, slip_slide;
};

TmeasyCurve TmeasyCurveOf(const TmeasyDirection& direction, double ratio, double friction) {
  return {TmeasyForce(direction.slope_N, ratio), friction * TmeasyForce(direction.maximum_N, ratio),
          friction * TmeasyForce(direction.sliding_N, ratio), friction * TmeasySlip(direction.slip_max, ratio),
          friction * TmeasySlip(direction.slip_slide, ratio)};
}

// Between maximum and sliding two parabolas that meet smoothly, or a cubic where they do not fit in.
double FallingForce(const TmeasyCurve& c, double slope_N, double slip) {
  const double bend = c.maximum_N / c.slip_max * (c.maximum_N / c.slip_max) / (slope_N * c.slip_max);
  const double meet = c.slip_max + (c.maximum_N - c.sliding_N) / (bend * (c.slip_slide - c.slip_max));
  if (meet >= c.slip_slide) {
    const double s = (slip - c.slip_max) / (c.slip_slide - c.slip_max);
    return c.maximum_N - (c.maximum_N - c.sliding_N) * s * s * (3.0 - 2.0 * s);
  }
  if (slip <= meet) return c.maximum_N - bend * (slip - c.slip_max) * (slip - c.slip_max);
  const double other = bend * (meet - c.slip_max) / (c.slip_slide - meet);
  return c.sliding_N + other * (c.slip_slide - slip) * (c.slip_slide - slip);
}

double ForceAt(const TmeasyCurve& c, double slip) {
  if (!(c.maximum_N > 0.0)) return 0.0;
  if (slip >= c.slip_slide) return c.sliding_N;
  // A smaller slope could not reach the maximum at that slip.
  const double slope_N = std::max(c.slope_N, 2.0 * c.maximum_N / c.slip_max);
  if (slip >= c.slip_max) return FallingForce(c, slope_N, slip);
  const double s = slip / c.slip_max;
  return slope_N * slip / (1.0 + s * (s + slope_N * c.slip_max / c.maximum_N - 2.0));
}

}  // namespace

double TmeasyTyre::Ratio(double load_N) const {
  return std::clamp(load_N, 0.0, settings_.largest_N) / settings_.nominal_N;
}

TyreForces TmeasyTyre::Forces(const TyreSlip& slip, double load_N, double friction) const {
  if (!(load_N > 0.0) || !(friction > 0.0)) return {};
  const double transport = std::max(kMinTransport, std::fabs(1.0 + slip.kappa));
  const double sx = slip.kappa / transport, sy = -slip.tan_alpha / transport;
  const double s = std::hypot(sx, sy);
  if (!(s > 0.0)) return {};
  const double along = sx / s, across = sy / s;
  const TmeasyCurve x = TmeasyCurveOf(settings_.longitudinal, Ratio(load_N), friction);
  const TmeasyCurve y = TmeasyCurveOf(settings_.lateral, Ratio(load_N), friction);
  const auto both = [&](double of_x, double of_y) { return std::hypot(of_x * along, of_y * across); };
  const TmeasyCurve combined{both(x.slope_N, y.slope_N), both(x.maximum_N, y.maximum_N), both(x.sliding_N, y.sliding_N),
                             both(x.slip_max, y.slip_max), both(x.slip_slide, y.slip_slide)};
  const double force_N = ForceAt(combined, s);
  return {force_N * along, force_N * across};
}

double TmeasyTyre::LongitudinalStiffness(double load_N) const {
  const TmeasyCurve c = TmeasyCurveOf(settings_.longitudinal, Ratio(load_N), 1.0);
  return load_N > 0.0 ? std::max(c.slope_N, 2.0 * c.maximum_N / c.slip_max) : 0.0;
}
double TmeasyTyre::CorneringStiffness(double load_N) const {
  const TmeasyCurve c = TmeasyCurveOf(settings_.lateral, Ratio(load_N), 1.0);
  return load_N > 0.0 ? std::max(c.slope_N, 2.0 * c.maximum_N / c.slip_max) : 0.0;
}
double TmeasyTyre::LongitudinalPeak(double load_N, double friction) const {
  return friction * TmeasyForce(settings_.longitudinal.maximum_N, Ratio(load_N));
}
double TmeasyTyre::LateralPeak(double load_N, double friction) const {
  return friction * TmeasyForce(settings_.lateral.maximum_N, Ratio(load_N));
}

}  // namespace rodeira::dynamics
