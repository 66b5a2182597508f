// SPDX-License-Identifier: Apache-2.0
#include "common/world/terrain/nearest_ground.hpp"

#include <limits>

namespace rodeira::terrain {

std::optional<Eigen::Vector2d> NearestGround(const ElevationGrid& grid, double x_m, double y_m) {
  if (grid.At(x_m, y_m).inside) return Eigen::Vector2d(x_m, y_m);
  constexpr double kAbout_m = 3.0;
  const auto has_ground_about = [&](const Eigen::Vector2d& p) {
    for (int side = 0; side < 9; ++side) {
      if (!grid.At(p.x() + kAbout_m * (side % 3 - 1), p.y() + kAbout_m * (side / 3 - 1)).inside) return false;
    }
    return true;
  };
  const ElevationGrid::Frame& frame = grid.frame();
  std::optional<Eigen::Vector2d> nearest, alone;
  double of_nearest = std::numeric_limits<double>::infinity(), of_alone = of_nearest;
  for (int column = 0; column + 1 < frame.columns; ++column) {
    for (int row = 0; row + 1 < frame.rows; ++row) {
      const Eigen::Vector2d p(frame.west_m + (column + 0.5) * grid.spacing_x_m(),
                              frame.south_m + (row + 0.5) * grid.spacing_y_m());
      const double distance = (p - Eigen::Vector2d(x_m, y_m)).squaredNorm();
      if (distance >= of_nearest || !grid.At(p.x(), p.y()).inside) continue;
      if (distance < of_alone) alone = p, of_alone = distance;
      if (has_ground_about(p)) nearest = p, of_nearest = distance;
    }
  }
  return nearest ? nearest : alone;
}

}  // namespace rodeira::terrain
