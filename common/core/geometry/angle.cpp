// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/angle.hpp"

#include <cmath>

namespace rodeira::geometry {

double WrapAngle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);  // in [-pi, pi]
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace rodeira::geometry
