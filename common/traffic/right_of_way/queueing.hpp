// SPDX-License-Identifier: Apache-2.0
#pragma once

// How vehicles stand in queues and at lines: distances and speeds that several parts of the model share.
namespace rodeira::traffic {

inline constexpr double kStandstill_mps = 0.05;  // a vehicle that is slower stands
inline constexpr double kStopDistance_m = 0.6;   // from a stopped front to the conflict zone or signal line ahead of it
inline constexpr double kInsideDistance_m = 0.2;  // the same for a vehicle that waits past a light for oncoming traffic
inline constexpr double kZoneOverhang_m = 0.3;    // a front no farther inside a conflict zone still waits before it
inline constexpr double kLoose_m = 0.5;           // more than its minimum gap that a queueing car leaves
inline constexpr double kShort_m =
    0.05;  // so near before a line a front stands at the farthest, and drives on no more (StopAt)

}  // namespace rodeira::traffic
