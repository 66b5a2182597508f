// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

// A limb in its joint: straight down at rest, swinging about the y axis (to the left).
struct Limb {
  Eigen::Vector3d joint_B = Eigen::Vector3d::Zero();
  double swings = 1.0;  // against the left leg: 1 with it, -1 against it
  Mesh mesh;            // about its joint
};

// A pedestrian in the frame B: x forward, y left, z up, between the feet on the ground.
struct PersonMeshes {
  Mesh trunk;                 // with head
  std::array<Limb, 4> limbs;  // left leg, right leg, left arm, right arm
};
// Of that height, clothed in that colour. Every part is a closed surface; feet reach down to the ground.
PersonMeshes BuildPerson(double height_m, Colour clothes);

// How far a leg swings forward (positive, by turning about -y) where the feet have gone so far: a wheel of that radius,
// as the traffic publishes it, turns once in two steps.
double LegSwing_rad(double wheel_spin_rad, double wheel_radius_m, double leg_m);
// The legs' length of a person of that height.
inline double LegLength_m(double height_m) { return 0.47 * height_m; }

}  // namespace rodeira::scene
