// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

// What a driver feels in a steering wheel with motors.
namespace rodeira::input_devices {

// `force` of a wheel file. All torques at the rim's axis; the values are choices of this project.
struct ForceSettings {
  double device_Nm = 2.2;         // what the device gives at its most
  double most_Nm = 2.2;           // no more is asked of it, whatever the car does
  double share = 0.35;            // of the torque at the car's own steering wheel
  double friction_Nm = 0.12;      // against turning, however slowly
  double damping_Nmsprad = 0.03;  // against turning, the faster the more
  double stop_Nmprad = 6.0;       // beyond the car's lock
  double road_feel = 1.0;         // of what bumps under one front wheel do at the rim; 0: none
  double fade_s = 1.0;            // from nothing to full, from the first moment on and after each pause
  double stale_s = 0.1;           // a car that was heard of longer ago pulls no more
};

// The wheel and the car, now. Angles and torques are positive to the left.
struct ForceMoment {
  double wheel_rad = 0.0;                // of the rim
  double lock_rad = 7.85;                // of the car's steering wheel, each side
  double car_torque_Nm = 0.0;            // what the road gives back (VehicleState::steering_torque_Nm)
  double front_load_difference_N = 0.0;  // of the front wheels, left less right
};

// Torque of the rim's motor:
//   T = fade (share T_car + T_road - friction tanh(w / w0) - damping w) - stop (angle beyond the lock), |T| <= most,
// w the rim's speed, w0 = 0.1 rad/s. The road's roughness, with the wheel straight too:
//   T_road = road_feel kFeelArm_m (D - D smoothed over kFeelSlow_s), |T_road| <= kFeelMost_Nm,
// D the difference of the front wheels' loads: a bump under the left wheel holds it back, which pulls to the left. Load
// that shifts in a bend is slower, and felt by T_car alone. `fade` grows evenly from 0 to 1 over fade_s of unbroken
// calls: after a pause, or where the wheel was away, it begins again, so that no hand is surprised. The stop does not
// fade: it never pulls outward.
class ForceFeedback {
 public:
  static constexpr double kStill_radps = 0.1;
  static constexpr double kFeelArm_m =
      0.010 / 16.0;                            // a scrub radius of 10 mm at the kingpins, over a steering's ratio of 16
  static constexpr double kFeelSlow_s = 0.15;  // what is slower than 1 Hz is no bump
  static constexpr double kFeelMost_Nm = 0.6;

  explicit ForceFeedback(const ForceSettings& settings) : settings_(settings) {}

  // `now_s`: of a clock on the wall that never jumps. A share of what the device gives at its most, from -1 to 1.
  double Step(const ForceMoment& moment, double now_s);
  // The device is gone, or the car: the next step begins anew.
  void Forget() { before_.reset(); }

 private:
  double RoadFeel(double difference_N, double passed_s);

  struct Before {
    double now_s = 0.0, wheel_rad = 0.0;
  };
  ForceSettings settings_;
  std::optional<Before> before_;
  double fade_ = 0.0;
  double speed_radps_ = 0.0;  // smoothed: a device counts in whole steps
  double slow_N_ = 0.0;       // the loads' difference, smoothed
};

}  // namespace rodeira::input_devices
