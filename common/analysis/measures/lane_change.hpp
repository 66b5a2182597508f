// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Where a lane change begins and ends.
struct LaneChangeOptions {
  double onset_mps = 0.1;      // lateral speed below which the vehicle keeps its lane
  double max_duration_s = 10;  // of each half: begin to crossing, crossing to end
};

// Indices of samples of the series.
struct LaneChange {
  std::size_t begin = 0;     // last sample before the crossing with a lateral speed below the onset
  std::size_t crossing = 0;  // first sample in the next lane
  std::size_t end = 0;       // first sample after the crossing with a lateral speed below the onset
  int direction = 0;         // +1 to the left, -1 to the right
};

// Lane changes of a lateral position. crossing[i]: +1 where sample i is the first in the next lane to the left, -1 to
// the right, 0 elsewhere. y jumps there by a lane's width; the speed across the jump is the one before it. A change
// that begins or ends at a missing sample begins or ends there.
std::vector<LaneChange> LaneChanges(Series y_m, std::span<const std::int8_t> crossing, double rate_hz,
                                    const LaneChangeOptions& options);

// y with the samples of lane changes missing.
std::vector<double> WithoutLaneChanges(Series y_m, std::span<const LaneChange> changes);

// Lateral speed, across jumps as said above; missing where y is.
std::vector<double> LateralSpeed(Series y_m, std::span<const std::int8_t> crossing, double rate_hz);

}  // namespace rodeira::measures
