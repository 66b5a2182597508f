// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::driver {

// The Intelligent Driver Model (Treiber, Hennecke, Helbing, Phys. Rev. E 62, 1805, 2000).
struct IdmSettings {
  double time_gap_s = 1.5;             // T
  double min_gap_m = 2.0;              // s0
  double acceleration_mps2 = 1.4;      // a
  double braking_mps2 = 2.0;           // b, comfortable
  double max_deceleration_mps2 = 8.0;  // no deceleration beyond it
};

// dv/dt = a [1 - (v/v0)^4 - (s*/s)²],  s* = s0 + max(0, v T + v dv / (2 sqrt(a b))), dv = v - leader's speed, s the gap
// from bumper to bumper. Above the desired speed v0 the free part is -b [1 - (v0/v)^(4a/b)], which slows down
// comfortably. Returns the acceleration in m/s², clamped to [-max_deceleration_mps2, a]. With a gap of 0 or less it is
// -max_deceleration_mps2.
double IdmAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps, double gap_m, double leader_mps);
// Without a leader: the free part alone, m/s².
double IdmFreeAcceleration(const IdmSettings& idm, double speed_mps, double desired_mps);
// The gap that a platoon keeps: (s0 + v T) / sqrt(1 - (v/v0)^4); infinite from v0 on.
double IdmEquilibriumGap(const IdmSettings& idm, double speed_mps, double desired_mps);

}  // namespace rodeira::driver
