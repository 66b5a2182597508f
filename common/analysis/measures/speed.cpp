// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/speed.hpp"

#include <cmath>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNotInMotion = "no sample in motion";

}  // namespace

std::vector<double> InMotion(Series speed_mps, double min_speed_mps) {
  std::vector<double> moving(speed_mps.begin(), speed_mps.end());
  for (double& speed : moving) {
    if (!(speed > min_speed_mps)) speed = kMissing;
  }
  return moving;
}

Measure MeanSpeed(Series speed_mps, double min_speed_mps) {
  const auto moving = InMotion(speed_mps, min_speed_mps);
  return FoundOr(Mean(moving), kNotInMotion, "m/s", CountValid(moving), moving.size(),
                 Used({{"min_speed_mps", min_speed_mps}, {"mean", "over time"}}));
}

Measure MeanSpeedByDistance(Series speed_mps, double min_speed_mps) {
  const auto moving = InMotion(speed_mps, min_speed_mps);
  return FoundOr(WeightedMean(moving, moving), kNotInMotion, "m/s", CountValid(moving), moving.size(),
                 Used({{"min_speed_mps", min_speed_mps}, {"mean", "over distance"}}));
}

Measure ShareAboveLimit(Series speed_mps, Series limit_mps, double over_mps) {
  RODEIRA_ASSERT(speed_mps.size() == limit_mps.size());
  const UsedOptions used = Used({{"over_mps", over_mps}});
  std::size_t n = 0, above = 0;
  for (std::size_t i = 0; i < speed_mps.size(); ++i) {
    if (std::isnan(speed_mps[i]) || std::isnan(limit_mps[i])) continue;
    ++n;
    if (speed_mps[i] > limit_mps[i] + over_mps) ++above;
  }
  if (n == 0) return NotFound("no sample with a speed limit", "1", 0, speed_mps.size(), used);
  return Found(static_cast<double>(above) / static_cast<double>(n), "1", n, speed_mps.size(), used);
}

Measure Distance(Series speed_mps, double rate_hz) {
  double way = 0.0;
  std::size_t n = 0;
  for (const SampleRun& run : ValidRuns(speed_mps)) {
    n += run.size();
    for (std::size_t i = run.from + 1; i < run.to; ++i) way += 0.5 * (speed_mps[i - 1] + speed_mps[i]) / rate_hz;
  }
  if (n < 2) return NotFound("too few valid samples", "m", n, speed_mps.size());
  return Found(way, "m", n, speed_mps.size());
}

}  // namespace rodeira::measures
