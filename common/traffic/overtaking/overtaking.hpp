// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"

namespace rodeira::traffic {

// When agents pass slower ones on the lane of oncoming traffic.
struct OvertakingSettings {
  bool allowed = true;
  double sight_m = 800.0;  // so far along the road oncoming traffic is seen; what is not is taken to come from there,
                           // as fast as may be
  double margin_s = 3.0;   // that oncoming traffic has still to go to the place where the other one is back on its lane
};

// An agent that passes another vehicle on the lane of oncoming traffic. Odometers are the agent's, along its own lane.
struct Overtaking {
  int side = 0;                   // on which that lane lies: +1 left, -1 right; 0: does not overtake
  bool back = false;              // on its path back to its own lane
  bool gives_up = false;          // falls back behind the one to be passed
  std::int64_t passed = -1;       // the agent that is passed …
  std::int64_t passed_body = -1;  // … or the id of another vehicle
  double clear_m = 0.0;           // its front from here on is clear of the one passed
  double legal_m = 0.0;           // where it must be back at the latest
  double to_m = 0.0;              // where its front is back on its own lane, as told by its motion
  double back_s = 0.0;            // until all of it is

  bool active() const { return side != 0; }
  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// What has to be done to pass, from now on: first as far as the own lane's traffic is not cleared yet, at the speed
// that it has; then gaining on the one passed, which keeps its speed; then back, with the speed that it has, on a path
// that takes a time, or a distance where that is longer.
struct PassCase {
  double speed_mps = 0.0, passed_mps = 0.0;
  double top_mps = 0.0, gains_mps2 = 0.0;     // until that speed
  double to_clear_m = 0.0, relative_m = 0.0;  // still to go, and to gain
  double back_s = 0.0, back_least_m = 0.0;
  double length_m = 0.0;
};
// How the pass goes.
struct PassPlan {
  double time_s = 0.0;     // until its rear is on its own side …
  double way_m = 0.0;      // … and how far its front then has come but for its length
  double speed_mps = 0.0;  // when it begins to go back
  double gaining_s = 0.0;  // until then
};
// Times in s from now; a pure function of the case.
PassPlan PlanPass(const PassCase& at);

// How far along a lateral path of degree five a share of its width is reached: u of 10 u³ - 15 u⁴ + 6 u⁵ = share, in
// [0, 1].
double QuinticShareAt(double share);

}  // namespace rodeira::traffic
