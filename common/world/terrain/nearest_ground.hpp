// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::terrain {

// The place with ground that is nearest to (x, y), the middle of a cell; where there is one, a place with ground 3 m
// about it. (x, y) itself where it has ground. Nothing where all is void.
std::optional<Eigen::Vector2d> NearestGround(const ElevationGrid& grid, double x_m, double y_m);

}  // namespace rodeira::terrain
