// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/assists/assists.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/suspension.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel.hpp"

namespace rodeira::dynamics {

// The car as one rigid body. Inertias are about its centre of gravity.
struct BodySettings {
  double mass_kg = 1050.0;  // of the whole car with its wheels and driver
  double roll_inertia_kgm2 = 360.0;
  double pitch_inertia_kgm2 = 1400.0;
  double yaw_inertia_kgm2 = 1500.0;
  double cg_height_m = 0.53;  // above the road at rest
  double cg_to_front_axle_m = 1.0;
  double wheelbase_m = 2.46;
  double drag_area_m2 = 0.5;  // C_d A
  double air_density_kgpm3 = 1.2;
};

// The ratio is the steering wheel's angle over the front wheels'.
struct SteeringSettings {
  double ratio = 16.0;
  double limit_rad = 9.2;            // of the steering wheel, each side
  double mechanical_trail_m = 0.02;  // for the torque given back to the driver only
  double scrub_radius_m = 0.0;       // of the kingpin inside the contact: lets the rim feel longitudinal forces
  double pneumatic_trail_m = 0.025;  // of tyres without coefficients of their aligning moment
};

// All that a vehicle file of model `bicycle` says.
struct BicycleSettings {
  BodySettings body;
  SteeringSettings steering;
  std::array<SuspensionSettings, 2> suspension;  // front, rear
  std::array<TyreSettings, 2> tyre;              // front, rear
  WheelSettings wheel;
  BrakeSettings brakes;
  assists::AssistSettings assists;
  PowertrainSettings powertrain;
  VehicleDimensions dimensions;
};

// Problems stay in the file's collection: the caller asks File::Finish.
BicycleSettings ReadBicycle(const config::Map& root);

// The car as its controllers know it.
assists::AssistCar AssistCarOf(const BicycleSettings& car);

}  // namespace rodeira::dynamics
