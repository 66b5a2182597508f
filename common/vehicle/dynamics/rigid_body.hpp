// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/core/base/state.hpp"

namespace rodeira::dynamics {

// A free rigid body G at its centre of gravity, axes parallel to the vehicle's. Newton and Euler, semi-implicit.
struct RigidBody {
  Eigen::Vector3d p_WG_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WG = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_WG_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_WG_G = Eigen::Vector3d::Zero();

  Eigen::Vector3d w_WG_W() const { return q_WG * w_WG_G; }
  // Velocity of the body's point that is now at p_W.
  Eigen::Vector3d VelocityAt(const Eigen::Vector3d& p_W) const { return v_WG_W + w_WG_W().cross(p_W - p_WG_W); }

  // Velocities first, from force and moment about G; then the pose with the new velocities. Inertia: principal, in G.
  void Push(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W, double mass_kg,
            const Eigen::Vector3d& inertia_kgm2, double dt_s);
  // Over a step of dt_s, with the velocities as they are.
  void Move(double dt_s);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

}  // namespace rodeira::dynamics
