// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rodeira::traffic {

// Agents and crossings for people on foot, in a step.

// What is so at a crossing for people on foot.
struct AtCrossing {
  bool held = false;     // somebody drives there who does not let them go, or stands there
  bool blocked = false;  // somebody stands there
  bool tired = false;    // somebody has waited long for those on foot
  bool go = false;       // the lights let them go
};

// An agent that comes to a crossing.
struct ToCrossing {
  std::uint32_t id = 0, crossing = 0, pass = 0;
  double line_m = 0.0;  // odometer at which its front stops
  bool able = false;    // it can stop there comfortably
};

// For whom an agent stops.
struct Yielding {
  std::uint32_t crossing = 0;  // its index and 1; 0: for nobody
  double waited_s = 0.0;       // at rest
};

}  // namespace rodeira::traffic
