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
// bear them. Those that are asked for are there; of others the FMU may have none.
struct FmuVariables {
  // A variable of the FMU and its unit: ours is `factor` times its value plus `offset`. False: the FMU has none.
  struct Variable {
    const fmi::Variable* own = nullptr;
    double factor = 1.0;
    double offset = 0.0;

    explicit operator bool() const { return own != nullptr; }
    // Between the FMU's unit and ours.
    double ToOurs(double value) const { return factor * value + offset; }
    double FromOurs(double value) const { return (value - offset) / factor; }
  };
  // The FMU's variables of one wheel; docs/reference/vehicle-files.md has unit, sign and frame of each.
  struct Wheel {
    // Inputs: the ground under the wheel's centre, a plane.
    Variable ground_z, normal_x, normal_y, normal_z, friction;
    // Outputs.
    Variable hub_x, hub_y, hub_z, steer, spin, longitudinal, lateral, load;
  };
  // Where it begins: set before the first step.
  Variable start_x, start_y, start_z, start_heading;  // asked for
  Variable start_pitch, start_roll, start_speed, start_lateral_speed, start_yaw_rate;
  // Inputs of each step.
  Variable steering_wheel, throttle, brake, clutch, handbrake, gear_lever, automatic, starter;
  std::array<Variable, 3> push_force{}, push_moment{};  // of collisions, in W, about B's origin: all six or none count
  // Outputs: motion of B, asked for.
  std::array<Variable, 3> position{}, angle{}, velocity{}, rate{};  // angle, rate: roll, pitch, heading
  std::array<Variable, 4> quaternion{};  // w, x, y, z of B in W, in place of the angles: all four or none
  Variable engine_speed, engine_torque, gear, steering_torque, fuel_rate;
  std::array<Wheel, kWheels> wheels;

  bool takes_pushes() const;
  bool has_quaternion() const { return static_cast<bool>(quaternion[0]); }

  std::vector<std::string> notes;  // units that are converted, in a sentence
};

// The vehicle file's `names` and where each stands, "FILE:LINE".
struct FmuNames {
  std::map<std::string, std::string> own;  // ours to the FMU's own, where they differ
  std::map<std::string, std::string> places;
};

// Finds them in an FMU. An output may be of any causality that can be read. A unit of the same quantity is converted by
// the factors of the FMU's own definitions, or of the units that are known (fmu_units.hpp). Wrong input, with the line
// of the vehicle file or of the model description, where one that is asked for is not there, has the wrong causality or
// type, or is declared in a unit of another quantity, where a name of `names` is no variable of a vehicle, or where two
// inputs are the same variable of the FMU.
base::Result<FmuVariables> FindVariables(const fmi::Description& description, const FmuNames& names,
                                         const std::string& file);

}  // namespace rodeira::dynamics
