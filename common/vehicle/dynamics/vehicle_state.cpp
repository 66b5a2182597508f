// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_state.hpp"

#include <cmath>
#include <span>

#include "common/vehicle/dynamics/engine.hpp"

namespace rodeira::dynamics {
namespace {

// One list of fields for both directions: `visit(name, field)`.
template <class Wheel, class Visit>
void VisitWheel(Wheel& wheel, Visit&& visit) {
  visit("hub_B", wheel.hub_B);
  visit("steer_rad", wheel.steer_rad);
  visit("spin_rad", wheel.spin_rad);
  visit("spin_radps", wheel.spin_radps);
  visit("longitudinal_N", wheel.longitudinal_N);
  visit("lateral_N", wheel.lateral_N);
  visit("aligning_Nm", wheel.aligning_Nm);
  visit("load_N", wheel.load_N);
  visit("slip", wheel.slip);
  visit("slip_angle_tan", wheel.slip_angle_tan);
  visit("brake_torque_Nm", wheel.brake_torque_Nm);
  visit("drive_torque_Nm", wheel.drive_torque_Nm);
  visit("suspension_N", wheel.suspension_N);
  visit("damper_N", wheel.damper_N);
  visit("travel_m", wheel.travel_m);
  visit("contact_W", wheel.contact_W);
  visit("contact_normal_W", wheel.contact_normal_W);
  visit("friction", wheel.friction);
  visit("surface", wheel.surface);
}

template <class State, class Visit>
void VisitState(State& state, Visit&& visit) {
  visit("p_WB_W", state.p_WB_W);
  visit("q_WB", state.q_WB.coeffs());
  visit("v_WB_W", state.v_WB_W);
  visit("w_WB_B", state.w_WB_B);
  visit("a_WB_W", state.a_WB_W);
  visit("alpha_WB_B", state.alpha_WB_B);
  for (auto& wheel : state.wheels) visit("wheel", wheel);
  visit("engine_speed_radps", state.engine_speed_radps);
  visit("engine_torque_Nm", state.engine_torque_Nm);
  visit("engine_running", state.engine_running);
  visit("clutch", state.clutch);
  visit("clutch_torque_Nm", state.clutch_torque_Nm);
  visit("clutch_slip_radps", state.clutch_slip_radps);
  visit("clutch_heat_W", state.clutch_heat_W);
  visit("gear", state.gear);
  visit("throttle", state.throttle);
  visit("brake", state.brake);
  visit("steering_wheel_rad", state.steering_wheel_rad);
  visit("steering_torque_Nm", state.steering_torque_Nm);
  visit("fuel_rate_kgps", state.fuel_rate_kgps);
  visit("fuel_kg", state.fuel_kg);
  visit("odometer_m", state.odometer_m);
  visit("drag_N", state.drag_N);
  visit("inside_world", state.inside_world);
}

struct Writing {
  base::StateWriter& writer;
  template <class T>
  void operator()(const char* name, const T& field) const {
    if constexpr (requires { field.data(); })
      writer.Put(name, std::span<const double>(field.data(), static_cast<std::size_t>(field.size())));
    else
      writer.Put(name, field);
  }
};

struct Reading {
  base::StateReader& reader;
  template <class T>
  void operator()(const char* name, T& field) const {
    if constexpr (requires { field.data(); })
      reader.Get(name, std::span<double>(field.data(), static_cast<std::size_t>(field.size())));
    else
      reader.Get(name, field);
  }
};

}  // namespace

double VehicleState::heading_rad() const {
  const Eigen::Vector3d forward = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

double VehicleState::pitch_rad() const {
  const Eigen::Vector3d forward = q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(-forward.z(), std::hypot(forward.x(), forward.y()));
}

double VehicleState::roll_rad() const {
  const Eigen::Vector3d left = q_WB * Eigen::Vector3d::UnitY();
  const Eigen::Vector3d up = q_WB * Eigen::Vector3d::UnitZ();
  return std::atan2(left.z(), up.z());
}

Eigen::Vector3d VehicleState::v_WB_B() const { return q_WB.conjugate() * v_WB_W; }
Eigen::Vector3d VehicleState::a_WB_B() const { return q_WB.conjugate() * a_WB_W; }
double VehicleState::speed_mps() const { return v_WB_B().x(); }

double VehicleState::fuel_l_per_h() const { return fuel_rate_kgps / kPetrol_kgpl * 3600.0; }

double VehicleState::consumption_l_per_100km() const {
  const double speed = std::fabs(speed_mps());
  return speed < 1.0 ? 0.0 : fuel_rate_kgps / kPetrol_kgpl / (speed / 1e5);
}

double VehicleState::mean_consumption_l_per_100km() const {
  return odometer_m < 1.0 ? 0.0 : fuel_kg / kPetrol_kgpl / (odometer_m / 1e5);
}

void WheelState::Save(base::StateWriter& writer) const { VisitWheel(*this, Writing{writer}); }
void WheelState::Restore(base::StateReader& reader) { VisitWheel(*this, Reading{reader}); }
void VehicleState::Save(base::StateWriter& writer) const { VisitState(*this, Writing{writer}); }
void VehicleState::Restore(base::StateReader& reader) { VisitState(*this, Reading{reader}); }

}  // namespace rodeira::dynamics
