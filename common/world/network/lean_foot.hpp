// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "common/world/network/lean.hpp"

// Where a leaning road's surface stands over a point with a known foot in plan: at the station, u further on, where the
// section's left e points to it. With the point's place as seen from there, `ahead` along T and `left` along N, and e =
// left_e N - back_e T, that is where
//   G(u) = ahead + m left = 0,   m = back_e / left_e,
// by ahead' = k left - 1 and left' = -k ahead. u is a few centimetres: a hundredth of t on a bank of 10 % that climbs
// by as much.
namespace rodeira::network {

// The way from the foot to u further on, in the foot's frame, and how far the line turns over it.
struct Onward {
  double ahead_m, left_m;
  double cosine, sine;
};
// On a straight line.
struct StraightOn {
  static constexpr double rate_1pm2 = 0.0;
  Onward operator()(double u_m, double) const { return {u_m, 0.0, 1.0, 0.0}; }
  bool Holds(double, double) const { return true; }
};
// On a line with a curvature k that changes by k' a metre: what follows is below 1e-13 u while it turns by less than
// kMaxTurn_rad, and k' u² is less than kMaxTwist.
struct BentOn {
  double rate_1pm2 = 0.0;
  static constexpr double kMaxTurn_rad = 0.02, kMaxTwist = 1e-4;
  Onward operator()(double u_m, double curvature_1pm) const {
    const double q = curvature_1pm * u_m, r = rate_1pm2 * u_m * u_m, turned = q + 0.5 * r;
    const double q2 = q * q, square = turned * turned;
    const double ahead = 1.0 - (q2 * (1.0 / 6.0) + q * r * (1.0 / 8.0) + r * r * (1.0 / 40.0)) +
                         q2 * q * (q * (1.0 / 120.0) + r * (1.0 / 72.0));
    const double left = (0.5 * q + r * (1.0 / 6.0)) - (q2 * (q * (1.0 / 24.0) + r * 0.05) + q * r * r * (1.0 / 48.0)) +
                        q2 * q2 * (q * (1.0 / 720.0) + r * (1.0 / 336.0));
    const double cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    const double sine = turned - turned * square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0)));
    return {ahead * u_m, left * u_m, cosine, sine};
  }
  // Whether the series is exact enough over u, where the curve has this curvature.
  bool Holds(double u_m, double curvature_1pm) const {
    return std::fabs(curvature_1pm * u_m) < kMaxTurn_rad && std::fabs(rate_1pm2 * u_m * u_m) < kMaxTwist;
  }
};

// How far the point lies to the left of the line there, t_m being how far it lies to the left of the foot.
inline double LeftOf(const Onward& way, double t_m) { return way.cosine * (t_m - way.left_m) + way.sine * way.ahead_m; }

constexpr double kLastLeanStep_m = 1e-7;  // Newton doubles the digits: what is left after such a step is rounding
constexpr int kMaxLeanSteps = 5;
constexpr double kMinLeanFall = 0.1;

// Newton's step from u, and -G' there.
struct LeanStep {
  double step_m, fall;
};
// t_m is the point's offset to the left of the line where u is 0.
inline LeanStep NextLeanStep(const Onward& way, double t_m, double curvature_1pm, const Lean& lean) {
  const double ahead = way.sine * (t_m - way.left_m) - way.cosine * way.ahead_m, left = LeftOf(way, t_m);
  const double inverse = 1.0 / lean.left, m = lean.back * inverse,
               m_1pm = (lean.back_1pm - m * lean.left_1pm) * inverse;
  const double fall = 1.0 - (curvature_1pm + m_1pm) * left + m * curvature_1pm * ahead;
  return {(ahead + m * left) / fall, fall};
}
// The first step, from the foot (ahead = 0, left = t), with what is known of G'' (all that m' does not change).
inline LeanStep FirstLeanStep(double t_m, double curvature_1pm, double rate_1pm2, const Lean& lean) {
  const double inverse = 1.0 / lean.left, m = lean.back * inverse,
               m_1pm = (lean.back_1pm - m * lean.left_1pm) * inverse;
  const double fall = 1.0 - (curvature_1pm + m_1pm) * t_m, inverse_fall = 1.0 / fall;
  const double step = m * t_m * inverse_fall, bend = rate_1pm2 * t_m + m * curvature_1pm * (1.0 - curvature_1pm * t_m);
  return {step + 0.5 * step * step * bend * inverse_fall, fall};
}

// t where the section's left points to the place.
inline double LeanT(const Onward& way, double t_m, const Lean& lean) { return LeftOf(way, t_m) * (1.0 / lean.left); }

}  // namespace rodeira::network
