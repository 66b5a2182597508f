// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/analysis/measures/statistics.hpp"

// What the steering wheel does, apart from reversals and entropy. Angles are the steering wheel's, positive to the
// left.
namespace rodeira::measures {

// Mean of |rate|, deg/s, by central differences.
Measure MeanSteeringRate(Series wheel_deg, double rate_hz);
// Share of the time in which |rate| is below still_degps.
Measure SteeringStillShare(Series wheel_deg, double rate_hz, double still_degps = 1.0);

// The two bands, and the segments of the spectrum.
struct HighFrequencyOptions {
  double from_hz = 0.3;
  double to_hz = 0.6;
  double segment_s = 60.0;  // Welch, Hann, half overlapped; a shorter interval is one segment
};
// High-frequency component: power in [from, to] over power up to `to`.
Measure HighFrequencySteering(Series wheel_deg, double rate_hz, const HighFrequencyOptions& options);

}  // namespace rodeira::measures
