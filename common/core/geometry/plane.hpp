// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::geometry {

// A quarter turn to the left.
inline Eigen::Vector2d Left(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

// v, turned by the angle from +x to the unit vector `direction`.
inline Eigen::Vector2d Rotate(const Eigen::Vector2d& v, const Eigen::Vector2d& direction) {
  return {v.x() * direction.x() - v.y() * direction.y(), v.x() * direction.y() + v.y() * direction.x()};
}

// The z of the cross product: positive where b lies to the left of a.
inline double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace rodeira::geometry
