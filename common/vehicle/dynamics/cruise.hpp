// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/wheel.hpp"

namespace rodeira::dynamics {

// A slower car stands still.
inline constexpr double kStandstill_mps = 1e-6;

// Straight ahead at a speed, which INI solves as it does the standstill. Turning, or slipping sideways, is no
// equilibrium: there the wheels roll.
bool IsCruise(const InitialCondition& initial);

// How four wheels that keep their speed push a car with `total_N` along: those without a shaft only overcome their
// rolling resistance, the shafts of the two others have the same torque.
struct CruiseForces {
  std::array<double, kWheels> longitudinal_N{};
  double at_wheel_Nm = 0.0;  // of each shaft on its wheel, less the gears' losses
};
CruiseForces PushAlong(double total_N, const std::array<double, kWheels>& loads_N, const WheelSettings& wheel,
                       bool front_driven, double speed_mps);

// Aligning moment of a tyre that bears these forces as it rolls steadily at vx_mps (Tyre::SetToRollAndBear), in N m.
double CruiseMoment(const TyreSettings& tyre, const TyreForces& forces, double vx_mps, double load_N, double friction,
                    double camber_rad = 0.0);

}  // namespace rodeira::dynamics
