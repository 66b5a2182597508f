// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "common/core/geometry/cubic.hpp"
#include "common/core/geometry/small_angle.hpp"

namespace rodeira::network {

// All four coefficients are 0, to the bit.
inline bool IsZero(const geometry::Cubic& record) {
  return record.a == 0.0 && record.b == 0.0 && record.c == 0.0 && record.d == 0.0;
}

// The angle by which superelevation turns a cross-section, and its change a metre.
struct Roll {
  double sine, cosine;
  double slope_1pm;
};
// Of an angle within geometry::kSmallAngle.
inline Roll SmallRollAt(const geometry::Cubic& superelevation, double s_m) {
  const double angle = superelevation.Value(s_m);
  return {geometry::SmallSine(angle), geometry::SmallCosine(angle), superelevation.Slope(s_m)};
}
// Of any angle; small ones by SmallRollAt.
inline Roll RollAt(const geometry::Cubic& superelevation, double s_m) {
  const double angle = superelevation.Value(s_m);
  return {geometry::SineOf(angle), geometry::CosineOf(angle), superelevation.Slope(s_m)};
}

// The angle by which the reference line climbs, and what its sine and cosine change a metre.
struct Climb {
  double sine, cosine;
  double sine_1pm, cosine_1pm;
};
inline Climb ClimbAt(const geometry::Cubic& elevation, double s_m) {
  const double slope = elevation.Slope(s_m), bend = elevation.Bend(s_m);
  const double cosine = 1.0 / std::sqrt(1.0 + slope * slope), sine_1pm = bend * (cosine * cosine * cosine);
  return {slope * cosine, cosine, sine_1pm, -slope * sine_1pm};
}

// Of no elevation.
inline constexpr geometry::Cubic kLevel;

// The left of a cross-section turned about the climbing line, e = left N - back T + up z with the line's tangent T and
// left N in plan, and what these parts change a metre.
struct Lean {
  double left, back, up;
  double left_1pm, back_1pm, up_1pm;
};
inline Lean LeanOf(const Roll& roll, const Climb& climb) {
  const double turning = roll.cosine * roll.slope_1pm;
  return {roll.cosine,
          roll.sine * climb.sine,
          roll.sine * climb.cosine,
          -roll.sine * roll.slope_1pm,
          turning * climb.sine + roll.sine * climb.sine_1pm,
          turning * climb.cosine + roll.sine * climb.cosine_1pm};
}

// How a point at t of such a section moves with s and with t, seen from above: its parts along T and along N.
struct LeanPace {
  double ds_T, ds_N, dt_T, dt_N;
};
inline LeanPace PaceOf(const Lean& lean, double curvature_1pm, double t_m) {
  return {1.0 - t_m * (lean.left * curvature_1pm + lean.back_1pm), t_m * (lean.left_1pm - lean.back * curvature_1pm),
          -lean.back, lean.left};
}

}  // namespace rodeira::network
