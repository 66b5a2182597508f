// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace rodeira::traffic {

// The straight line to the look-ahead point of MOTORS' driver, at the height of the car.
struct MotorsLook {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  double z_m = 0.0;
  std::uint32_t id = 0;
};

// tell(a, b) once for every two with lines that cross on one level. Cells as large as the longest line say which may
// meet: a line among n costs what its neighbours do, wherever they lie.
void EachCrossing(const std::vector<MotorsLook>& looks,
                  const std::function<void(const MotorsLook&, const MotorsLook&)>& tell);

}  // namespace rodeira::traffic
