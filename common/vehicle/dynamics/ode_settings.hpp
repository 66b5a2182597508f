// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "common/vehicle/dynamics/bicycle_settings.hpp"

namespace rodeira::dynamics {

// All that a vehicle file of model `ode` says: the measures of model `bicycle`, of the whole car with its wheels, and
// these.
struct OdeSettings {
  BicycleSettings car;
  double wheel_mass_kg = 15.0;       // each, with hub, brake and what swings with it
  double wheel_across_kgm2 = 0.5;    // inertia of a wheel about an axis across its axle
  double tyre_damping_Nspm = 500.0;  // vertical
  double stop_Npm = 200000.0;        // of the suspension's bump and rebound stops
  double clearance_m = 0.15;         // from the road to the underside of the body, which is a box up to its height
  double body_friction = 0.5;        // of that box on what it touches
  double longest_substep_s = 0.001;
};

// Problems stay in the file's collection.
OdeSettings ReadOde(const config::Map& root);

// The chassis: the car without its wheels. Centre of gravity in B, principal inertia there.
struct OdeChassis {
  double mass_kg = 0.0;
  Eigen::Vector3d p_BG_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d inertia_kgm2 = Eigen::Vector3d::Zero();
};
// The wheels' masses and inertias are taken from those of the whole car.
OdeChassis ChassisOf(const OdeSettings& settings);
// Centre of a wheel in B where the car rests on level ground.
Eigen::Vector3d HubAtRest_B(const BicycleSettings& car, std::size_t wheel);
// Load of that wheel then, N.
double LoadAtRest(const BicycleSettings& car, std::size_t wheel);

}  // namespace rodeira::dynamics
