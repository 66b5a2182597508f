// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::traffic {

// Agents and crossings for people on foot, in a step.

// What is so at a crossing for people on foot.
struct AtCrossing {
  bool held = false;     // a vehicle drives there that does not let them go, or stands there
  bool blocked = false;  // a vehicle stands there
  bool tired = false;    // a vehicle has waited long for pedestrians
  bool go = false;       // the lights let them go
};

// An agent that comes to a crossing.
struct ToCrossing {
  std::uint32_t id = 0, crossing = 0, pass = 0;
  double line_m = 0.0;  // odometer at which its front stops
  bool able = false;    // it can stop there comfortably
};

// The crossing that an agent stops for.
struct Yielding {
  std::uint32_t crossing = 0;  // its index and 1; 0: for none
  double waited_s = 0.0;       // at rest
};

}  // namespace rodeira::traffic
