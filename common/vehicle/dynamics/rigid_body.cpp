// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/rigid_body.hpp"

#include <cmath>
#include <span>

namespace rodeira::dynamics {
namespace {

// The turn by an angle vector: (cos |a|/2, sin |a|/2 a/|a|).
Eigen::Quaterniond Turn(const Eigen::Vector3d& angle) {
  const double size = angle.norm();
  const double half_sinc = size < 1e-6 ? 0.5 - size * size / 48.0 : std::sin(0.5 * size) / size;
  const Eigen::Vector3d part = half_sinc * angle;
  return {std::cos(0.5 * size), part.x(), part.y(), part.z()};
}

}  // namespace

void RigidBody::Push(const Eigen::Vector3d& force_W, const Eigen::Vector3d& moment_W, double mass_kg,
                     const Eigen::Vector3d& inertia_kgm2, double dt_s) {
  v_WG_W += dt_s / mass_kg * force_W;
  const Eigen::Vector3d moment_G = q_WG.conjugate() * moment_W - w_WG_G.cross(inertia_kgm2.cwiseProduct(w_WG_G));
  w_WG_G += dt_s * moment_G.cwiseQuotient(inertia_kgm2);
}

void RigidBody::Move(double dt_s) {
  p_WG_W += dt_s * v_WG_W;
  q_WG = (q_WG * Turn(dt_s * w_WG_G)).normalized();
}

void RigidBody::Save(base::StateWriter& writer) const {
  writer.Put("p_WG_W", std::span<const double>(p_WG_W.data(), 3));
  writer.Put("q_WG", std::span<const double>(q_WG.coeffs().data(), 4));
  writer.Put("v_WG_W", std::span<const double>(v_WG_W.data(), 3));
  writer.Put("w_WG_G", std::span<const double>(w_WG_G.data(), 3));
}

void RigidBody::Restore(base::StateReader& reader) {
  reader.Get("p_WG_W", std::span<double>(p_WG_W.data(), 3));
  reader.Get("q_WG", std::span<double>(q_WG.coeffs().data(), 4));
  reader.Get("v_WG_W", std::span<double>(v_WG_W.data(), 3));
  reader.Get("w_WG_G", std::span<double>(w_WG_G.data(), 3));
}

}  // namespace rodeira::dynamics
