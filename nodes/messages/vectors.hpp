// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "idl/messages.hpp"

namespace rodeira::nodes {

// Vectors and rotations of messages (vehicle.idl), with the same numbers.
inline Eigen::Vector3d FromMessage(const msg::Vector3& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d FromMessage(const msg::Vector3f& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}
// The message has the order w, x, y, z.
inline Eigen::Quaterniond FromMessage(const msg::Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

inline msg::Vector3 ToMessage(const Eigen::Vector3d& v) {
  msg::Vector3 out;
  out.x(v.x());
  out.y(v.y());
  out.z(v.z());
  return out;
}
inline msg::Quaternion ToMessage(const Eigen::Quaterniond& q) {
  msg::Quaternion out;
  out.w(q.w());
  out.x(q.x());
  out.y(q.y());
  out.z(q.z());
  return out;
}

}  // namespace rodeira::nodes
