// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace rodeira::geometry {

// Sine and cosine by their power series, to the last bit or the one before it, for |x| <= kSmallAngle: a few products,
// which the library's are not, and the same ones for many numbers at once.
inline constexpr double kSmallAngle = 0.3;
inline double SmallSine(double x) {
  const double q = x * x, q2 = q * q;
  const double high = (1.0 / 362880.0 - q * (1.0 / 39916800.0)) + q2 * (1.0 / 6227020800.0);
  const double low = (-1.0 / 6.0 + q * (1.0 / 120.0)) + q2 * (-1.0 / 5040.0 + q * high);
  return x + x * q * low;
}
inline double SmallCosine(double x) {
  const double q = x * x, q2 = q * q;
  const double high = (1.0 / 40320.0 - q * (1.0 / 3628800.0)) + q2 * (1.0 / 479001600.0);
  const double low = (1.0 / 24.0 - q * (1.0 / 720.0)) + q2 * high;
  return 1.0 - 0.5 * q + q2 * low;
}

// Of any angle, by the series where they hold.
inline double SineOf(double x) { return std::fabs(x) <= kSmallAngle ? SmallSine(x) : std::sin(x); }
inline double CosineOf(double x) { return std::fabs(x) <= kSmallAngle ? SmallCosine(x) : std::cos(x); }

}  // namespace rodeira::geometry
