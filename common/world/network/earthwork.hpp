// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::network {

// The transition from road to terrain, outward from the outermost lanes' edges (verges included).
struct Earthwork {
  // 0: slopes up to daylight, by the values below. > 0: over this width, beside the road and beyond its ends, the
  // road's surface, going on in its slopes, passes into the terrain by the weight 3 u^2 - 2 u^3. Only in a network of
  // one road, which has no superelevation: a world file of version 1. Version 2 has no key for it, since the blends of
  // two roads do not meet.
  double blend_m = 0.0;
  // Run over rise: a cut of 1.5 rises by 1 m in 1.5 m, a fill of 2 falls by 1 m in 2 m.
  double cut = 1.5;
  double fill = 2.0;
  // No slope reaches farther from the road; over the last fifth of it slopes grow steeper.
  double reach_m = 60.0;
};

}  // namespace rodeira::network
