// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// The ground between the ends of linked lanes that lie apart or meet with a kink: vehicles drive over it. Lengths in
// metres. The graph must outlive it.
class JointGaps {
 public:
  explicit JointGaps(const lanes::Graph& graph);

  // Whether a point lies in one, on the lanes' level.
  bool Holds(const Eigen::Vector3d& p_W) const;

 private:
  // The convex hull of the last cross-section of one lane and the first of the next.
  struct Gap {
    std::uint32_t track;
    double z_m;
    std::array<Eigen::Vector2d, 4> corners_W;
  };

  const lanes::Graph& graph_;
  std::vector<Gap> gaps_;  // ascending by track; each under both of its lanes
};

}  // namespace rodeira::traffic
