// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/view/scene/camera/pick.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Where a ray from above first meets the ground, on the level that lies there, within 1 cm in height; nothing where it
// does not within `far_m`, or begins below the ground.
std::optional<Eigen::Vector3d> GroundOn(ground::Ground& ground, const Ray& ray, double far_m = 5'000.0);

// Where a car is to stand.
struct CarPlace {
  double x_m = 0.0, y_m = 0.0;
  double z_m = 0.0;          // of the ground there: chooses among several levels
  double heading_rad = 0.0;  // from east, counter-clockwise
  bool on_lane = false;
};

// At a point of the ground, in the direction of its lane's traffic where it lies on a drivable one (of lanes of both
// directions: that nearer to `heading_rad`), otherwise as `heading_rad` says.
CarPlace PlaceAt(const road::World& world, const Eigen::Vector3d& p_W, double heading_rad);

}  // namespace rodeira::scene
