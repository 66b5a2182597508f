// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/turn_wheel.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::input_devices {

double TurnWheel(double wheel_rad, double target_rad, double out_radps, double back_radps, double dt_s) {
  const bool across = wheel_rad * target_rad < 0.0;
  if (across || std::fabs(target_rad) < std::fabs(wheel_rad)) {
    const double goal = across ? 0.0 : target_rad;
    const double needed_s = std::fabs(wheel_rad - goal) / back_radps;
    if (needed_s > dt_s) return wheel_rad - std::copysign(back_radps * dt_s, wheel_rad);
    wheel_rad = goal;
    dt_s -= needed_s;
  }
  if (wheel_rad == target_rad) return wheel_rad;
  return wheel_rad +
         std::copysign(std::min(out_radps * dt_s, std::fabs(target_rad - wheel_rad)), target_rad - wheel_rad);
}

double LockAt(double lock_rad, double speed_mps, double half_lock_speed_mps) {
  const double ratio = speed_mps / half_lock_speed_mps;
  return lock_rad / (1.0 + ratio * ratio);
}

}  // namespace rodeira::input_devices
