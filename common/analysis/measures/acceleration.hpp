// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/analysis/measures/measure.hpp"

// Acceleration and jerk from the speed: a recorded acceleration in single precision is too coarse to differentiate.
namespace rodeira::measures {

// How the speed is filtered before it is differentiated.
struct AccelerationOptions {
  double cutoff_hz = 5.0;  // low-pass of the speed: Butterworth order 2, forward and backward
  double window_s = 1.0;   // of means and slopes
};

// The derivative of the low-passed speed, m/s^2, and its derivative, m/s^3. Missing where a run is too short.
std::vector<double> SmoothAcceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options);
std::vector<double> Jerk(Series speed_mps, double rate_hz, const AccelerationOptions& options);

// The largest deceleration, positive; of the mean over window_s (difference of the speed over the window).
Measure LargestDeceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options);
Measure LargestMeanDeceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options);
// The largest negative jerk by the slope of the acceleration over window_s, positive.
Measure LargestNegativeJerk(Series speed_mps, double rate_hz, const AccelerationOptions& options);
// The root of the mean square of Jerk, m/s^3.
Measure RmsJerk(Series speed_mps, double rate_hz, const AccelerationOptions& options);

// Filter and threshold of DiscomfortShare.
struct DiscomfortOptions {
  double cutoff_hz = 5.0;
  double threshold_mps2 = 1.5;  // of the acceleration in the plane of the road
};
// Share of the time with an acceleration beyond the threshold: of dv/dt of the low-passed speed and v times the yaw
// rate, as lengths of a vector. Missing where the yaw rate is.
Measure DiscomfortShare(Series speed_mps, Series yaw_radps, double rate_hz, const DiscomfortOptions& options);

}  // namespace rodeira::measures
