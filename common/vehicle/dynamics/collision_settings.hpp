// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// How bodies give way where they touch. Chosen: at 50 km/h against a wall a car of 1000 kg is pressed in by 0.3 m.
struct CollisionSettings {
  double clearance_m = 0.15;     // from the road to the underside of the car's box
  double stiffness_Npm = 1.0e6;  // of the bodies that are pressed in, both together
  double damping_Nspm = 2.0e4;   // along the normal, while they touch
  double friction = 0.4;         // of body on body
  double sticking_mps = 0.1;     // below it friction falls linearly to 0 with the sliding speed
};

// The car's outline from the clearance to its height, in B.
struct BodyBox {
  Eigen::Vector3d centre_B;
  Eigen::Vector3d half_m;

  double reach_m() const { return centre_B.norm() + half_m.norm(); }  // of its corners from B's origin, at most
};
// Edges parallel to B's axes.
BodyBox BoxOf(const VehicleDimensions& dimensions, const CollisionSettings& settings);

// Force on a body that is pressed `depth_m` into something at a contact that bears `share` of the stiffness: (k depth +
// c closing) share along the normal (unit, onto the body), at least 0, and Coulomb friction across. `v_W`: of the body
// against the other there.
Eigen::Vector3d ContactForce(const CollisionSettings& settings, const Eigen::Vector3d& normal_W, double depth_m,
                             const Eigen::Vector3d& v_W, double share);

}  // namespace rodeira::dynamics
