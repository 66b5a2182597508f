// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/state.hpp"

namespace rodeira::traffic {

// When vehicles overtake on the lane of oncoming traffic.
struct OvertakingSettings {
  bool allowed = true;
  double sight_m = 800.0;  // sight of oncoming traffic along the road; beyond it a vehicle is assumed to approach, as
                           // fast as allowed
  double margin_s = 3.0;   // least time gap to oncoming traffic when the overtaking vehicle is back on its lane
};

// State of a vehicle that overtakes on the lane of oncoming traffic. Odometers are its own, along its own lane.
struct Overtaking {
  int side = 0;                   // of that lane: +1 left, -1 right; 0: does not overtake
  bool back = false;              // is returning to its own lane
  bool gives_up = false;          // aborts: drops back behind the vehicle ahead
  std::int64_t passed = -1;       // id of the overtaken vehicle …
  std::int64_t passed_body = -1;  // … or of a vehicle outside of the traffic model
  double clear_m = 0.0;           // odometer from which its front is clear of it
  double legal_m = 0.0;           // odometer at which it must be back at the latest
  double to_m = 0.0;              // odometer at which its front is back on its own lane
  double back_s = 0.0;            // time until its whole body is

  bool active() const { return side != 0; }
  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// The rest of an overtaking manoeuvre: first straight on at constant speed until the own lane's traffic is cleared;
// then acceleration past the overtaken vehicle, which keeps its speed; then the return at constant speed, which takes
// back_s, or back_least_m if that is longer.
struct PassCase {
  double speed_mps = 0.0, passed_mps = 0.0;
  double top_mps = 0.0, gains_mps2 = 0.0;     // until that speed
  double to_clear_m = 0.0, relative_m = 0.0;  // distance to go, and to gain on it
  double back_s = 0.0, back_least_m = 0.0;
  double length_m = 0.0;
};
// The predicted manoeuvre, in s and m from now.
struct PassPlan {
  double time_s = 0.0;     // until its rear is on its own lane …
  double way_m = 0.0;      // … and the distance travelled, less its length
  double speed_mps = 0.0;  // at the beginning of the return
  double gaining_s = 0.0;  // until the beginning of the return
};
// Times in s from now; a pure function of the case.
PassPlan PlanPass(const PassCase& at);

// How far along a lateral path of degree five a share of its width is reached: u of 10 u³ - 15 u⁴ + 6 u⁵ = share, in
// [0, 1].
double QuinticShareAt(double share);

}  // namespace rodeira::traffic
