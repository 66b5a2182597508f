#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/traffic/agent.hpp"

namespace rodeira::traffic {

// Conflict zones as an agent comes to them in a step, and who has or wants them.

struct Crossing {
  std::int64_t zone = -1;  // none: only a STOP line
  int side = 0;
  double in_m = 0.0, out_m = 0.0;  // odometer
};

// The next stretch of conflict zones on an agent's way that are not yet its own, up to where it may stand again.
struct Passage {
  bool any = false;
  bool due = false;        // it must know now whether it may go on
  bool head = false;       // nobody stands between it and the line who waits himself
  bool able = false;       // there is room for it behind the zones
  bool must_stop = false;  // a STOP sign
  bool lit = false;        // there is a light in it
  bool red = false;        // … that shows something else than green
  bool barred = false;     // it waits before the line for people on foot
  double line_m = 0.0;     // odometer at which its front stops
  double end_m = 0.0;
  double room_m = 0.0;  // odometer up to which who is ahead must have left
  double lacks_m = 0.0;  // of that, at most, when all ahead have come as far as they surely do
  double arrives_s = 0.0, clears_s = 0.0;
  double delay_s = 0.0;  // until who keeps it out is out of the way
  double later_s = 0.0;  // so much later than it could it comes, as others are told
  std::int64_t waits_for = -1;
  std::vector<Crossing> crossings;
};

// What a track's plan allows at a place.
struct PlannedAt {
  std::uint32_t track = 0;
  double d_m = -1e18, planned_mps = 0.0;
};

// Somebody who holds a side of a zone. Ids from agents_.size() on are others.
struct Holder {
  std::uint32_t id = 0;
  ZoneGrant grant;
  double out_m = 0.0;  // odometer at the zone's end
};

// Somebody who comes to a side of a zone. When, is found out where it is asked for: few are.
struct Comer {
  std::uint32_t id = 0;
  double in_m = 0.0, out_m = 0.0;          // odometer; of agents
  double arrives_s = 0.0, clears_s = 0.0;  // of others
};

// A zone in a step: all of it by side, in two lines of memory, of which most ask for the first alone, since who comes to a junction asks for many of them.
struct alignas(64) ZoneNow {
  bool touched = false;           // anything is said of it
  std::array<bool, 2> awaited{};  // an urgent agent waits for this side to end
  std::array<std::vector<Holder>, 2> holders;
  std::array<std::vector<Comer>, 2> comers;
  std::array<double, 2> room_for_s{};  // so long somebody has waited for room behind it that this side could take
};

}  // namespace rodeira::traffic
