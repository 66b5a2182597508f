// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// How a driver follows the speed of the leader (Brookhuis, de Waard & Mulder 1994).
struct FollowingOptions {
  double segment_s = 60.0;       // Hann window, half overlapped, without the mean
  double frequency_hz = 0.0;     // at which the leader's speed is varied; 0: where coherence is greatest
  double highest_hz = 0.1;       // of that search
  std::size_t min_segments = 5;  // one segment alone always has a coherence of 1
  double rate_hz = 4.0;          // to which faster series are decimated, at least
};
// At one frequency.
struct Following {
  Measure coherence;  // 0 to 1
  Measure modulus;    // own amplitude over the leader's
  Measure phase;      // rad; negative: the driver is later
  Measure delay;      // s, by the phase at the frequency; it wraps at half a period
};
// Both speeds have the same length; segments with a missing sample are left out. A leader's change is to be missing.
Following FollowLeader(Series leader_mps, Series own_mps, double rate_hz, const FollowingOptions& options);

}  // namespace rodeira::measures
