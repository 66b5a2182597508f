// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/cubic_extremes.hpp"

#include <cmath>

namespace rodeira::opendrive {

// At an end, or where the derivative b + 2 c u + 3 d u^2 is 0.
Extreme LeastOf(const geometry::Cubic& cubic, double from, double to) {
  Extreme least{cubic.Value(from), from};
  const auto offer = [&](double x) {
    if (x > from && x <= to && cubic.Value(x) < least.value) least = {cubic.Value(x), x};
  };
  offer(to);
  const double root = cubic.c * cubic.c - 3.0 * cubic.b * cubic.d;
  if (root >= 0.0) {
    const double q = -(cubic.c + std::copysign(std::sqrt(root), cubic.c));
    if (cubic.d != 0.0) offer(cubic.from + q / (3.0 * cubic.d));
    if (q != 0.0) offer(cubic.from + cubic.b / q);
  }
  return least;
}

Extreme FarthestOf(const geometry::Cubic& cubic, double from, double to) {
  const Extreme low = LeastOf(cubic, from, to),
                below = LeastOf({cubic.from, -cubic.a, -cubic.b, -cubic.c, -cubic.d}, from, to);
  return std::fabs(low.value) > std::fabs(below.value) ? low : Extreme{-below.value, below.at};
}

}  // namespace rodeira::opendrive
