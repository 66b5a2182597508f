// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/disc_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kMinLean = 0.2;

}  // namespace

double LeanOf(const Eigen::Vector3d& axle_W, const Eigen::Vector3d& normal_W) {
  const double tilt = std::clamp(axle_W.dot(normal_W), -1.0, 1.0);
  return std::max(kMinLean, std::sqrt(1.0 - tilt * tilt));
}

DiscContact MeetPlane(const Eigen::Vector3d& hub_W, const Eigen::Vector3d& axle_W, double radius_m,
                      const Eigen::Vector3d& plane_W, const Eigen::Vector3d& normal_W) {
  const double tilt = std::clamp(axle_W.dot(normal_W), -1.0, 1.0);
  DiscContact contact;
  contact.camber_rad = std::asin(tilt);
  contact.lean = std::max(kMinLean, std::sqrt(1.0 - tilt * tilt));
  const Eigen::Vector3d down = (tilt * axle_W - normal_W) / contact.lean;
  const double reach = (hub_W - plane_W).dot(normal_W) / contact.lean;
  contact.point_W = hub_W + reach * down;
  contact.along_W = axle_W.cross(normal_W) / contact.lean;
  contact.across_W = normal_W.cross(contact.along_W);
  contact.deflection_m = radius_m - reach;
  return contact;
}

}  // namespace rodeira::dynamics
