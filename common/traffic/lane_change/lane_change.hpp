// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

// The path of a lane change; overtaking moves to the other lane and back along the same kind of path.
namespace rodeira::traffic {

inline constexpr double kLaneChangeAcceleration_mps2 = 0.9;        // lateral
inline constexpr double kLaneChangeJerk_mps3 = 2.5;                // lateral
inline constexpr double kUrgentLaneChangeAcceleration_mps2 = 2.0;  // lateral, before the end of the lane
inline constexpr double kUrgentLaneChangeJerk_mps3 = 8.0;          // lateral
inline constexpr double kMinLaneChangeLength_m = 24.0;
inline constexpr double kMinTightChangeLength_m =
    12.0;                                             // of one for the route, where there is no room for a longer one
inline constexpr double kMinLaneChangeWidth_m = 2.6;  // of the lane that is changed to
inline constexpr double kBesideLane_m = 1.3;  // from a lane's middle to what is beside it: half of a wide car, a margin
inline constexpr double kTightestLaneChange_1pm = 0.02;                   // bends are no tighter
inline constexpr double kTightestTightChange_1pm = 0.1;                   // the same of one for the route
inline constexpr std::int64_t kLaneChangeCooldown_ns = 4'000'000'000;     // from the end of one change to the next
inline constexpr double kSameLaneOffset_m = 1e-4, kSameLaneSlope = 1e-4;  // lanes that join within these are one lane

// The quintic's largest acceleration is 5.77 offset/T², its largest jerk 60 offset/T³.
inline double LaneChangeTime_s(double offset_m) {
  const double size = std::fabs(offset_m);
  return std::max(std::sqrt(5.77 * size / kLaneChangeAcceleration_mps2), std::cbrt(60.0 * size / kLaneChangeJerk_mps3));
}
// The same where the lane ends.
inline double UrgentLaneChangeTime_s(double offset_m) {
  const double size = std::fabs(offset_m);
  return std::max(std::sqrt(5.77 * size / kUrgentLaneChangeAcceleration_mps2),
                  std::cbrt(60.0 * size / kUrgentLaneChangeJerk_mps3));
}

// The speed at which a vehicle that changes lanes within so short a way keeps to that lateral acceleration.
inline double TightChange_mps(double offset_m, double length_m) { return length_m / UrgentLaneChangeTime_s(offset_m); }

}  // namespace rodeira::traffic
