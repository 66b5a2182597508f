// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "common/world/road/surface_point.hpp"
#include "common/world/road/world_spec.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::road {

// A world's terrain without any road: an elevation grid, a plane, or none.
struct BareTerrain {
  std::shared_ptr<const terrain::ElevationGrid> grid;  // one of these two, or neither
  std::optional<PlaneSpec> plane;
  ground::Surface surface = ground::Surface::kGrass;
  double friction = 0.0;

  // SUELO at (x, y) in W; the hint plays no part. Outside of the grid, on a void and without terrain it is no ground.
  SurfacePoint At(double x_m, double y_m) const;
};

}  // namespace rodeira::road
