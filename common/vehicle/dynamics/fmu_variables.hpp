// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"
#include "common/vehicle/fmi/description.hpp"

namespace rodeira::dynamics {

// The border between a vehicle and an FMU (docs/reference/vehicle-files.md): names, units, and the FMU's variables that
// bear them; null where the FMU has none, which only those that are asked for may not be.
struct FmuVariables {
  using Variable = const fmi::Variable*;
  struct Wheel {
    // Inputs: the ground under the wheel's centre, a plane.
    Variable ground_z = nullptr, normal_x = nullptr, normal_y = nullptr, normal_z = nullptr, friction = nullptr;
    // Outputs.
    Variable hub_x = nullptr, hub_y = nullptr, hub_z = nullptr, steer = nullptr, spin = nullptr, longitudinal = nullptr,
             lateral = nullptr, load = nullptr;
  };
  // Where it begins: set before the first step.
  Variable start_x = nullptr, start_y = nullptr, start_z = nullptr, start_heading = nullptr;  // asked for
  Variable start_pitch = nullptr, start_roll = nullptr, start_speed = nullptr, start_lateral_speed = nullptr,
           start_yaw_rate = nullptr;
  // Inputs of each step.
  Variable steering_wheel = nullptr, throttle = nullptr, brake = nullptr, clutch = nullptr, handbrake = nullptr,
           gear_wish = nullptr, automatic = nullptr, starter = nullptr;
  std::array<Variable, 3> push_force{}, push_moment{};  // of collisions, in W, about B's origin: all six or none count
  // Outputs: motion of B, asked for.
  std::array<Variable, 3> position{}, angle{}, velocity{}, rate{};  // angle, rate: roll, pitch, heading
  Variable engine_speed = nullptr, engine_torque = nullptr, gear = nullptr, steering_torque = nullptr,
           fuel_rate = nullptr;
  std::array<Wheel, kWheels> wheels;

  bool takes_pushes() const;
};

// Finds them in an FMU. `names`: ours to the FMU's own, where they differ. Wrong input, behind `context`, where one
// that is asked for is not there, has the wrong causality or type, or is declared in another unit, or where a name of
// `names` belongs to none.
base::Result<FmuVariables> FindVariables(const fmi::Description& description,
                                         const std::map<std::string, std::string>& names, const std::string& context);

}  // namespace rodeira::dynamics
