// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/assists/assists.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"
#include "common/vehicle/dynamics/wheel.hpp"

namespace rodeira::dynamics {

// What turns the wheels of one car of a model with springs and gears: the parts are the model's own settings.
struct WheelDriveSettings {
  const WheelSettings& wheel;
  const BrakeSettings& brakes;
  const PowertrainSettings& powertrain;
  const assists::AssistSettings& assists;
  const assists::AssistCar& car;
};

// What the car around them tells the wheels at the beginning of a step.
struct WheelDriveInput {
  std::array<double, kWheels> load_N{};
  std::array<double, kWheels> longitudinal_N{};                      // of the tyres
  std::array<double, kWheels> resistance_share{1.0, 1.0, 1.0, 1.0};  // of the rolling resistance, by the pressure
  double speed_mps = 0.0;                                            // of the car, forward
  double forward_mps2 = 0.0;                                         // of the last step, along and across the body
  double lateral_mps2 = 0.0;
  double yaw_rate_radps = 0.0;
  double front_wheel_rad = 0.0;  // mean steer angle
};

// By wheel, positive where they turn it forward.
struct WheelTorques {
  std::array<double, kWheels> brake_Nm{};     // that the brakes can hold
  std::array<double, kWheels> drive_Nm{};     // of the drive shafts at the wheels, less the gears' losses
  std::array<double, kWheels> friction_Nm{};  // of brakes and rolling resistance, acting, either sign
};

// One step of the wheels' speeds under brakes, engine and tyres; the controllers of `assists` come between pedals and
// brakes.
WheelTorques TurnWheels(const WheelDriveSettings& settings, const Controls& controls, const WheelDriveInput& input,
                        double dt_s, Powertrain& powertrain, assists::Assists& assists,
                        std::array<double, kWheels>& spin_radps);

}  // namespace rodeira::dynamics
