// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"

// The energy of a car of each model: kinetic, potential, of springs and of pressed tyres.
namespace rodeira::dynamics {

inline constexpr double kG = base::kGravity_mps2;

// A spring up to where the rim bears; from there the load grows no further.
inline double TyreEnergy(const WheelSettings& of, const VehicleState& s, const WheelState& w) {
  const Eigen::Vector3d way = s.p_WB_W + s.q_WB * w.hub_B - w.contact_W;
  const double pressed_m = std::max(0.0, of.radius_m - std::copysign(way.norm(), way.dot(w.contact_normal_W)));
  const double spring_m = std::min(pressed_m, kMaxTyreDeflection * of.radius_m);
  return of.vertical_Npm * spring_m * (0.5 * spring_m + (pressed_m - spring_m));
}

inline double Turning(const Eigen::Vector3d& inertia, const Eigen::Vector3d& w) {
  return 0.5 * w.cwiseAbs2().dot(inertia);
}

inline double Springs(const BicycleSettings& car, const VehicleState& s, double bears_N, std::size_t i) {
  const SuspensionSettings& of = car.suspension[i / 2];
  const double d = s.wheels[i].travel_m, bar_m = d - s.wheels[i ^ 1u].travel_m;
  return bears_N * d + 0.5 * of.spring_Npm * d * d + 0.25 * of.anti_roll_Npm * bar_m * bar_m;
}

inline double Energy(const BicycleModel& model) {
  const VehicleState& s = model.state();
  const BicycleSettings& car = model.settings();
  const BodySettings& body = car.body;
  const Eigen::Vector3d p_BG_B(0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0, body.cg_height_m);
  const Eigen::Vector3d v = s.v_WB_W + s.q_WB * s.w_WB_B.cross(p_BG_B);
  double energy_J = 0.5 * body.mass_kg * v.squaredNorm() + body.mass_kg * kG * (s.p_WB_W + s.q_WB * p_BG_B).z();
  energy_J += Turning({body.roll_inertia_kgm2, body.pitch_inertia_kgm2, body.yaw_inertia_kgm2}, s.w_WB_B);
  const double rear = body.cg_to_front_axle_m / body.wheelbase_m;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = s.wheels[i];
    energy_J += 0.5 * car.wheel.inertia_kgm2 * w.spin_radps * w.spin_radps;
    energy_J += Springs(car, s, 0.5 * body.mass_kg * kG * (i < 2 ? 1.0 - rear : rear), i);
    energy_J += TyreEnergy(car.wheel, s, w);
  }
  return energy_J;
}

inline double Energy(const OdeModel& model) {
  const VehicleState& s = model.state();
  const OdeSettings& of = model.settings();
  const BicycleSettings& car = of.car;
  const OdeChassis chassis = ChassisOf(of);
  const Eigen::Vector3d v = s.v_WB_W + s.q_WB * s.w_WB_B.cross(chassis.p_BG_B);
  double energy_J =
      0.5 * chassis.mass_kg * v.squaredNorm() + chassis.mass_kg * kG * (s.p_WB_W + s.q_WB * chassis.p_BG_B).z();
  energy_J += Turning(chassis.inertia_kgm2, s.w_WB_B);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = s.wheels[i];
    const SuspensionSettings& sus = car.suspension[i / 2];
    const Eigen::Vector3d rate_B(0.0, 0.0, w.damper_N / sus.damper_Nspm);
    const Eigen::Vector3d hub = s.v_WB_W + s.q_WB * (s.w_WB_B.cross(w.hub_B) + rate_B);
    energy_J += 0.5 * of.wheel_mass_kg * hub.squaredNorm() + of.wheel_mass_kg * kG * (s.p_WB_W + s.q_WB * w.hub_B).z();
    energy_J += Turning({of.wheel_across_kgm2, car.wheel.inertia_kgm2, of.wheel_across_kgm2},
                        s.w_WB_B + Eigen::Vector3d(0.0, w.spin_radps, 0.0));
    energy_J += Springs(car, s, LoadAtRest(car, i) - of.wheel_mass_kg * kG, i);
    const double beyond = w.travel_m - std::clamp(w.travel_m, -sus.rebound_m, sus.bump_m);
    energy_J += 0.5 * of.stop_Npm * beyond * beyond;
    energy_J += TyreEnergy(car.wheel, s, w);
  }
  return energy_J;
}

// That of the mechanism's masses and springs is tested against closed forms (tests/common/vehicle/multibody).
inline double Energy(const MultibodyModel& model) {
  const VehicleState& s = model.state();
  double energy_J = model.system().Energy();
  for (const WheelState& w : s.wheels) {
    energy_J += 0.5 * model.settings().wheel.inertia_kgm2 * w.spin_radps * w.spin_radps;
    energy_J += TyreEnergy(model.settings().wheel, s, w);
  }
  return energy_J;
}

inline double Energy(const VehicleModel& model) {
  if (const auto* car = dynamic_cast<const BicycleModel*>(&model)) return Energy(*car);
  if (const auto* car = dynamic_cast<const OdeModel*>(&model)) return Energy(*car);
  return Energy(dynamic_cast<const MultibodyModel&>(model));
}

// What the tyres' deflections along the wheels hold: relaxation length times the integral of the force over slip. It is
// given back where a tyre stops slipping.
inline double TangentialEnergy(const MultibodyModel& model) {
  constexpr int kParts = 50;
  double energy_J = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = model.state().wheels[i];
    if (w.load_N <= 0.0) continue;
    const TyreSettings& tyre = model.settings().tyre[AxleOf(i)];
    for (int k = 0; k < kParts; ++k) {
      const TyreSlip slip{w.slip * (k + 0.5) / kParts, 0.0, 0.0};
      energy_J += tyre.relaxation_longitudinal_m * w.slip / kParts *
                  SteadyForces(tyre, slip, w.load_N, w.friction).longitudinal_N;
    }
  }
  return energy_J;
}

}  // namespace rodeira::dynamics
