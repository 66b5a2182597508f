// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::geometry {

inline constexpr double kPi = 3.14159265358979323846;

// The same direction in (-pi, pi]; exact for angles that lie there already.
double WrapAngle(double angle_rad);

}  // namespace rodeira::geometry
