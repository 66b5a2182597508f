// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/vehicle/assists/anti_lock.hpp"
#include "common/vehicle/assists/stability_control.hpp"
#include "common/vehicle/assists/traction_control.hpp"

namespace rodeira::assists {

// Which controllers a car has (abs, tcs, esc), and their settings.
struct AssistSettings {
  bool abs = false, tcs = false, esc = false;
  AntiLockSettings anti_lock;
  TractionSettings traction;
  StabilitySettings stability;

  bool any() const { return abs || tcs || esc; }
};

// The controllers of one car. Stability and traction control ask the brakes for torques beside the driver's; the
// anti-lock system has the last word.
class Assists {
 public:
  // Once a step of at most some milliseconds. Nothing changes where no controller is there.
  AssistCommand Step(const AssistSettings& settings, const AssistCar& car, const AssistInput& input, double dt_s);
  const MotionEstimator& motion() const { return motion_; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  MotionEstimator motion_;
  AntiLock anti_lock_;
  TractionControl traction_;
  StabilityControl stability_;
  PerWheel brake_Nm_{};  // of the step before
};

}  // namespace rodeira::assists
