// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/multibody_loads.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

}  // namespace

void WheelLoad::SetStep(const TyreForces& forces, double brake_on_wheel_Nm, double spin_radps) {
  forces_ = forces;
  brake_on_wheel_Nm_ = brake_on_wheel_Nm;
  spin_radps_ = spin_radps;
  anchored_ = false;
  locked_ = false;
}

void WheelLoad::Anchor(const Vector3d& hub_W, double stiffness_Npm, bool locked) {
  anchored_ = true;
  locked_ = locked;
  anchor_W_ = hub_W;
  anchor_Npm_ = stiffness_Npm;
}

WheelLoad::Contact WheelLoad::ContactAt(const multibody::Motion& motion) const {
  Contact contact;
  static_cast<DiscContact&>(contact) =
      MeetPlane(motion.At(settings_.centre), motion.At(settings_.axle), settings_.radius_m, plane_W_, normal_W_);
  contact.deflection_m = std::min(contact.deflection_m, settings_.bottom_m);
  if (contact.deflection_m > 0.0) {
    const double closing = -motion.RateOf(settings_.centre).dot(normal_W_) / contact.lean;
    contact.load_N = std::max(0.0, settings_.vertical_Npm * contact.deflection_m + settings_.damping_Nspm * closing);
  }
  return contact;
}

Eigen::Vector2d WheelLoad::Tangential(const multibody::Motion& motion, const Contact& contact) const {
  if (!anchored_) return {forces_.longitudinal_N, forces_.lateral_N};
  const Vector3d away = anchor_Npm_ * (motion.At(settings_.centre) - anchor_W_);
  return {forces_.longitudinal_N - away.dot(contact.along_W), forces_.lateral_N - away.dot(contact.across_W)};
}

void WheelLoad::Add(const multibody::Motion& motion, multibody::Sink& sink) const {
  const Contact contact = ContactAt(motion);
  const Vector3d axle = motion.At(settings_.axle);
  const Eigen::Vector2d tangential = Tangential(motion, contact);
  const Vector3d force =
      contact.load_N * normal_W_ + tangential[0] * contact.along_W + tangential[1] * contact.across_W;
  Vector3d moment = (contact.point_W - motion.At(settings_.centre)).cross(force) + forces_.aligning_Nm * normal_W_;
  if (!locked_) {
    moment -= (moment.dot(axle) + brake_on_wheel_Nm_) * axle;  // about its axle the wheel turns by itself
    moment -= settings_.spin_inertia_kgm2 * spin_radps_ * motion.RateOf(settings_.axle);
  }
  sink.Push(multibody::Single(settings_.centre), force);
  sink.PushTorque(settings_.carrier, moment, motion.q);
  if (!sink.wants_matrix() || entities_.empty()) return;
  const auto stiffen = [&](const Vector3d& n, double stiffness, double damping) {
    const multibody::Triple gradient{{n.x(), n.y(), n.z(), 0.0}};
    sink.Stiffen(pairs_, &gradient, stiffness, damping);
  };
  if (contact.load_N > 0.0) {
    const double twice = contact.lean * contact.lean;
    stiffen(normal_W_, contact.deflection_m < settings_.bottom_m ? settings_.vertical_Npm / twice : 0.0,
            settings_.damping_Nspm / twice);
  }
  if (!anchored_) return;
  stiffen(contact.along_W, anchor_Npm_, 0.0);
  stiffen(contact.across_W, anchor_Npm_, 0.0);
}

void ChassisLoad::Add(const multibody::Motion& motion, multibody::Sink& sink) const {
  const Vector3d v = headway_W_ + multibody::Evaluate(drag_point_, motion.qd);
  sink.Push(drag_point_, -half_rho_area_kgpm_ * v.norm() * v);
  sink.PushTorque(chassis_, -torque_on_wheels_Nm_ * multibody::Evaluate(chassis_.axes[1], motion.q), motion.q);
}

double ChassisLoad::Force(const multibody::Motion& motion) const {
  return half_rho_area_kgpm_ * (headway_W_ + multibody::Evaluate(drag_point_, motion.qd)).squaredNorm();
}

double ColumnLoad::Force(const multibody::Motion& motion) const {
  return stiffness_Nmprad_ * (hands_rad_ - motion.q[3 * angle_]) +
         damping_Nmsprad_ * (hands_radps_ - motion.qd[3 * angle_]);
}

void ColumnLoad::Add(const multibody::Motion& motion, multibody::Sink& sink) const {
  sink.Push(angle_, Force(motion));
  if (!sink.wants_matrix() || entities_.empty()) return;
  const multibody::Triple gradient{{1.0, 0.0, 0.0, 0.0}};
  sink.Stiffen(pairs_, &gradient, stiffness_Nmprad_, damping_Nmsprad_);
}

}  // namespace rodeira::dynamics
