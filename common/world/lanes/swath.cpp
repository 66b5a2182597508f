// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/swath.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::lanes {

double HalfSwath_m(double curvature_1pm, const LargestCar& car) {
  constexpr double kTightest_m = 3.0, kStraight_m = 1e4;
  const double radius = 1.0 / std::max(std::fabs(curvature_1pm), 1.0 / kStraight_m);
  const double R = std::max(radius, kTightest_m);
  const double half_base = 0.5 * car.wheelbase_m, half_width = 0.5 * car.width_m, half_length = 0.5 * car.length_m;
  const double r = std::sqrt(R * R - half_base * half_base);
  return std::max(R - (r - half_width), std::hypot(r + half_width, half_length) - R);
}

}  // namespace rodeira::lanes
