// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// A wheel that rolls from one plane of the ground onto another: over an edge or a kerb.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/vehicle/dynamics/collision_settings.hpp"
#include "common/vehicle/dynamics/wheel_ground.hpp"

namespace rodeira::dynamics {

/// A wheel above its ground.
struct WheelDisc {
  Eigen::Vector3d hub_W = Eigen::Vector3d::Zero();   ///< centre, in m
  Eigen::Vector3d axle_W = Eigen::Vector3d::Zero();  ///< of unit length, to the left; zero: the disc leans as the plane
  double radius_m = 0.3;                             ///< unloaded
};

/// Takes a new answer of the ground without giving the tyre energy. Where the tyre would be pressed further in by
/// more than 0.2 mm only because the plane has changed, the contact is an edge, and the wheel turns about it until it
/// has reached the new plane:
/// - Where the ground falls away, the edge is the line where both planes meet. On a steep face below it the tyre bears
///   nothing.
/// - Where the ground rises, the edge lies ahead on the new plane, so far that the tyre is pressed in as before. The
///   motion of the hub over it does the work that presses the tyre in.
/// Otherwise the plane is the ground's, to the bit; so it is where the planes differ by no more than along a crest or
/// dip of 10 m radius, which at steps of 10 ms and 30 m/s is 4.5 mm.
/// @param before the ground under the wheel before the query
/// @param disc the wheel now
/// @param wheel the ground's answer now; receives the edge and the plane that touches the wheel there
void RollOn(const WheelGround& before, const WheelDisc& disc, WheelGround& wheel);

/// Says how far the plane under the body is to be lowered, so that its change alone presses nothing into the body.
/// @param before the plane before the query
/// @param lowered_m how far it was lowered
/// @param now the plane now
/// @param X_WB pose of the body
/// @param box outline of the body
/// @return at least 0, in m along the normal; 0 while the body does not touch the plane
double LoweredBy(const Plane& before, double lowered_m, const Plane& now, const Eigen::Isometry3d& X_WB,
                 const BodyBox& box);

}  // namespace rodeira::dynamics
