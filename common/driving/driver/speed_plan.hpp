// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/driving/driver/way.hpp"

namespace rodeira::driver {

// What bounds the driver's speed.
struct SpeedPlanSettings {
  double lateral_mps2 = 2.0;   // comfortable in bends: see LateralAllowed
  double vertical_mps2 = 1.5;  // comfortable over crests and through sags: v² |vertical curvature|
  double braking_mps2 = 1.5;   // planned before a bend or the end
  double tips_mps2 = 1e6;      // g track / (2 height of the centre of mass): so much sideways tips the vehicle over
  double steep_grade = 0.06;   // downhill, from this grade on …
  double steep_factor = 0.9;   // … so much of the speed
  bool stop_at_end = false;    // speed 0 at the lane's end
  double end_margin_m = 3.0;   // so far before it
};

// v² |curvature| in m/s² that a bend allows with ground that leans outward by `outward` (rise over distance towards the
// inside; below 0: inward). In the frame of the car weight and centrifugal force point tan(atan(outward) + atan(v²
// |curvature| / g)) beside the ground's normal (a banked curve): that many g are at most lateral_mps2, and nothing is
// gained where the ground leans inward. Where the lean alone takes up more than three quarters of it a quarter remains
// for the bend, as long as both stay below 0.6 of tips_mps2; beyond that 0.2 m/s², a crawl.
double LateralAllowed(double outward, const SpeedPlanSettings& settings);

// The speed that a lane allows a careful driver: the least of the limit and what bends, crests and steep descents
// leave, met by planned braking. Computed once a lane; immutable from then on.
class SpeedPlan {
 public:
  SpeedPlan(const Way& path, const SpeedPlanSettings& settings);

  // The speed that the plan allows, and how it changes along the way.
  struct Allowed {
    double speed_mps = 0.0;
    double slope_1ps = 0.0;  // d speed / d distance; times speed it is the acceleration that keeps to the plan
  };
  // At a distance along the way.
  Allowed At(double d_m) const;

  // v² there; linear between: constant acceleration. Only where it bends: near memory holds a street then.
  struct Node {
    double d_m = 0.0, squared_m2ps2 = 0.0;
  };
  // Two nodes: most of a town's streets have no others.
  struct Even {
    Node first, last;

    Allowed At(double d_m) const;  // to the bit what the plan says
  };
  // The part of it about a place, and from where to where that says what the plan says.
  struct Part {
    Even nodes;
    double from_m = 0.0, to_m = 0.0;
  };
  // The range is huge where no node bounds it.
  Part Around(double d_m) const;

 private:
  std::vector<Node> nodes_;
  bool is_even_ = false;
  Even ends_;  // where there are no others they are all that is asked
};

}  // namespace rodeira::driver
