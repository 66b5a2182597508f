// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/vehicle/assists/motion_estimator.hpp"

namespace rodeira::assists {

// Slip is positive where the wheel spins.
struct TractionSettings {
  double slip = 0.1;            // of the driven wheels that the engine keeps to
  double least_mps = 2.0;       // slip counts against at least this speed
  double cut_ps = 8.0;          // how fast the throttle closes a unit of slip too much, a second
  double open_ps = 1.2;         // and opens at most
  double brake_slip = 0.15;     // of one driven wheel against the ground: beyond it its brake helps
  double brake_Nmps = 12000.0;  // rise of the brake's torque a unit of slip too much, a second
  double most_brake_Nm = 700.0;
  double most_brake_mps = 15.0;  // faster, the engine alone acts
};

// Traction control: the engine's throttle keeps the mean slip of the driven wheels, and the brake of a wheel that spins
// alone lets the differential pass torque to the other one (principles: Robert Bosch GmbH, Automotive Handbook, chapter
// "Driving-safety systems").
class TractionControl {
 public:
  // Adds to the brakes' torques; returns the throttle.
  double Step(const TractionSettings& settings, const AssistCar& car, const AssistInput& input,
              const MotionEstimator& motion, PerWheel& brake_Nm, double dt_s);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  double throttle_ = 1.0;  // the most that the engine gets
  PerWheel brake_Nm_{};
};

}  // namespace rodeira::assists
