// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/dynamics/powertrain.hpp"
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
// rolling resistance, the shafts of an axle have the same torque.
struct CruiseForces {
  std::array<double, kWheels> longitudinal_N{};
  std::array<double, 2> at_wheel_Nm{};  // of each shaft of an axle on its wheel, less the gears' losses

  // Of all shafts together.
  double drive_sum_Nm() const { return 2.0 * at_wheel_Nm[0] + 2.0 * at_wheel_Nm[1]; }
};
// Of all driven wheels the axles share the push as the centre differential lets them: one that locks makes their slips
// equal as far as its plates hold, with the tyres' longitudinal stiffnesses at these loads.
CruiseForces PushAlong(double total_N, const std::array<double, kWheels>& loads_N, const WheelSettings& wheel,
                       const PowertrainSettings& powertrain, const std::array<TyreSettings, kWheels>& tyres,
                       double speed_mps);

// Aligning moment of a tyre that bears these forces as it rolls steadily at vx_mps (Tyre::SetToRollAndBear), in N m.
double CruiseMoment(const TyreSettings& tyre, const TyreForces& forces, double vx_mps, double load_N, double friction,
                    double camber_rad = 0.0);

}  // namespace rodeira::dynamics
