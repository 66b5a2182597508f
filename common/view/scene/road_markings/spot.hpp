// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "common/world/network/network.hpp"

namespace rodeira::scene {

// A place on a road from which shapes are laid out: x ahead, y to the left of it, in the plane of the road's surface
// there.
struct Spot {
  Eigen::Vector3d p_W;
  Eigen::Vector3d normal_W;
  Eigen::Vector2d ahead_W;

  // heading_rad: of x, from east to north.
  static Spot At(const network::Road& road, double s_m, double t_m, double heading_rad) {
    const network::SurfaceSample sample = road.Surface(s_m, t_m);
    return {sample.p_W, sample.ds_W.cross(sample.dt_W).normalized(), {std::cos(heading_rad), std::sin(heading_rad)}};
  }
  // A point (x, y) of the spot, at the height of its plane.
  Eigen::Vector3d ToWorld(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d off = p.x() * ahead_W + p.y() * Eigen::Vector2d(-ahead_W.y(), ahead_W.x());
    return {p_W.x() + off.x(), p_W.y() + off.y(), p_W.z() - normal_W.head<2>().dot(off) / normal_W.z()};
  }
  // The (x, y) of a point of W, seen from above.
  Eigen::Vector2d ToLocal(const Eigen::Vector2d& q_W) const {
    const Eigen::Vector2d off = q_W - p_W.head<2>();
    return {off.dot(ahead_W), off.dot(Eigen::Vector2d(-ahead_W.y(), ahead_W.x()))};
  }
};

}  // namespace rodeira::scene
