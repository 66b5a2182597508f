// SPDX-License-Identifier: Apache-2.0
#include "nodes/messages/vehicle_state.hpp"

#include <cstdint>

#include "nodes/messages/rounding.hpp"
#include "nodes/messages/vectors.hpp"

namespace rodeira::nodes {
namespace {

float Single(double value) { return static_cast<float>(value); }

using nodes::Measured;  // of a number

msg::Vector3f Measured(const Eigen::Vector3d& v) {
  msg::Vector3f out;
  out.x(Measured(v.x()));
  out.y(Measured(v.y()));
  out.z(Measured(v.z()));
  return out;
}

msg::WheelState Wheel(const dynamics::WheelState& in, const dynamics::VehicleState& car) {
  msg::WheelState out;
  out.hub_b_m(Measured(in.hub_B));
  out.steer_rad(Measured(in.steer_rad));
  out.spin_rad(Single(in.spin_rad));
  out.spin_radps(Measured(in.spin_radps));
  out.longitudinal_n(Measured(in.longitudinal_N));
  out.lateral_n(Measured(in.lateral_N));
  out.load_n(Measured(in.load_N));
  out.slip(Measured(in.slip));
  out.slip_angle_tan(Measured(in.slip_angle_tan));
  out.brake_torque_nm(Measured(in.brake_torque_Nm));
  out.drive_torque_nm(Measured(in.drive_torque_Nm));
  out.suspension_n(Measured(in.suspension_N));
  out.damper_n(Measured(in.damper_N));
  out.travel_m(Measured(in.travel_m));
  out.contact_b_m(Measured(car.q_WB.conjugate() * (in.contact_W - car.p_WB_W)));
  out.contact_normal_w(Measured(in.contact_normal_W));
  out.friction(Measured(in.friction));
  out.surface(static_cast<std::uint32_t>(in.surface));
  out.in_contact(in.load_N > 0.0 ? 1 : 0);
  return out;
}

}  // namespace

dynamics::VehicleState FromMessage(const msg::VehicleState& in) {
  dynamics::VehicleState out;
  out.p_WB_W = FromMessage(in.position_w_m());
  out.q_WB = FromMessage(in.attitude_wb());
  out.v_WB_W = FromMessage(in.velocity_w_mps());
  out.w_WB_B = FromMessage(in.angular_velocity_b_radps());
  out.a_WB_W = FromMessage(in.acceleration_w_mps2());
  out.steering_wheel_rad = in.steering_wheel_rad();
  out.engine_speed_radps = in.engine_speed_radps();
  out.gear = in.gear();
  out.fuel_kg = in.fuel_used_kg();
  return out;
}

std::uint32_t LightsOf(const msg::Controls& controls, int gear) {
  constexpr std::uint32_t kBrake = 1, kLeft = 2, kRight = 4, kReversing = 8, kDipped = 16, kMain = 32;
  constexpr double kPressed = 0.01;  // of the pedal's way: what a foot's rest does not do
  std::uint32_t lights = controls.brake() > kPressed ? kBrake : 0;
  if ((controls.indicators() & 1U) != 0) lights |= kLeft;
  if ((controls.indicators() & 2U) != 0) lights |= kRight;
  if (gear < 0) lights |= kReversing;
  if (controls.headlights() == 1) lights |= kDipped;
  if (controls.headlights() == 2) lights |= kMain;
  return lights;
}

msg::VehicleState ToMessage(const dynamics::VehicleState& state, const dynamics::VehicleDimensions& dimensions) {
  msg::VehicleState out;
  out.position_w_m(ToMessage(state.p_WB_W));
  out.attitude_wb(ToMessage(state.q_WB));
  out.velocity_w_mps(ToMessage(state.v_WB_W));
  out.angular_velocity_b_radps(ToMessage(state.w_WB_B));
  out.acceleration_w_mps2(Measured(state.a_WB_W));
  out.angular_acceleration_b_radps2(Measured(state.alpha_WB_B));
  for (std::size_t i = 0; i < dynamics::kWheels; ++i) out.wheels()[i] = Wheel(state.wheels[i], state);
  out.engine_speed_radps(state.engine_speed_radps);
  out.engine_torque_nm(Measured(state.engine_torque_Nm));
  out.clutch(Single(state.clutch));
  out.clutch_torque_nm(Measured(state.clutch_torque_Nm));
  out.throttle(Single(state.throttle));
  out.brake(Single(state.brake));
  out.steering_wheel_rad(state.steering_wheel_rad);
  out.steering_torque_nm(Measured(state.steering_torque_Nm));
  out.fuel_rate_kgps(Measured(state.fuel_rate_kgps));
  out.fuel_used_kg(state.fuel_kg);
  out.odometer_m(state.odometer_m);
  out.drag_n(Measured(state.drag_N));
  out.length_m(Single(dimensions.front_m + dimensions.rear_m));
  out.front_m(Single(dimensions.front_m));
  out.width_m(Single(dimensions.width_m));
  out.height_m(Single(dimensions.height_m));
  out.wheelbase_m(Single(dimensions.wheelbase_m));
  out.track_front_m(Single(dimensions.track_front_m));
  out.track_rear_m(Single(dimensions.track_rear_m));
  out.wheel_radius_m(Single(dimensions.wheel_radius_m));
  out.gear(state.gear);
  out.engine_running(state.engine_running ? 1 : 0);
  out.inside_world(state.inside_world ? 1 : 0);
  return out;
}

}  // namespace rodeira::nodes
