// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "common/traffic/motion/drivetrain.hpp"

namespace rodeira::traffic {

// What an agent's driver and engine do.
struct AgentDetail {
  std::uint32_t id = 0;
  Driving driving;
  double fuel_mgps = 0.0;
  double fuel_used_mg = 0.0;                           // since it entered
  double target_mps = 0.0;                             // what it plans for here and now, whatever is ahead
  Eigen::Vector2d target_W = Eigen::Vector2d::Zero();  // on its path, the point that it steers for
  double path_heading_rad =
      0.0;  // of its path beside its rear axle; of MOTORS' driver from one point of its trajectory to the next
  Eigen::Vector2d look_ahead_W = Eigen::Vector2d::Zero();  // up to where it looks for what slows it
};

}  // namespace rodeira::traffic
