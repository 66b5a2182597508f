// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

using Ring = std::vector<Eigen::Vector3d>;

// A closed skin over rings of equally many points, each ring counter-clockwise seen from behind (from where the rings
// begin, looking to where they end... the x axis points away from the eye), and flat caps on the first and last. Three
// vertices a triangle; normals smoothed up to crease_rad. In the body's own frame, origin 0.
Mesh Loft(const std::vector<Ring>& rings, Material material, Colour colour, double crease_rad);
// A solid wheel, tyre or disc around the y axis from y = -half to +half with bevelled edges.
Mesh Disc(double radius_m, double half_width_m, double bevel_m, int sides, Material material, Colour colour);
// A box between two corners.
Mesh Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Material material, Colour colour);

}  // namespace rodeira::scene
