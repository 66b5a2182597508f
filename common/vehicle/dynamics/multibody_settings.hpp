// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/assists/assists.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel.hpp"
#include "common/vehicle/multibody/drawing.hpp"

namespace rodeira::dynamics {

// How a wheel hangs on the mechanism.
struct MultibodyWheelSettings {
  int carrier = 0;     // body that holds the hub
  int centre = 0;      // point: the wheel's centre
  int axle = 0;        // vector: its axle, drawn to the left
  int suspension = 0;  // load on the distance between body and wheel: spring, damper, stops
  int travel = 0;      // that distance
};

// The steering wheel and its column; `angle` is an entity of the mechanism.
struct MultibodySteeringSettings {
  int angle = 0;        // rotor: the column's lower end, in the steering wheel's sense (left positive)
  double ratio = 16.0;  // for controls by the front wheels' angle
  double limit_rad = 9.0;
  double column_Nmprad = 1000.0;  // between the driver's hands and the column's lower end
  double column_Nmsprad = 10.0;
};

// All that a vehicle file of model `multibody` says.
struct MultibodySettings {
  multibody::Drawing mechanism;  // drawn as the car stands on z = 0: x forward, y left
  int chassis = 0;               // body
  std::array<MultibodyWheelSettings, kWheels> wheels;
  MultibodySteeringSettings steering;
  std::array<TyreSettings, 2> tyre;  // front, rear
  WheelSettings wheel;
  double tyre_damping_Nspm = 0.0;  // vertical
  BrakeSettings brakes;
  assists::AssistSettings assists;
  PowertrainSettings powertrain;
  double drag_area_m2 = 0.5;
  double air_density_kgpm3 = 1.2;
  multibody::Vector3d drag_point_m = multibody::Vector3d::Zero();  // on the chassis, as drawn
  double mass_kg = 0.0;                                            // of the whole car
  double longest_substep_s = 0.001;
  VehicleDimensions dimensions;
};

// Problems stay in the file's collection.
MultibodySettings ReadMultibody(const config::Map& root);

}  // namespace rodeira::dynamics
