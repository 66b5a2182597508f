// SPDX-License-Identifier: Apache-2.0
// What the ODE car publishes, saves and restores.
#include <algorithm>
#include <cmath>

#include "common/vehicle/dynamics/ode_model.hpp"
#include "common/vehicle/dynamics/powertrain_publish.hpp"

namespace rodeira::dynamics {

// The front tyres turn their carriers by aligning moment, side force × mechanical trail and longitudinal force × scrub
// radius.
double OdeModel::SteeringTorque() const {
  const SteeringSettings& steering = settings_.car.steering;
  double torque = 0.0;
  for (const std::size_t i : {kFrontLeft, kFrontRight})
    torque += contacts_[i].forces.aligning_Nm - steering.mechanical_trail_m * contacts_[i].forces.lateral_N;
  const double apart_N = contacts_[kFrontRight].forces.longitudinal_N - contacts_[kFrontLeft].forces.longitudinal_N;
  return (torque + steering.scrub_radius_m * apart_N) / steering.ratio;
}

void OdeModel::Publish(const Controls& controls, double dt_s) {
  VehicleState& s = state_;
  const Eigen::Vector3d p = p_WB_W();
  const Eigen::Vector3d v = chassis().VelocityAt(p);
  s.a_WB_W = dt_s > 0.0 ? Eigen::Vector3d((v - s.v_WB_W) / dt_s) : Eigen::Vector3d::Zero();
  s.alpha_WB_B = dt_s > 0.0 ? Eigen::Vector3d((chassis().w_WG_G - s.w_WB_B) / dt_s) : Eigen::Vector3d::Zero();
  s.p_WB_W = p;
  s.q_WB = chassis().q_WG;
  s.v_WB_W = v;
  s.w_WB_B = chassis().w_WG_G;
  s.odometer_m += dt_s * std::fabs(s.speed_mps());
  s.inside_world = true;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Wheel& wheel = now_.wheels[i];
    const RigidBody& hub = now_.bodies[i];
    const Contact contact = ContactOf(i);  // under the pose that is published
    const SuspensionSettings& suspension = settings_.car.suspension[i / 2];
    const Eigen::Vector3d axle_B = s.q_WB.conjugate() * (hub.q_WG * Eigen::Vector3d::UnitY());
    WheelState& w = s.wheels[i];
    w.hub_B = s.q_WB.conjugate() * (hub.p_WG_W - p);
    w.steer_rad = std::atan2(-axle_B.x(), axle_B.y());
    w.spin_rad = wheel.spin_rad;
    w.spin_radps = wheel.spin_radps;
    w.longitudinal_N = contacts_[i].forces.longitudinal_N;
    w.lateral_N = contacts_[i].forces.lateral_N;
    w.aligning_Nm = contacts_[i].forces.aligning_Nm;
    w.load_N = contact.load_N;
    w.slip = wheel.tyre.slip();
    w.slip_angle_tan = wheel.tyre.slip_angle_tan();
    w.brake_torque_Nm = torques_.brake_Nm[i];
    w.drive_torque_Nm = torques_.drive_Nm[i];
    w.travel_m = Travel(i);
    w.damper_N = suspension.damper_Nspm * TravelRate(i);
    w.suspension_N = StrutExtra(i) + suspension.spring_Npm * w.travel_m + w.damper_N;
    w.contact_W = contact.point_W;
    w.contact_normal_W = wheel.normal_W;
    w.friction = wheel.friction;
    w.surface = wheel.surface;
    s.inside_world = s.inside_world && wheel.inside;
  }
  PublishPowertrain(now_.powertrain, s);
  s.brake = controls.brake;
  s.steering_wheel_rad =
      std::clamp(controls.steering_wheel_rad, -settings_.car.steering.limit_rad, settings_.car.steering.limit_rad);
  s.steering_torque_Nm = SteeringTorque();
  s.drag_N = drag_N_;
}

void OdeModel::Wheel::Save(base::StateWriter& writer) const {
  WheelGround::Save(writer);
  writer.Put("tyre", tyre);
  writer.Put("spin_rad", spin_rad);
  writer.Put("spin_radps", spin_radps);
}

void OdeModel::Wheel::Restore(base::StateReader& reader) {
  WheelGround::Restore(reader);
  reader.Get("tyre", tyre);
  reader.Get("spin_rad", spin_rad);
  reader.Get("spin_radps", spin_radps);
}

// ODE itself keeps nothing: each step begins by giving it these bodies.
void OdeModel::Save(base::StateWriter& writer) const {
  for (const RigidBody& body : now_.bodies) writer.Put("body", body);
  for (const Wheel& wheel : now_.wheels) writer.Put("wheel", wheel);
  writer.Put("powertrain", now_.powertrain);
  writer.Put("assists", now_.assists);
  writer.Put("forward_mps2", now_.forward_mps2);
  writer.Put("lateral_mps2", now_.lateral_mps2);
  if (now_.lowered_m > 0.0) writer.Put("lowered_m", now_.lowered_m);
  writer.Put("published", state_);
}

void OdeModel::Restore(base::StateReader& reader) {
  for (RigidBody& body : now_.bodies) reader.Get("body", body);
  for (Wheel& wheel : now_.wheels) reader.Get("wheel", wheel);
  reader.Get("powertrain", now_.powertrain);
  reader.Get("assists", now_.assists);
  reader.Get("forward_mps2", now_.forward_mps2);
  reader.Get("lateral_mps2", now_.lateral_mps2);
  now_.lowered_m = 0.0;
  if (reader.Has("lowered_m")) reader.Get("lowered_m", now_.lowered_m);
  reader.Get("published", state_);
}

}  // namespace rodeira::dynamics
