// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {

// The position in the lane over time: y of the reference point from the lane's middle, positive to the left of the
// lane's traffic. `episode` numbers the time in one lane: it changes where y changes its lane, and stays where the lane
// goes on into the next road. Both have the same length.
struct LanePosition {
  Series y_m;
  std::span<const std::int32_t> episode;
};

// The runs of valid samples of one episode.
std::vector<SampleRun> LaneRuns(const LanePosition& position);

// How deviations are pooled, and when there are too few samples.
struct SdlpOptions {
  Denominator denominator = Denominator::kNMinus1;
  double min_valid_share = 0.85;  // below, the value is missing
};
// Standard deviation of lateral position (SAE J2944 10.1.3): about the mean of each episode, pooled. Samples of lane
// changes are to be missing in y.
Measure Sdlp(const LanePosition& position, const SdlpOptions& options);

// The high-pass, and which runs count.
struct ModifiedSdlpOptions {
  Denominator denominator = Denominator::kNMinus1;
  double cutoff_hz = 0.1;
  bool both_ways = true;       // forward and backward: a gain of 1/2 at the cut-off; one pass: 0.707
  double min_duration_s = 30;  // of a run; shorter ones are left out
};
// SD of y behind a high-pass (Butterworth, order 2), pooled over all runs (AIDE D2.2.5, Oestlund et al. 2005).
Measure ModifiedSdlp(const LanePosition& position, double rate_hz, const ModifiedSdlpOptions& options);

}  // namespace rodeira::measures
