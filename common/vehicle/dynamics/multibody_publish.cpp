// SPDX-License-Identifier: Apache-2.0
// What the multibody car publishes, saves and restores.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/powertrain_publish.hpp"

namespace rodeira::dynamics {

void MultibodyModel::Publish(const Controls& controls, double dt_s) {
  VehicleState& s = state_;
  const Eigen::Isometry3d pose = X_WB();
  const multibody::Motion motion = system_->motion();
  const Eigen::Vector3d turning_W =
      Turning_W(system_->drawing().bodies[static_cast<std::size_t>(settings_.chassis)].frame, motion);
  const Eigen::Vector3d origin = multibody::Evaluate(origin_, system_->q().data());
  const Eigen::Vector3d v =
      multibody::Evaluate(origin_, system_->qd().data()) + turning_W.cross(pose.translation() - origin);
  const Eigen::Vector3d turning_B = pose.linear().transpose() * turning_W;
  s.a_WB_W = dt_s > 0.0 ? Eigen::Vector3d((v - s.v_WB_W) / dt_s) : Eigen::Vector3d::Zero();
  s.alpha_WB_B = dt_s > 0.0 ? Eigen::Vector3d((turning_B - s.w_WB_B) / dt_s) : Eigen::Vector3d::Zero();
  s.p_WB_W = pose.translation();
  s.q_WB = Eigen::Quaterniond(pose.linear()).normalized();
  s.v_WB_W = v;
  s.w_WB_B = turning_B;
  s.odometer_m += dt_s * std::fabs(s.speed_mps());
  s.inside_world = true;
  const Contacts contacts = FindContacts(motion);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const Wheel& wheel = wheels_[i];
    const MultibodyWheelSettings& hung = settings_.wheels[i];
    const multibody::Load& suspension = *system_->drawing().loads[static_cast<std::size_t>(hung.suspension)].load;
    WheelState& w = s.wheels[i];
    w.hub_B = pose.linear().transpose() * (motion.At(hung.centre) - pose.translation());
    const Eigen::Vector3d axle_B = pose.linear().transpose() * motion.At(hung.axle);
    w.steer_rad = std::atan2(-axle_B.x(), axle_B.y());
    w.spin_rad = wheel.spin_rad;
    w.spin_radps = wheel.spin_radps;
    w.longitudinal_N = forces_[i].longitudinal_N;
    w.lateral_N = forces_[i].lateral_N;
    w.aligning_Nm = forces_[i].aligning_Nm;
    w.load_N = contacts[i].load_N;
    w.slip = wheel.tyre.slip();
    w.slip_angle_tan = wheel.tyre.slip_angle_tan();
    w.brake_torque_Nm = torques_.brake_Nm[i];
    w.drive_torque_Nm = torques_.drive_Nm[i];
    w.suspension_N = -suspension.Force(motion);
    w.damper_N = w.suspension_N + suspension.ForceAtRest(motion);  // what it has more than standing still in this place
    w.travel_m = w.hub_B.z() - hub_rest_B_[i].z();
    w.contact_W = contacts[i].point_W;
    w.contact_normal_W = wheel.normal_W;
    w.friction = wheel.friction;
    w.surface = wheel.surface;
    s.inside_world = s.inside_world && wheel.inside;
  }
  PublishPowertrain(powertrain_, s);
  s.brake = controls.brake;
  s.steering_wheel_rad = hands_rad_;
  s.steering_torque_Nm = -column_load_->Force(motion);
  s.drag_N = chassis_load_->Force(motion);
}

void MultibodyModel::Wheel::Save(base::StateWriter& writer) const {
  WheelGround::Save(writer);
  writer.Put("tyre", tyre);
  writer.Put("spin_rad", spin_rad);
  writer.Put("spin_radps", spin_radps);
}

void MultibodyModel::Wheel::Restore(base::StateReader& reader) {
  WheelGround::Restore(reader);
  reader.Get("tyre", tyre);
  reader.Get("spin_rad", spin_rad);
  reader.Get("spin_radps", spin_radps);
}

// Forces and torques of the last substep need not be kept: they are found anew before they are used.
void MultibodyModel::Save(base::StateWriter& writer) const {
  writer.Put("mechanism", *system_);
  for (const Wheel& wheel : wheels_) writer.Put("wheel", wheel);
  writer.Put("powertrain", powertrain_);
  writer.Put("assists", assists_);
  writer.Put("forward_mps2", forward_mps2_);
  writer.Put("lateral_mps2", lateral_mps2_);
  writer.Put("hands_rad", hands_rad_);
  if (lowered_m_ > 0.0) writer.Put("lowered_m", lowered_m_);
  writer.Put("published", state_);
}

void MultibodyModel::Restore(base::StateReader& reader) {
  reader.Get("mechanism", *system_);
  for (Wheel& wheel : wheels_) reader.Get("wheel", wheel);
  reader.Get("powertrain", powertrain_);
  reader.Get("assists", assists_);
  reader.Get("forward_mps2", forward_mps2_);
  reader.Get("lateral_mps2", lateral_mps2_);
  reader.Get("hands_rad", hands_rad_);
  lowered_m_ = 0.0;
  if (reader.Has("lowered_m")) reader.Get("lowered_m", lowered_m_);
  reader.Get("published", state_);
}

}  // namespace rodeira::dynamics
