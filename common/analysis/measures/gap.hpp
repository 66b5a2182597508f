// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// SAE J2944 8.1.4. The gap is from the own front to the leader's rear, the headway from front to front.
struct FollowedOptions {
  double max_gap_m = 150.0;     // a leader that is farther ahead is none
  double max_time_gap_s = 6.0;  // the same in time, unless it is nearer than near_gap_m
  double near_gap_m = 20.0;     // in a queue, time gaps are long
  double min_speed_mps = 0.1;   // below, a time gap is missing
};
// As a measure tells its options.
UsedOptions UsedOf(const FollowedOptions& options);

// The gap where there is a leader within the limits; missing elsewhere. The limit grows with the own speed, from
// near_gap_m to max_gap_m; where the speed is missing, it is max_gap_m.
std::vector<double> FollowedGap(Series gap_m, Series own_mps, const FollowedOptions& options);
// gap / own speed, s; missing below the least speed, above the longest time gap, and where the gap is missing.
std::vector<double> TimeGap(Series gap_m, Series own_mps, const FollowedOptions& options);
// headway = gap + the leader's length.
std::vector<double> Headway(Series gap_m, Series leader_length_m);

// The share of all samples that are not missing in `gap_m`; missing only where there are no samples at all.
Measure LeaderShare(Series gap_m, const FollowedOptions& options);

}  // namespace rodeira::measures
