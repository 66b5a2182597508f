// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_change_test.hpp"

#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

// Shares of a change between which its slope is taken.
constexpr double kFrom = 0.1, kTo = 0.9;
constexpr double kReach_m = 100.0;

struct Change {
  double begin_m = 0.0, length_m = 0.0;
};

// From lateral position a to b, near a sign.
std::optional<Change> ChangeAt(Series s_m, Series t_m, double sign_s_m, double a_m, double b_m) {
  std::optional<double> from, to;
  for (std::size_t i = 1; i < s_m.size() && !to; ++i) {
    if (!(s_m[i] > s_m[i - 1]) || std::abs(s_m[i] - sign_s_m) > kReach_m || std::isnan(t_m[i - 1] + t_m[i])) continue;
    const double before = (t_m[i - 1] - a_m) / (b_m - a_m), now = (t_m[i] - a_m) / (b_m - a_m);
    const auto passes = [&](double share) { return before < share && now >= share; };
    const auto at = [&](double share) {
      return s_m[i - 1] + (share - before) / (now - before) * (s_m[i] - s_m[i - 1]);
    };
    if (passes(kFrom)) from = at(kFrom);
    if (from && passes(kTo)) to = at(kTo);
  }
  if (!to) return std::nullopt;
  const double length_m = (*to - *from) / (kTo - kFrom);
  return Change{*from - kFrom * length_m, length_m};
}

// The sample, with its fraction, at which a station is passed.
std::optional<double> SampleAt(Series s_m, double at_s_m) {
  for (std::size_t i = 1; i < s_m.size(); ++i) {
    if (s_m[i - 1] <= at_s_m && s_m[i] > at_s_m)
      return static_cast<double>(i - 1) + (at_s_m - s_m[i - 1]) / (s_m[i] - s_m[i - 1]);
  }
  return std::nullopt;
}

}  // namespace

Measure ChangeDelay(Series s_m, Series t_m, double rate_hz, const LaneChangeTest& test, double legible_m) {
  RODEIRA_ASSERT(s_m.size() == t_m.size());
  double sum_s = 0.0, lane_t_m = test.start_t_m;
  std::size_t changes = 0;
  for (const LaneChangeSign& sign : test.signs) {
    const double from_t_m = lane_t_m;
    lane_t_m = sign.target_t_m;
    if (from_t_m == lane_t_m) continue;
    const auto change = ChangeAt(s_m, t_m, sign.s_m, from_t_m, lane_t_m);
    const auto read = SampleAt(s_m, sign.s_m - legible_m);
    const auto begins = change ? SampleAt(s_m, change->begin_m) : std::nullopt;
    if (!read || !begins) continue;
    ++changes;
    sum_s += (*begins - *read) / rate_hz;
  }
  const UsedOptions used = Used({{"legible_m", legible_m}});
  if (changes == 0) return NotFound("there is no lane change at a sign", "s", 0, test.signs.size(), used);
  return Found(sum_s / static_cast<double>(changes), "s", changes, test.signs.size(), used);
}

Measure CorrectDeviation(Series s_m, Series t_m, const LaneChangeTest& test, const ReferencePath& path,
                         double half_lane_m, double by_m, double run_in_m, double run_out_m) {
  const std::size_t signs = test.signs.size();
  const UsedOptions used = Used({{"before_m", path.before_m},
                                 {"length_m", path.length_m},
                                 {"half_lane_m", half_lane_m},
                                 {"by_m", by_m},
                                 {"mean", "over distance"}});
  double integral = 0.0, way_m = 0.0;
  std::size_t correct = 0;
  for (std::size_t i = 0; i < signs; ++i) {
    const auto one = std::span(test.signs).subspan(i, 1);
    if (CorrectChanges(s_m, t_m, one, half_lane_m, by_m).value != 1.0) continue;
    const double from = i == 0 ? one[0].s_m - run_in_m : one[0].s_m - path.before_m;
    const double to = i + 1 == signs ? one[0].s_m + run_out_m : test.signs[i + 1].s_m - path.before_m;
    const Measure deviation = MeanDeviation(s_m, t_m, from, to, test.signs, path);
    if (!deviation.value) continue;
    ++correct;
    integral += *deviation.value * (to - from);
    way_m += to - from;
  }
  if (correct == 0) return NotFound("no lane that a sign demands is reached", "m", 0, signs, used);
  return Found(integral / way_m, "m", correct, signs, used);
}

OwnPath FindOwnPath(Series s_m, Series t_m, const LaneChangeTest& test) {
  RODEIRA_ASSERT(s_m.size() == t_m.size());
  OwnPath own;
  own.path.start_t_m = test.start_t_m;
  double before_m = 0.0, length_m = 0.0, lane_t_m = test.start_t_m;
  for (const LaneChangeSign& sign : test.signs) {
    const double from_t_m = lane_t_m;
    lane_t_m = sign.target_t_m;
    if (from_t_m == lane_t_m) continue;
    const auto change = ChangeAt(s_m, t_m, sign.s_m, from_t_m, lane_t_m);
    if (!change) continue;
    ++own.changes;
    before_m += sign.s_m - change->begin_m;
    length_m += change->length_m;
  }
  if (own.changes == 0) return own;
  own.path.before_m = before_m / static_cast<double>(own.changes);
  own.path.length_m = length_m / static_cast<double>(own.changes);
  return own;
}

}  // namespace rodeira::measures
