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

}  // namespace

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
