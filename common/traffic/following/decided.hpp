// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"

namespace rodeira::traffic {

// What a driver decided last, and what it was decided by.
struct Decided {
  double wanted_mps2 = 0.0;
  double granted_m = 0.0;    // odometer to which zones were its own
  std::int64_t leader = -1;  // an agent; below 0: none
  std::int64_t trip = -1;    // below 0: nothing is decided
  bool due = false;          // it had to know whether it may enter the next zones
  // For the steps between two looks: the leader as it was, its trip, and how much more than the difference of
  // their odometers the gap to it is.
  bool follows = false;  // it wanted no more than that leader lets it
  std::int64_t kept = -1, kept_trip = -1;
  double apart_m = 0.0;

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

}  // namespace rodeira::traffic
