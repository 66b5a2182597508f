// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::geometry {

// Where a clothoid that starts at the origin along +x ends: the integral over s in [0, length] of
//   exp(i (k0 s + k1 s^2 / 2)) ds,  x the real part, y the imaginary one, in metres.
// k0 is the curvature at the start in 1/m, positive to the left; k1 its change along the length in 1/m^2. k1 = 0 is an
// arc, k0 = k1 = 0 a line, without a special case. Error about 1e-15 of the length (Gauss-Legendre, 12 nodes a radian
// of heading; no difference of Fresnel integrals, which cancels where k1 is tiny). A negative length runs backward.
Eigen::Vector2d ClothoidIntegral(double k0_1pm, double k1_1pm2, double length_m);

}  // namespace rodeira::geometry
