// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/wheel.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace rodeira::dynamics {

// Tyre enveloping by a rigid ring in the wheel's plane. The ground is sampled at kRingPoints places along the wheel,
// up to kRingReach times the radius R to both sides. The ring is lowered until it touches, with its hub at the height
//   max over x' of z(x') + sqrt(R² - (x' - x)²),
// and the contact plane is the ring's tangent there. On a plane this is the plane itself, to rounding. At an edge of
// height z, a distance d ahead, the hub is at z + sqrt(R² - d²). Between samples the ground is SUELO's plane at the
// nearest one (slopes above 2 count as 2), so an edge's position is resolved to half their distance, 0.022 R.
// Across the wheel the contact plane has the slope of the ground at the contact point.
inline constexpr int kRingPoints = 41;
inline constexpr double kRingReach = 0.9;

// Where the wheels are: hubs (m) and axles (to the left, of any length), in W.
struct WheelPlaces {
  std::array<Eigen::Vector3d, kWheels> hubs_W;
  std::array<Eigen::Vector3d, kWheels> axles_W;
};

// Queries the ground under the four wheels by the method `enveloping`, in one batch (law L4). Outside of the world a
// wheel keeps its last contact plane.
void QueryGround(ground::Ground& ground, Enveloping enveloping, double radius_m, const WheelPlaces& places,
                 const std::array<WheelGround*, kWheels>& wheels);

}  // namespace rodeira::dynamics
