// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/wheel_drive.hpp"

namespace rodeira::dynamics {
namespace {

// The brakes' torques, and the controls with the throttle that is left.
std::array<double, kWheels> Brakes(const WheelDriveSettings& settings, const WheelDriveInput& input, double dt_s,
                                   const std::array<double, kWheels>& spin_radps, assists::Assists& assists,
                                   Controls& controls) {
  std::array<double, kWheels> brake_Nm{};
  if (!settings.assists.any()) {
    for (std::size_t i = 0; i < kWheels; ++i)
      brake_Nm[i] = BrakeTorque(settings.brakes, i, controls.brake, controls.handbrake);
    return brake_Nm;
  }
  assists::AssistInput sensed;
  sensed.wheel_radps = spin_radps;
  sensed.front_wheel_rad = input.front_wheel_rad;
  sensed.yaw_rate_radps = input.yaw_rate_radps;
  sensed.forward_mps2 = input.forward_mps2;
  sensed.lateral_mps2 = input.lateral_mps2;
  sensed.throttle = controls.throttle;
  sensed.is_braking = controls.brake > 0.0 || controls.handbrake > 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) sensed.brake_Nm[i] = BrakeTorque(settings.brakes, i, controls.brake, 0.0);
  const assists::AssistCommand command = assists.Step(settings.assists, settings.car, sensed, dt_s);
  controls.throttle = command.throttle;
  for (std::size_t i = 0; i < kWheels; ++i)
    brake_Nm[i] = command.brake_Nm[i] + BrakeTorque(settings.brakes, i, 0.0, controls.handbrake);
  return brake_Nm;
}

}  // namespace

WheelTorques TurnWheels(const WheelDriveSettings& settings, const Controls& wanted, const WheelDriveInput& in,
                        double dt_s, Powertrain& powertrain, assists::Assists& assists,
                        std::array<double, kWheels>& spin_radps) {
  Controls controls = wanted;
  WheelTorques torques;
  torques.brake_Nm = Brakes(settings, in, dt_s, spin_radps, assists, controls);
  const double radius = settings.wheel.rolling_radius_m;
  std::array<double, kWheels> road{};
  std::array<double, kWheels> friction{};
  for (std::size_t i = 0; i < kWheels; ++i) {
    road[i] = -radius * in.longitudinal_N[i];
    friction[i] =
        torques.brake_Nm[i] + settings.wheel.rolling_resistance * in.resistance_share[i] * in.load_N[i] * radius;
  }
  PowertrainInput input;
  input.wheel_inertia_kgm2 = settings.wheel.inertia_kgm2;
  input.speed_mps = in.speed_mps;
  input.inertia_torque_Nm = settings.car.mass_kg * radius * in.forward_mps2;
  for (std::size_t i = 0; i < kWheels; ++i) {
    if (!Drives(settings.powertrain.driven, AxleOf(i))) continue;
    const bool second = settings.powertrain.driven == DrivenWheels::kAll && AxleOf(i) == 1;
    AxleInput& axle = second ? input.rear : static_cast<AxleInput&>(input);
    axle.wheel_radps[i % 2] = spin_radps[i];
    axle.road_torque_Nm[i % 2] = road[i];
    axle.friction_torque_Nm[i % 2] = friction[i];
  }
  (void)powertrain.Step(settings.powertrain, controls, input, dt_s);
  for (std::size_t i = 0; i < kWheels; ++i) {
    if (const AxleMotion* motion = powertrain.AxleOf(settings.powertrain, AxleOf(i))) {
      spin_radps[i] = motion->wheel_radps[i % 2];
      torques.drive_Nm[i] = motion->wheel_torque_Nm()[i % 2];
      torques.friction_Nm[i] = motion->friction_torque_Nm[i % 2] - motion->loss_torque_Nm[i % 2];
    } else {
      torques.friction_Nm[i] = friction[i];
      spin_radps[i] = StepFreeWheel(spin_radps[i], settings.wheel.inertia_kgm2, road[i], torques.friction_Nm[i], dt_s);
    }
  }
  return torques;
}

}  // namespace rodeira::dynamics
