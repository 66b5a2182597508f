// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::driver {

// When a driver changes lanes: MOBIL (Kesting, Treiber, Helbing, Transportation Research Record 1999, 86, 2007).
struct MobilSettings {
  double politeness = 0.2;      // p: what the others' accelerations count against the own one
  double threshold_mps2 = 0.1;  // a change must bring more than this …
  double bias_mps2 = 0.3;  // … and so much less towards the side on which one keeps (the right; in left-hand traffic
                           // the left), so much more away from it
  double safe_mps2 = 2.0;  // no vehicle has to brake harder
};

// Accelerations by a car-following model, m/s²: of the one that changes, of its new follower, of its present follower;
// each as it is and as it would be after the change.
struct MobilCase {
  double own_mps2 = 0.0, own_then_mps2 = 0.0;
  double new_follower_mps2 = 0.0, new_follower_then_mps2 = 0.0;
  double old_follower_mps2 = 0.0, old_follower_then_mps2 = 0.0;
};

// ã_n >= -safe, and as much for the one that changes.
bool MobilIsSafe(const MobilSettings& settings, const MobilCase& at);
// ã_c - a_c + p [(ã_n - a_n) + (ã_o - a_o)] - threshold, plus the bias towards the side to keep on, less it away from
// it: a change is worth while where that is above 0.
double MobilSurplus(const MobilSettings& settings, const MobilCase& at, bool to_keep);

}  // namespace rodeira::driver
