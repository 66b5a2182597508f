// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::scene {

// How far a drawn line may lie from what it stands for.
struct Tolerance {
  double plan_m = 0.001;
  double height_m = 0.003;
};

using Line3 = std::vector<Eigen::Vector3d>;

// The lines between which a road's surface is smooth: lanes' edges, kinks of its cross-section, sections' and the
// road's own ends; and where a cross-section bends more than the tolerance, lines between them. All have their points
// at the same stations, which lie so close that lines, and surfaces spanned between neighbouring ones, keep the
// tolerance.
std::vector<Line3> RoadLinesOf(const network::Road& road, const Tolerance& tolerance);

}  // namespace rodeira::scene
