// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

using Ring = std::vector<Eigen::Vector3d>;

// A closed surface through rings (cross sections) with equal numbers of points, with flat caps on the first and the
// last. Rings are ordered along x; the points of each are counter-clockwise in a view along +x. Three vertices per
// triangle; normals are smoothed across edges up to crease_rad. In the body's frame, origin 0, lengths in m.
Mesh Loft(const std::vector<Ring>& rings, Material material, Colour colour, double crease_rad);
// A solid wheel, tyre or disc around the y axis from y = -half to +half with bevelled edges.
Mesh Disc(double radius_m, double half_width_m, double bevel_m, int sides, Material material, Colour colour);
// A box between two corners.
Mesh Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Material material, Colour colour);

}  // namespace rodeira::scene
