// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::dynamics {

// Where a thin disc meets a plane: its lowest point.
struct DiscContact {
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();    // on the plane
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitX();   // in the plane, the way that the disc rolls
  Eigen::Vector3d across_W = Eigen::Vector3d::UnitY();  // in the plane, to its left
  double deflection_m = 0.0;  // how far the disc would reach beyond the plane, along its radius; negative in the air
  double lean = 1.0;          // cosine between the disc's plane and the normal, cut at 0.2 where it lies nearly flat
  double camber_rad = 0.0;    // asin(axle · normal): positive when it leans to the right
};

// Cosine between the plane of a disc with this axle and the normal (both of unit length), cut at 0.2.
double LeanOf(const Eigen::Vector3d& axle_W, const Eigen::Vector3d& normal_W);

// Centre and axle (unit, to the left) of the disc, a point and the unit normal of the plane.
DiscContact MeetPlane(const Eigen::Vector3d& hub_W, const Eigen::Vector3d& axle_W, double radius_m,
                      const Eigen::Vector3d& plane_W, const Eigen::Vector3d& normal_W);

}  // namespace rodeira::dynamics
