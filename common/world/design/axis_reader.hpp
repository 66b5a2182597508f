// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/core/geometry/cubic.hpp"
#include "common/core/geometry/plan_axis.hpp"
#include "common/world/terrain/ground_move.hpp"

namespace rodeira::design {

// The largest kink between two elements of an axis, and between two roads that are joined.
inline constexpr double kMaxKink_rad = 1e-3;

// The axis of a road as a world file says it: elements that are chained or given by coordinates, or points.
struct AxisReading {
  std::vector<geometry::PlanElement> elements;
  std::optional<geometry::CubicTable> elevation;  // of points that have heights
  std::vector<std::string> warnings;              // curvature that jumps, gaps that are closed
};

// Reads 'start', and 'axis' or 'points'. What is wrong is a problem of the map's file; then there may be no elements.
// `move`: what becomes of places of the elevation file's map.
AxisReading ReadAxis(const config::DeclaredMap& road, const terrain::GroundMove& move = {});

// The chain moved and turned as a whole, so that its point at `own_s_m` comes to `to_W` with the heading given.
void Place(std::vector<geometry::PlanElement>& elements, double own_s_m, const Eigen::Vector2d& to_W,
           double heading_rad);

}  // namespace rodeira::design
