// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace rodeira::assists {

inline constexpr std::size_t kAssistWheels = 4;  // front left, front right, rear left, rear right
using PerWheel = std::array<double, kAssistWheels>;

// What the controllers know of the car they are built for.
struct AssistCar {
  double rolling_radius_m = 0.3;
  double wheel_inertia_kgm2 = 1.0;
  double wheelbase_m = 2.5;
  std::array<double, 2> track_m{1.5, 1.5};  // front, rear
  double mass_kg = 1000.0;
  double cg_height_m = 0.5;
  PerWheel static_load_N{};
  std::array<bool, kAssistWheels> driven{};
};

// What their sensors measure at the beginning of a step, and what the driver wants.
struct AssistInput {
  PerWheel wheel_radps{};
  double front_wheel_rad = 0.0;  // mean steer angle of the front wheels, positive to the left
  double yaw_rate_radps = 0.0;   // about the body's z axis
  double forward_mps2 = 0.0;     // acceleration of the body along its axes, weight not counted
  double lateral_mps2 = 0.0;
  double throttle = 0.0;    // pedal, 0 … 1
  bool is_braking = false;  // the driver brakes, by the pedal or by hand
  PerWheel brake_Nm{};      // torque of each brake by the pedal, at least 0
};

// What brakes and engine get in the place of the driver's wishes.
struct AssistCommand {
  PerWheel brake_Nm{};
  double throttle = 0.0;
};

}  // namespace rodeira::assists
