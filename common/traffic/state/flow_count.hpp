// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::traffic {

// How many vehicles of a flow have arrived, and how many of those have been given a vehicle (fewer only where all
// `vehicles` of the settings are in use). Given = waiting to enter + on the road + ended, always (without vehicles that
// a scenario lets appear).
struct FlowCount {
  std::uint32_t arrived = 0, given = 0;
  std::int64_t next_ns = -1;  // time of the next arrival; below 0: none
};

// A vehicle that waits for room in the middle of a lane.
struct SpawningVehicle {
  std::uint32_t id = 0, track = 0;
  double d_m = 0.0, speed_mps = 0.0;
};

}  // namespace rodeira::traffic
