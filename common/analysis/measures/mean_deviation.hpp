// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/analysis/measures/measure.hpp"

// The lane-change test (ISO 26022): lateral deviation from a reference path that changes lanes at signs.
namespace rodeira::measures {

// A sign of the test, in the road's s and t (positive to the left).
struct LaneChangeSign {
  double s_m = 0.0;         // station of the sign
  double target_t_m = 0.0;  // lateral position of the middle of the lane that it demands
};
// The basic path begins its change `before_m` before the sign, and is `length_m` long; an adaptive one takes both from
// the person's own baseline.
struct ReferencePath {
  double before_m = 30.0;
  double length_m = 10.0;
  double start_t_m = 0.0;  // lateral position before the first sign
};
// The reference's lateral position at a station. The signs are ascending.
double ReferenceAt(double s_m, std::span<const LaneChangeSign> signs, const ReferencePath& path);

// Mean deviation over distance: (1/L) integral |t - reference| ds, between two stations. s_m and t_m are samples of the
// vehicle; what is between them is linear; pieces that go backward, or with a missing end, are left out.
Measure MeanDeviation(Series s_m, Series t_m, double from_s_m, double to_s_m, std::span<const LaneChangeSign> signs,
                      const ReferencePath& path);

// Share of the signs with a lane that is reached: |t - target| < half_lane_m at `by_m` behind the sign.
Measure CorrectChanges(Series s_m, Series t_m, std::span<const LaneChangeSign> signs, double half_lane_m, double by_m);

}  // namespace rodeira::measures
