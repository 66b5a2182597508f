// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// A foot may rest on a pedal: it is pressed from above `on` until below `off`, shares of its travel.
struct PedalOptions {
  double on = 0.02;
  double off = 0.01;
};
// largest: share of the pedal's travel; the integral is of that share over time.
struct PedalPress {
  std::size_t from = 0, to = 0;  // samples [from, to)
  double largest = 0.0;
  double integral_s = 0.0;
};
// A press that is there at the series' beginning counts. A missing sample ends one.
std::vector<PedalPress> PedalPresses(Series pedal, double rate_hz, const PedalOptions& options);

// Of PedalPresses.
Measure PedalPressCount(Series pedal, double rate_hz, const PedalOptions& options);
Measure FirstPedalPress(Series pedal, double rate_hz, const PedalOptions& options);  // s after the series' beginning
Measure PedalIntegral(Series pedal, double rate_hz, const PedalOptions& options);    // of all presses
// Share of the time in which both pedals are pressed.
Measure BothPedalsShare(Series throttle, Series brake, double rate_hz, const PedalOptions& options);

}  // namespace rodeira::measures
