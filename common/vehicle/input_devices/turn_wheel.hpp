// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::input_devices {

// A steering wheel that a key or a thumb turns, dt_s later: first back towards the middle, where the target lies there,
// then outwards with what is left of dt_s. All angles are positive to the left.
double TurnWheel(double wheel_rad, double target_rad, double out_radps, double back_radps, double dt_s);

// What is left of the lock at this speed: lock / (1 + (v / half_lock_speed)²), about the same lateral acceleration at
// all speeds from walking pace on.
double LockAt(double lock_rad, double speed_mps, double half_lock_speed_mps);

}  // namespace rodeira::input_devices
