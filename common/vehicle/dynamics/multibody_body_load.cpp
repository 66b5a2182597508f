// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/multibody_body_load.hpp"

#include <algorithm>

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr double kBorneBy = 4.0;  // corners that share the stiffness of the body: it lies on a side of its box

}  // namespace

void BodyLoad::SetBody(const Eigen::Isometry3d& X_CB, const VehicleDimensions& dimensions) {
  origin_ = chassis_.PointAt(X_CB.translation());
  const BodyBox box = BoxOf(dimensions, settings_);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector3d side((i & 1u) != 0 ? 1.0 : -1.0, (i & 2u) != 0 ? 1.0 : -1.0, (i & 4u) != 0 ? 1.0 : -1.0);
    corners_[i] = chassis_.PointAt(X_CB * Vector3d(box.centre_B + side.cwiseProduct(box.half_m)));
  }
}

Vector3d BodyLoad::OnCorner(const multibody::Form& corner, const multibody::Motion& motion) const {
  const double depth = (ground_W_ - multibody::Evaluate(corner, motion.q)).dot(normal_W_);
  if (depth <= 0.0) return Vector3d::Zero();
  return ContactForce(settings_, normal_W_, depth, multibody::Evaluate(corner, motion.qd), 1.0 / kBorneBy);
}

void BodyLoad::Add(const multibody::Motion& motion, multibody::Sink& sink) const {
  if (origin_.terms.empty()) return;
  for (const multibody::Form& corner : corners_) sink.Push(corner, OnCorner(corner, motion));
  if (!push_.any()) return;
  sink.Push(origin_, push_.force_W);
  sink.PushTorque(chassis_, push_.moment_WB_W, motion.q);
}

double BodyLoad::Energy(const multibody::Motion& motion) const {
  double energy = 0.0;
  for (const multibody::Form& corner : corners_) {
    if (origin_.terms.empty()) continue;
    const double depth = std::max(0.0, (ground_W_ - multibody::Evaluate(corner, motion.q)).dot(normal_W_));
    energy += 0.5 / kBorneBy * settings_.stiffness_Npm * depth * depth;
  }
  return energy;
}

double BodyLoad::Force(const multibody::Motion& motion) const {
  double force = 0.0;
  for (const multibody::Form& corner : corners_)
    force += origin_.terms.empty() ? 0.0 : OnCorner(corner, motion).dot(normal_W_);
  return force;
}

}  // namespace rodeira::dynamics
