// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/bare_terrain.hpp"

#include <cmath>

namespace rodeira::road {

SurfacePoint BareTerrain::At(double x_m, double y_m) const {
  if (grid != nullptr) {
    const terrain::GridSample sample = grid->At(x_m, y_m);
    if (!sample.inside) return {};
    return {sample.z_m, sample.slope_x, sample.slope_y, friction, surface, true};
  }
  if (!plane || !std::isfinite(x_m) || !std::isfinite(y_m)) return {};
  return {plane->z_m + plane->slope_x * x_m + plane->slope_y * y_m,
          plane->slope_x,
          plane->slope_y,
          friction,
          surface,
          true};
}

}  // namespace rodeira::road
