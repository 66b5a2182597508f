// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Between both speeds a vehicle stays as it was.
struct StopOptions {
  double standing_mps = 0.1;  // a stop begins with the first sample below
  double moving_mps = 0.5;    // and ends with the first one above
};
// A time in which the vehicle stands.
struct Stop {
  std::size_t from = 0, to = 0;  // samples [from, to)
};
// A missing sample ends a stop.
std::vector<Stop> Stops(Series speed_mps, const StopOptions& options);

// Of Stops; StopTime: all of them together, s.
Measure StopCount(Series speed_mps, const StopOptions& options);
Measure StopTime(Series speed_mps, double rate_hz, const StopOptions& options);
// Of the first stop: distance from the front bumper to the line, m, negative beyond it. ahead_m: that distance in each
// sample.
Measure StopDistance(Series speed_mps, Series ahead_m, const StopOptions& options);

}  // namespace rodeira::measures
