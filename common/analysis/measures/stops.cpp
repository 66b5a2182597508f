// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/stops.hpp"

#include <cmath>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoSpeed = "no sample of the speed";

UsedOptions StopUsed(const StopOptions& options) {
  return Used({{"standing_mps", options.standing_mps}, {"moving_mps", options.moving_mps}});
}

}  // namespace

std::vector<Stop> Stops(Series speed_mps, const StopOptions& options) {
  std::vector<Stop> stops;
  bool stands = false;
  for (std::size_t i = 0; i < speed_mps.size(); ++i) {
    const double speed = std::abs(speed_mps[i]);
    stands = !std::isnan(speed) && (stands ? speed <= options.moving_mps : speed < options.standing_mps);
    if (!stands) continue;
    if (stops.empty() || stops.back().to != i) stops.push_back({i, i});
    stops.back().to = i + 1;
  }
  return stops;
}

Measure StopCount(Series speed_mps, const StopOptions& options) {
  const std::size_t n = CountValid(speed_mps);
  if (n == 0) return NotFound(kNoSpeed, "1", 0, speed_mps.size(), StopUsed(options));
  return Found(static_cast<double>(Stops(speed_mps, options).size()), "1", n, speed_mps.size(), StopUsed(options));
}

Measure StopTime(Series speed_mps, double rate_hz, const StopOptions& options) {
  const std::size_t n = CountValid(speed_mps);
  if (n == 0) return NotFound(kNoSpeed, "s", 0, speed_mps.size(), StopUsed(options));
  std::size_t samples = 0;
  for (const Stop& stop : Stops(speed_mps, options)) samples += stop.to - stop.from;
  return Found(static_cast<double>(samples) / rate_hz, "s", n, speed_mps.size(), StopUsed(options));
}

Measure StopDistance(Series speed_mps, Series ahead_m, const StopOptions& options) {
  RODEIRA_ASSERT(speed_mps.size() == ahead_m.size());
  const std::size_t n = CountValid(speed_mps);
  const auto stops = Stops(speed_mps, options);
  if (stops.empty()) return NotFound("the vehicle does not stop", "m", n, speed_mps.size(), StopUsed(options));
  const double ahead = ahead_m[stops.front().from];
  if (std::isnan(ahead)) return NotFound("no line ahead", "m", n, speed_mps.size(), StopUsed(options));
  return Found(ahead, "m", n, speed_mps.size(), StopUsed(options));
}

}  // namespace rodeira::measures
