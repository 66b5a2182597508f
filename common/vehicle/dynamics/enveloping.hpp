// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/wheel.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace rodeira::dynamics {

// The ring stands upright in the wheel's plane. Over the ground at kRingPoints places along the wheel, within
// kRingReach of the radius to both sides, it comes to rest where it touches first: with its hub at
//   max over x' of z(x') + sqrt(R² - (x' - x)²),
// and the plane that the tyre meets is the ring's tangent there. So a plane is itself, to rounding, and over an edge at
// height z, a distance d ahead, the hub would stand at z + sqrt(R² - d²). Between those places the ground goes on as
// SUELO's plane at the nearest one (a steeper slope counts as 2): an edge is known to half of their distance, 0.022 R.
// Across the wheel the plane leans as the ground does where it is touched.
inline constexpr int kRingPoints = 41;
inline constexpr double kRingReach = 0.9;

// Where the wheels are: hubs (m) and axles (to the left, of any length), in W.
struct WheelPlaces {
  std::array<Eigen::Vector3d, kWheels> hubs_W;
  std::array<Eigen::Vector3d, kWheels> axles_W;
};

// Asks for the ground under the four wheels as `enveloping` says, in one batch (law L4). Outside of the world a wheel
// goes on upon the plane that it knows.
void QueryGround(ground::Ground& ground, Enveloping enveloping, double radius_m, const WheelPlaces& places,
                 const std::array<WheelGround*, kWheels>& wheels);

}  // namespace rodeira::dynamics
