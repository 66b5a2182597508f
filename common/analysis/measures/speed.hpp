// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// The samples of a vehicle in motion: waits, with a speed of at most min_speed_mps, are missing. Waits at lights
// dominate a mean otherwise.
std::vector<double> InMotion(Series speed_mps, double min_speed_mps);

// Distance over time of the valid samples: the mean over time. The mean over distance weights each sample by its speed.
Measure MeanSpeed(Series speed_mps, double min_speed_mps);
// In both, samples slower than min_speed_mps are left out.
Measure MeanSpeedByDistance(Series speed_mps, double min_speed_mps);
// Share of the time above limit + over_mps, of the time with a limit. The limit is missing where none holds.
Measure ShareAboveLimit(Series speed_mps, Series limit_mps, double over_mps);
// The way, by the trapezoidal rule over each run of valid samples.
Measure Distance(Series speed_mps, double rate_hz);

}  // namespace rodeira::measures
