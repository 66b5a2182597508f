// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::scene {

// The square of the world for which the sun's shadows are drawn, as the sun sees it: parallel rays along `forward_W`.
struct SunView {
  Eigen::Vector3d middle_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d forward_W = -Eigen::Vector3d::UnitZ(), right_W = Eigen::Vector3d::UnitX(),
                  up_W = Eigen::Vector3d::UnitY();  // unit, square to one another
  double side_m = 0.0;                              // of the square
  double depth_m = 0.0;                             // before and behind its middle

  // Where a point falls on the square, from (0, 0) its lower left corner to (1, 1), and how deep, 0 nearest to the sun
  // to 1.
  Eigen::Vector3d ToMap(const Eigen::Vector3d& p_W) const;
};

// About a place, for a sun in that direction (unit, above the horizon) and a map of so many pixels a side. The square
// moves by whole pixels only, so that the edges of shadows of what stands still stand still.
SunView MakeSunView(const Eigen::Vector3d& to_sun_W, const Eigen::Vector3d& about_W, double side_m, int side_px);

}  // namespace rodeira::scene
