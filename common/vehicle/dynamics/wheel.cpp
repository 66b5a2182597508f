// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/wheel.hpp"

#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

double BrakeTorque(const BrakeSettings& brakes, std::size_t wheel, double pedal, double handbrake) {
  if (wheel == kFrontLeft || wheel == kFrontRight) return brakes.front_Nm * pedal;
  return brakes.rear_Nm * pedal + brakes.handbrake_Nm * handbrake;
}

double AirDrag(double air_density_kgpm3, double drag_area_m2, double speed_mps) {
  return 0.5 * air_density_kgpm3 * drag_area_m2 * speed_mps * speed_mps;
}

}  // namespace rodeira::dynamics
