// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::geometry {

// An arc tangent by its power series, to the last bit or the one before it, for |x| <= kSmallTangent: a panel of an arc
// turns by half a radian at most.
inline constexpr double kSmallTangent = 0.13;
inline double SmallArcTangent(double x) {
  const double q = x * x, q2 = q * q;
  const double high = (1.0 / 9.0 - q / 11.0) + q2 * ((1.0 / 13.0 - q / 15.0) + q2 * (1.0 / 17.0));
  const double low = (-1.0 / 3.0 + q / 5.0) + q2 * (-1.0 / 7.0 + q * high);
  return x + x * q * low;
}

}  // namespace rodeira::geometry
