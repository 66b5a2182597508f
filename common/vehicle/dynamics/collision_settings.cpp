// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/collision_settings.hpp"

#include <algorithm>

namespace rodeira::dynamics {

BodyBox BoxOf(const VehicleDimensions& d, const CollisionSettings& settings) {
  return {{0.5 * (d.front_m - d.rear_m), 0.0, 0.5 * (d.height_m + settings.clearance_m)},
          0.5 * Eigen::Vector3d(d.front_m + d.rear_m, d.width_m, std::max(0.1, d.height_m - settings.clearance_m))};
}

Eigen::Vector3d ContactForce(const CollisionSettings& settings, const Eigen::Vector3d& normal_W, double depth_m,
                             const Eigen::Vector3d& v_W, double share) {
  const double closing = -v_W.dot(normal_W);
  const double bears = std::max(0.0, settings.stiffness_Npm * depth_m + settings.damping_Nspm * closing) * share;
  const Eigen::Vector3d sliding = v_W + closing * normal_W;
  return bears * normal_W - settings.friction * bears / std::max(sliding.norm(), settings.sticking_mps) * sliding;
}

}  // namespace rodeira::dynamics
