// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/analysis/measures/mean_deviation.hpp"

namespace rodeira::measures {

// The lane-change test of a study: signs along one road, each with the lane that it demands.
struct LaneChangeTest {
  std::vector<LaneChangeSign> signs;  // ascending; none: there is no test
  double start_t_m = 0.0;             // middle of the lane before the first sign
  std::optional<int> road;            // index of the road in the world's file; none: stations of any road count
};

// A person's own path: the begin of the change before the sign, and its length.
struct OwnPath {
  ReferencePath path;
  std::size_t changes = 0;  // that it is the mean of; 0: none was found, and `path` is the basic one
};
// Of the person's baseline. A change goes from the last station at which a tenth of it is done to the first one at
// which nine tenths are, lengthened to the whole by a straight line. Signs without such a change within 100 m before
// and behind them, and signs that demand no change, are left out.
OwnPath FindOwnPath(Series s_m, Series t_m, const LaneChangeTest& test);

// Mean time from where a sign can be read, `legible_m` before it, to the begin of its change, s; found as above.
// Negative where it begins before. Missing where no sign has a change.
Measure ChangeDelay(Series s_m, Series t_m, double rate_hz, const LaneChangeTest& test, double legible_m);

// Mean deviation without wrong lanes: over the signs with a lane that is reached at `by_m` behind them, each from the
// begin of its change to that of the next sign's; the first and the last one with `run_in_m` and `run_out_m`.
Measure CorrectDeviation(Series s_m, Series t_m, const LaneChangeTest& test, const ReferencePath& path,
                         double half_lane_m, double by_m, double run_in_m, double run_out_m);

}  // namespace rodeira::measures
