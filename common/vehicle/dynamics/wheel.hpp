// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace rodeira::dynamics {

// What a wheel feels of ground that is rougher than it is round (common/vehicle/dynamics/enveloping).
enum class Enveloping {
  kNone,  // the plane of the ground below the hub
  kRing,  // the plane that a rigid ring of the wheel's radius touches
};

// The largest deflection of a tyre, share of its radius.
inline constexpr double kMaxTyreDeflection = 0.5;

// A wheel and its tyre's vertical side; the same for all four.
struct WheelSettings {
  double radius_m = 0.29;           // unloaded
  double rolling_radius_m = 0.283;  // distance rolled for a radian, and lever arm of the longitudinal force
  double width_m = 0.175;
  double inertia_kgm2 = 0.8;  // about the axle, with hub and brake disc
  double vertical_Npm = 180000.0;
  double rolling_resistance = 0.012;  // force over load
  Enveloping enveloping = Enveloping::kNone;
};

// Torques at one wheel with the pedal (or lever) at its end.
struct BrakeSettings {
  double front_Nm = 1500.0;
  double rear_Nm = 600.0;
  double handbrake_Nm = 900.0;  // on the rear wheels
};

// Torque that the brake of a wheel can hold, at least 0; wheels are in the order of WheelIndex.
double BrakeTorque(const BrakeSettings& brakes, std::size_t wheel, double pedal, double handbrake);

// Air drag along the motion: ½ rho CdA v², in N.
double AirDrag(double air_density_kgpm3, double drag_area_m2, double speed_mps);

}  // namespace rodeira::dynamics
