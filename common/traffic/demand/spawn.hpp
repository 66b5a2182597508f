// SPDX-License-Identifier: Apache-2.0
#pragma once

// Limits that hold wherever a vehicle is put on the road: at the start, at an entry and by a scenario.
namespace rodeira::traffic {

inline constexpr double kSpawnBraking_mps2 = 0.8;  // a spawned vehicle needs no harder braking than this
inline constexpr double kZoneClearance_m = 1.0;    // from its ends to the next conflict zone or line
inline constexpr double kMinSpawnWidth_m = 2.0;    // of the lane

}  // namespace rodeira::traffic
