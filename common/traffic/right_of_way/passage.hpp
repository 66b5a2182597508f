// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// Conflict zones as an agent comes to them in a step, and which have or want them.

struct Crossing {
  std::int32_t zone = -1;  // none: only a STOP line
  std::int32_t side = 0;
  double in_m = 0.0, out_m = 0.0;  // odometer
};

// Of what the zones of a passage were found from: as long as that is the same, and its front is before the first of
// them, they are as well.
struct ConflictPassageKey {
  std::uint32_t way = 0;                  // number of the way as it was seen (TrafficModel::ways_); 0: of none
  double granted_m = 0.0, until_m = 0.0;  // odometers: to which zones were its own; of its front
};

// Where a vehicle that turns across oncoming traffic waits for it, past the line of a light.
struct WaitingPlace {
  double in_m = -1.0;         // odometer where the zones of oncoming traffic begin; below 0: there is none
  std::size_t crossings = 0;  // of the passage that lie before it
  double light_m = 0.0;       // odometer of the light's line
  std::int64_t light = -1;    // its controller
};

// The next stretch of conflict zones on an agent's way that are not yet its own, up to where it may stand again.
struct ConflictPassage {
  bool any = false;
  bool due = false;   // it must know now whether it may go on
  bool head = false;  // none that waits itself stands between it and the line (this, and the next: of those that must
                      // know, and of those that others ask about)
  bool able = false;  // there is room for it behind the zones
  bool taken =
      false;  // a vehicle is where it would stand behind them, or on the way there, now; of those that must know
  bool must_stop = false;  // a STOP sign
  bool lit = false;        // there is a light in it
  bool red = false;        // … that shows something else than green
  bool barred = false;     // it waits before the line for people on foot
  double line_m = 0.0;     // odometer at which its front stops
  double end_m = 0.0;
  ConflictPassageKey key;
  double room_m = 0.0;     // odometer up to which the leader must have left
  double lacks_m = 0.0;    // of that, at most, when all ahead have come as far as they surely do
  double arrives_s = 0.0;  // of those that others ask about
  double delay_s = 0.0;    // until the one that keeps it out is out of the way
  double later_s = 0.0;    // so much later than it could it comes, as others are told
  std::int64_t waits_for = -1;
  WaitingPlace place;
  std::vector<Crossing> crossings;
};

// What a track's plan allows at a place.
struct PlannedAt {
  std::uint32_t track = 0;
  double d_m = -1e18, planned_mps = 0.0;
};

}  // namespace rodeira::traffic
