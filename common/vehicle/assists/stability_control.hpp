// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/vehicle/assists/motion_estimator.hpp"

namespace rodeira::assists {

// How far off the car may be, and how hard a brake then acts.
struct StabilitySettings {
  double characteristic_mps = 22.0;    // of the wanted yaw rate V δ / (L (1 + V² / characteristic²))
  double lag_s = 0.08;                 // in which the car follows it
  double margin_mps2 = 2.5;            // the wanted yaw rate is held to the measured lateral acceleration and this much
  double dead_radps = 0.05;            // yaw rate that may be off
  double gain_Nmspr = 25000.0;         // yaw moment by what is off beyond
  double slip_rate_gain_Nms = 6000.0;  // and by the rate at which the sideslip grows
  double most_Nm = 2500.0;             // torque of a brake
  double min_speed_mps = 5.0;
};

// Stability control: brakes turn the car towards the yaw rate that the driver steers for (A. T. van Zanten, R. Erhardt,
// G. Pfaff, VDC, the vehicle dynamics control system of Bosch, SAE 950759). A car that turns too much is braked at the
// wheels outside of the bend, the front one first, and gets no throttle; one that turns too little at the rear wheel
// inside. Between the wanted yaw rate and that of a neutral car, V δ / L, no car is off.
class StabilityControl {
 public:
  // Adds to the brakes' torques; returns the throttle.
  double Step(const StabilitySettings& settings, const AssistCar& car, const AssistInput& input,
              const MotionEstimator& motion, double throttle, PerWheel& brake_Nm, double dt_s);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double wanted_radps_ = 0.0;
};

}  // namespace rodeira::assists
