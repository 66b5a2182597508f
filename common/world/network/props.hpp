// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "common/world/network/furniture.hpp"

namespace rodeira::network {

// Objects of a world file that stand on the ground, at no road. Station, offset and rotation of their Object are not
// used.
struct Props {
  struct Placement {
    std::size_t object = 0;
    Eigen::Vector2d at_W = Eigen::Vector2d::Zero();
    double heading_rad = 0.0;  // of its x axis, from east to north
  };
  // A continuous object in straight pieces from point to point: a wall, a guard rail.
  struct Run {
    std::size_t object = 0;
    std::vector<Eigen::Vector2d> points_W;  // at least two, no two consecutive ones equal
  };
  std::vector<Object> objects;
  std::vector<Placement> placements;
  std::vector<Run> runs;

  bool empty() const { return placements.empty() && runs.empty(); }
};

}  // namespace rodeira::network
