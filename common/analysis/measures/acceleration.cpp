// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/acceleration.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoAcceleration = "too few samples for the filter, or no cut-off below half the sample rate";

UsedOptions AccelerationUsed(const AccelerationOptions& options, bool window) {
  UsedOptions used = Used({{"cutoff_hz", options.cutoff_hz}, {"padding_s", kPadding_s}});
  if (window) used.push_back(Used({{"window_s", options.window_s}}).front());
  return used;
}

// (x(t + window) - x(t)) / window.
std::vector<double> SlopeOver(Series x, double rate_hz, double window_s) {
  const auto width = std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(window_s * rate_hz)));
  std::vector<double> slope;
  for (std::size_t i = 0; i + width < x.size(); ++i)
    slope.push_back((x[i + width] - x[i]) * rate_hz / static_cast<double>(width));
  return slope;
}

Measure LargestFall(Series slope, const char* unit, Series speed_mps, UsedOptions used, const char* reason) {
  const auto least = Minimum(slope);
  const std::size_t n = CountValid(slope);
  if (!least) return NotFound(reason, unit, n, speed_mps.size(), std::move(used));
  return Found(std::max(0.0, -*least), unit, n, speed_mps.size(), std::move(used));
}

}  // namespace

std::vector<double> SmoothAcceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  if (!IsCutoff(options.cutoff_hz, rate_hz)) return std::vector<double>(speed_mps.size(), kMissing);
  const auto section = ButterworthLowPass(options.cutoff_hz, rate_hz);
  return Derivative(FilterRunsBothWays(section, speed_mps, PaddingSamples(kPadding_s, rate_hz)), rate_hz);
}

std::vector<double> Jerk(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  return Derivative(SmoothAcceleration(speed_mps, rate_hz, options), rate_hz);
}

Measure LargestDeceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  return LargestFall(SmoothAcceleration(speed_mps, rate_hz, options), "m/s2", speed_mps,
                     AccelerationUsed(options, false), kNoAcceleration);
}

Measure LargestMeanDeceleration(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  return LargestFall(SlopeOver(speed_mps, rate_hz, options.window_s), "m/s2", speed_mps,
                     Used({{"window_s", options.window_s}}), "the interval is shorter than the window");
}

Measure LargestNegativeJerk(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  return LargestFall(SlopeOver(SmoothAcceleration(speed_mps, rate_hz, options), rate_hz, options.window_s), "m/s3",
                     speed_mps, AccelerationUsed(options, true), "the interval is shorter than the window");
}

Measure RmsJerk(Series speed_mps, double rate_hz, const AccelerationOptions& options) {
  std::vector<double> square = Jerk(speed_mps, rate_hz, options);
  for (double& value : square) value *= value;
  const auto mean = Mean(square);
  const std::size_t n = CountValid(square);
  if (!mean) return NotFound(kNoAcceleration, "m/s3", n, speed_mps.size(), AccelerationUsed(options, false));
  return Found(std::sqrt(*mean), "m/s3", n, speed_mps.size(), AccelerationUsed(options, false));
}

Measure DiscomfortShare(Series speed_mps, Series yaw_radps, double rate_hz, const DiscomfortOptions& options) {
  RODEIRA_ASSERT(speed_mps.size() == yaw_radps.size());
  const AccelerationOptions filter{.cutoff_hz = options.cutoff_hz};
  const std::vector<double> along_mps2 = SmoothAcceleration(speed_mps, rate_hz, filter);
  UsedOptions used = AccelerationUsed(filter, false);
  used.push_back(Used({{"threshold_mps2", options.threshold_mps2}}).front());
  std::size_t n = 0, beyond = 0;
  for (std::size_t i = 0; i < speed_mps.size(); ++i) {
    const double size_mps2 = std::hypot(along_mps2[i], speed_mps[i] * yaw_radps[i]);
    if (std::isnan(size_mps2)) continue;
    ++n;
    if (size_mps2 > options.threshold_mps2) ++beyond;
  }
  if (n == 0) return NotFound("no acceleration or no yaw rate", "1", 0, speed_mps.size(), std::move(used));
  return Found(static_cast<double>(beyond) / static_cast<double>(n), "1", n, speed_mps.size(), std::move(used));
}

}  // namespace rodeira::measures
