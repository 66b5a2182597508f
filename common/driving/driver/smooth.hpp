// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::driver {

// How quickly a driver lets the acceleration change, m/s³.
struct SmoothSettings {
  double planned_mps3 = 3.0;
  double emergency_mps3 = 15.0;
};

// The deceleration, m/s², from which a car comes to rest so that it changes by no more than `jerk` and is 0 with the
// speed: by steps of dt it is n j dt at the speeds n (n + 1)/2 j dt², linear between; for dt -> 0 that is sqrt(2 j v).
// 0 at rest.
double EasedStop_mps2(double speed_mps, double jerk_mps3, double dt_s);

// The way in which it can come to rest from an acceleration if the deceleration may grow without end, but changes by no
// more than `jerk`, and is 0 at rest.
double SmoothStop_m(double speed_mps, double acceleration_mps2, double jerk_mps3);

// The motion that comes to rest after a way, braked by a constant deceleration b that goes to 0 with `jerk` at the end:
// over the last b³/(6 j²) the deceleration is (6 j² x)^(1/3).
struct StopProfile {
  double speed_mps = 0.0, deceleration_mps2 = 0.0;  // where the way is still to go
};
// way_m: still to go; below 0 counts as 0.
StopProfile StopIn(double way_m, double braking_mps2, double jerk_mps3);

// Whether the deceleration `wanted` (below 0) stops the car sooner than it can stop smoothly by `jerk`, by more than a
// hand's breadth or two.
bool NeedsHaste(double wanted_mps2, double speed_mps, double acceleration_mps2, double jerk_mps3);

}  // namespace rodeira::driver
