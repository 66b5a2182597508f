// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace rodeira::network {

enum class LightColour : std::uint32_t { kRed = 0, kRedAmber = 1, kGreen = 2, kAmber = 3 };

// A further green of a cycle, with the amber behind it and the red with amber before it.
struct LightGreen {
  double from_s = 0.0;  // in [0, cycle)
  double green_s = 0.0;
  double amber_s = 3.0;
  double red_amber_s = 1.0;

  bool operator==(const LightGreen&) const = default;
};

// When the lights of a controller show what, from the run's beginning on and over again: green from `green_from_s` of
// the cycle on, then amber; red and amber before the next green; red else. Green for the whole cycle is green always.
// Times are kept to the nanosecond.
struct LightTimes {
  double cycle_s = 60.0;
  double green_from_s = 0.0;  // in [0, cycle)
  double green_s = 0.0;
  double amber_s = 3.0;
  double red_amber_s = 1.0;
  std::vector<LightGreen> more = {};  // of the same cycle, in its order; none overlaps another green
};

// The colour at a time since the run's beginning; `times` must not be wrong (WrongTimes).
LightColour ColourAt(const LightTimes& times, std::int64_t time_ns);

// Whether the green or amber of one meets the green or amber of the other. Cycles that differ meet somewhen, unless one
// is never green.
bool MeetGreen(const LightTimes& a, const LightTimes& b);

// The sentence that says what is wrong with such times: a cycle that does not hold green, amber and red with amber, a
// number out of its range, greens that overlap; null where nothing is.
const char* WrongTimes(const LightTimes& times);

}  // namespace rodeira::network
