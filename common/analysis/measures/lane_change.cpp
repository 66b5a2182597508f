// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_change.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/filters.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {

std::vector<double> LateralSpeed(Series y_m, std::span<const std::int8_t> crossing, double rate_hz) {
  RODEIRA_ASSERT(crossing.size() == y_m.size());
  // y without its jumps: at a crossing it goes on as in the sample before.
  std::vector<double> smooth(y_m.begin(), y_m.end());
  double moved = 0.0;
  for (std::size_t i = 1; i < smooth.size(); ++i) {
    if (crossing[i] != 0 && !std::isnan(y_m[i]) && !std::isnan(y_m[i - 1])) {
      const double last_step =
          i >= 2 && !std::isnan(y_m[i - 2]) && crossing[i - 1] == 0 ? y_m[i - 1] - y_m[i - 2] : 0.0;
      moved += y_m[i - 1] + last_step - y_m[i];
    }
    smooth[i] += moved;
  }
  return Derivative(smooth, rate_hz);
}

std::vector<LaneChange> LaneChanges(Series y_m, std::span<const std::int8_t> crossing, double rate_hz,
                                    const LaneChangeOptions& options) {
  const std::vector<double> speed = LateralSpeed(y_m, crossing, rate_hz);
  const auto reach = static_cast<std::size_t>(options.max_duration_s * rate_hz);
  const auto keeps = [&](std::size_t i) { return std::isnan(speed[i]) || std::abs(speed[i]) < options.onset_mps; };
  std::vector<LaneChange> changes;
  for (std::size_t i = 1; i < y_m.size(); ++i) {
    if (crossing[i] == 0) continue;
    LaneChange change{i, i, i, crossing[i]};
    while (change.begin > 0 && i - change.begin < reach && !keeps(change.begin - 1)) --change.begin;
    if (change.begin > 0 && i - change.begin < reach && !std::isnan(speed[change.begin - 1])) --change.begin;
    while (change.end + 1 < y_m.size() && change.end - i < reach && !keeps(change.end)) ++change.end;
    changes.push_back(change);
  }
  return changes;
}

std::vector<double> WithoutLaneChanges(Series y_m, std::span<const LaneChange> changes) {
  std::vector<double> cut(y_m.begin(), y_m.end());
  for (const LaneChange& change : changes) {
    for (std::size_t i = change.begin; i <= change.end && i < cut.size(); ++i) cut[i] = kMissing;
  }
  return cut;
}

}  // namespace rodeira::measures
