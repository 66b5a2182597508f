// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/vehicle/assists/assist_input.hpp"

namespace rodeira::assists {

// Speed of the car and forces of its tyres from the sensors that such a car has: wheel speeds, accelerometers and yaw
// rate. While a wheel may slip, the measured acceleration carries the speed on between the wheels' bounds (U. Kiencke,
// L. Nielsen, Automotive Control Systems, 2nd ed., 2005, chapter 9.1).
class MotionEstimator {
 public:
  // `brake_Nm`: torques of the brakes in the step before.
  void Step(const AssistCar& car, const AssistInput& input, const PerWheel& brake_Nm, double dt_s);

  double speed_mps() const { return speed_mps_; }      // forward, below 0 backward
  double lateral_mps() const { return lateral_mps_; }  // to the left, at the centre of gravity
  // Of the ground under a wheel along that wheel, below 0 backward, m/s.
  double GroundSpeed(const AssistCar& car, const AssistInput& input, std::size_t wheel) const;
  // Braking force of each tyre, smoothed over 30 ms, N.
  const PerWheel& braking_N() const { return braking_N_; }
  // Load of a wheel with the car's acceleration, N.
  double Load(const AssistCar& car, const AssistInput& input, std::size_t wheel) const;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double speed_mps_ = 0.0;
  double lateral_mps_ = 0.0;  // to the left
  bool begun_ = false;
  PerWheel before_radps_{};
  PerWheel braking_N_{};
};

}  // namespace rodeira::assists
