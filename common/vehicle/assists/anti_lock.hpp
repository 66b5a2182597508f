// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/state.hpp"
#include "common/vehicle/assists/motion_estimator.hpp"

namespace rodeira::assists {

// Slips are from 0 (the wheel rolls) to 1 (it is locked).
struct AntiLockSettings {
  double slip = 0.11;              // that is held where the road bears a force as large as the load
  double min_slip = 0.03;          // on the slipperiest one
  double fast_radps = 25.0;        // bandwidth of the slip controller, at most
  double relaxation_m = 0.25;      // travel in which a tyre follows its slip: bounds the bandwidth at low speeds
  double build_Nmps = 6000.0;      // by which a brake's torque can rise, and …
  double release_Nmps = 20000.0;   // … fall in a second
  double min_speed_mps = 1.5;      // below it the brakes are the driver's
  double yaw_delay_Nmps = 1500.0;  // while a front wheel is held far below the other: how fast that one may rise
};

// Anti-lock brakes: each front wheel by itself, the rear wheels together by the one that slips more (select low), with
// a delayed rise of the better front wheel on a split road, so that the driver has time to steer (principles: Robert
// Bosch GmbH, Automotive Handbook, chapter "Driving-safety systems"). The law controls a mixture of slip and its rate
// (S. M. Savaresi, M. Tanelli, Active Braking Control Systems Design for Vehicles, 2010): with a wheel of inertia J at
// speed v
//   d torque / dt = J v / R (w² (slip wanted - slip) - 1.8 w d slip / dt).
class AntiLock {
 public:
  // Torques of the brakes, from those that are wanted, N m.
  PerWheel Step(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
                const MotionEstimator& motion, const PerWheel& wanted_Nm, double dt_s);
  // Whether the wheel's torque was limited in the last step.
  bool acts(std::size_t wheel) const { return cap_Nm_[wheel] >= 0.0; }

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  // One wheel by itself: its cap and slip.
  void Control(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
               const MotionEstimator& motion, std::size_t wheel, double wanted_Nm, double dt_s);
  double SlipWanted(const AntiLockSettings& settings, const AssistCar& car, const AssistInput& input,
                    const MotionEstimator& motion, std::size_t wheel, double dt_s);

  PerWheel cap_Nm_{-1.0, -1.0, -1.0, -1.0};  // below 0: the wheel is not controlled
  PerWheel slip_{};
  PerWheel given_Nm_{};                    // in the step before
  PerWheel friction_{1.0, 1.0, 1.0, 1.0};  // of the road as far as it is known
};

}  // namespace rodeira::assists
