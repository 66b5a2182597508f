// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/world/design/junction_surface.hpp"

namespace rodeira::design {

// Corners of a junction's area from the ends of its roads, which come counter-clockwise: from mouth to mouth a cubic
// that leaves one road's edge and goes on into the next one's.
struct Outline {
  std::vector<Eigen::Vector2d> corners_W;
  std::vector<FreeEdge> free_edges;
};

// An end of a road: its edges as seen from inside, looking out, and the direction outward.
struct Mouth {
  Eigen::Vector2d left_W, right_W, outward_W;
};

// Corners counter-clockwise, as JunctionSurface takes them.
Outline MakeOutline(const std::vector<Mouth>& mouths);

}  // namespace rodeira::design
