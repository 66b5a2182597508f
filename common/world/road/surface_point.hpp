// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/core/ground/ground.hpp"

namespace rodeira::road {

// The ground at a point as height and slopes: the upward normal is (-slope_x, -slope_y, 1), normalised.
struct SurfacePoint {
  double z_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
  double friction = 0.0;
  ground::Surface surface = ground::Surface::kOutside;
  bool inside = false;
};

// Coefficients by surface, indexed by the Surface's number; 1 is dry asphalt. The loose grounds are the adhesion
// coefficients that textbooks give (J. Y. Wong, Theory of Ground Vehicles, table 1.3: gravel 0.6, earth 0.65), paint is
// a little smoother than what it is painted on.
using FrictionTable = std::array<double, 7>;
inline constexpr FrictionTable kUsualFriction = {0.0, 1.0, 1.0, 0.6, 0.55, 0.65, 0.9};

}  // namespace rodeira::road
