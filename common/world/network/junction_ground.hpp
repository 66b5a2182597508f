// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/world/network/junction_grid.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::network {

// Where a road comes in: over a piece of the junction's ground its height goes over into the grid's.
struct JunctionMouth {
  std::shared_ptr<const Road> road;
  double s_m = 0.0;                          // its end here
  double first_t_m = 0.0, second_t_m = 0.0;  // of the first two corners, which lie on that end
  std::vector<Eigen::Vector2d> corners_W;    // four; the third lies inward of the second, the fourth of the first
};

// The one ground of a junction of an OpenDRIVE file that has heights of its own: it takes the place of its connecting
// roads' heights, and lies between them too. From a mouth's end inward the height is a cubic by height and slope of the
// road and of the grid (1.8, 12.11.2).
class JunctionGround {
 public:
  // boundary_W: corners, counter-clockwise; empty: only the connecting roads lie on it.
  JunctionGround(JunctionGrid grid, std::vector<Eigen::Vector2d> boundary_W, std::vector<JunctionMouth> mouths);

  const Eigen::Vector2d& low_W() const { return low_; }
  const Eigen::Vector2d& high_W() const { return high_; }
  // Of its grid, its boundary and its mouths; the roads that come in have digests of their own.
  base::Digest Digest() const;
  const std::vector<Eigen::Vector2d>& boundary_W() const { return boundary_; }
  // Whether a point lies within the boundary; never without one.
  bool Contains(const Eigen::Vector2d& p_W) const;
  // Height and slopes: of a mouth within its piece, else of the grid.
  GroundHeight At(const Eigen::Vector2d& p_W) const;

 private:
  bool HeightIn(const JunctionMouth& mouth, const Eigen::Vector2d& p_W, double& z_m) const;

  JunctionGrid grid_;
  std::vector<Eigen::Vector2d> boundary_;
  std::vector<JunctionMouth> mouths_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = Eigen::Vector2d::Zero();
};

}  // namespace rodeira::network
