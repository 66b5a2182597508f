// SPDX-License-Identifier: Apache-2.0
// What the bicycle publishes, saves and restores.
#include <algorithm>
#include <cmath>
#include <span>

#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/powertrain_publish.hpp"

namespace rodeira::dynamics {

// The front tyres turn their carriers by aligning moment, side force × mechanical trail and longitudinal force × scrub
// radius.
double BicycleModel::SteeringTorque() const {
  const SteeringSettings& steering = settings().steering;
  double torque = 0.0;
  for (const std::size_t i : {kFrontLeft, kFrontRight}) {
    const TyreForces& forces = findings_.contacts[i].forces;
    torque += forces.aligning_Nm - steering.mechanical_trail_m * forces.lateral_N;
  }
  const double apart_N =
      findings_.contacts[kFrontRight].forces.longitudinal_N - findings_.contacts[kFrontLeft].forces.longitudinal_N;
  return (torque + steering.scrub_radius_m * apart_N) / steering.ratio;
}

void BicycleModel::Publish(const Controls& controls, double dt_s) {
  VehicleState& s = state_;
  const Eigen::Vector3d v = v_WB_W();
  s.a_WB_W = dt_s > 0.0 ? Eigen::Vector3d((v - s.v_WB_W) / dt_s) : Eigen::Vector3d::Zero();
  s.alpha_WB_B = dt_s > 0.0 ? Eigen::Vector3d((car_.body.w_WG_G - s.w_WB_B) / dt_s) : Eigen::Vector3d::Zero();
  s.p_WB_W = p_WB_W();
  s.q_WB = car_.body.q_WG;
  s.v_WB_W = v;
  s.w_WB_B = car_.body.w_WG_G;
  s.odometer_m += dt_s * std::fabs(s.speed_mps());
  s.inside_world = true;
  const BicyclePose pose = car_.PoseOf(chassis_, 0.0);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const BicycleCar::Wheel& wheel = car_.wheels[i];
    WheelState& w = s.wheels[i];
    w.hub_B = chassis_.HubAtRest_B(i) + Eigen::Vector3d(0.0, 0.0, wheel.corner.travel_m());
    w.steer_rad = chassis_.SteerAngle(i, controls.steering_wheel_rad);
    w.spin_rad = wheel.spin_rad;
    w.spin_radps = wheel.spin_radps;
    w.longitudinal_N = findings_.contacts[i].forces.longitudinal_N;
    w.lateral_N = findings_.contacts[i].forces.lateral_N;
    w.aligning_Nm = findings_.contacts[i].forces.aligning_Nm;
    w.load_N = wheel.corner.load_N();
    w.slip = wheel.tyre.slip();
    w.slip_angle_tan = wheel.tyre.slip_angle_tan();
    w.brake_torque_Nm = findings_.torques.brake_Nm[i];
    w.drive_torque_Nm = findings_.torques.drive_Nm[i];
    w.suspension_N = wheel.corner.suspension_N();
    w.damper_N = wheel.corner.damper_N();
    w.travel_m = wheel.corner.travel_m();
    w.contact_W = car_.ContactOf(pose, i).point_W;  // under the pose that is published
    w.contact_normal_W = wheel.normal_W;
    w.friction = wheel.friction;
    w.surface = wheel.surface;
    s.inside_world = s.inside_world && wheel.inside;
  }
  PublishPowertrain(car_.powertrain, s);
  s.brake = controls.brake;
  s.steering_wheel_rad = chassis_.SteerAngle(kFrontLeft, controls.steering_wheel_rad) * settings().steering.ratio;
  s.steering_torque_Nm = SteeringTorque();
  s.drag_N = findings_.drag_N;
}

// What the last substep found need not be kept: it is found anew before it is used.
void BicycleModel::Save(base::StateWriter& writer) const {
  car_.Save(writer);
  writer.Put("published", state_);
}

void BicycleModel::Restore(base::StateReader& reader) {
  car_.Restore(reader);
  reader.Get("published", state_);
}

}  // namespace rodeira::dynamics
