// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rodeira::geometry {

// Whether p lies within a closed chain of corners, which does not cross itself. Of two polygons that share a side, a
// point on it lies in exactly one.
bool InPolygon(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p);

}  // namespace rodeira::geometry
