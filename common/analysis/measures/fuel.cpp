// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/fuel.hpp"

#include <cmath>
#include <cstdlib>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {

Measure FuelUsed(Series fuel_used_kg, const FuelOptions& options) {
  const UsedOptions used = Used({{"density_kgpl", options.density_kgpl}});
  double burnt_kg = 0.0, last_kg = kMissing;
  std::size_t n = 0;
  for (const double now_kg : fuel_used_kg) {
    if (std::isnan(now_kg)) continue;
    if (now_kg > last_kg) burnt_kg += now_kg - last_kg;
    last_kg = now_kg;
    ++n;
  }
  if (n < 2) return NotFound("the fuel is known of no two samples", "l", n, fuel_used_kg.size(), used);
  return Found(burnt_kg / options.density_kgpl, "l", n, fuel_used_kg.size(), used);
}

Measure FuelOverDistance(Series fuel_used_kg, Series speed_mps, double rate_hz, const FuelOptions& options) {
  RODEIRA_ASSERT(fuel_used_kg.size() == speed_mps.size());
  constexpr double kMetres = 100'000.0, kShortest_m = 1.0;
  Measure fuel = FuelUsed(fuel_used_kg, options);
  fuel.unit = "l/100km";
  if (!fuel.value) return fuel;
  double way_m = 0.0;
  for (const SampleRun& run : ValidRuns(speed_mps)) {
    for (std::size_t i = run.from + 1; i < run.to; ++i)
      way_m += 0.5 * (std::abs(speed_mps[i - 1]) + std::abs(speed_mps[i])) / rate_hz;
  }
  if (way_m < kShortest_m)
    return NotFound("the way is shorter than 1 m", "l/100km", fuel.n, fuel_used_kg.size(), fuel.options);
  *fuel.value *= kMetres / way_m;
  return fuel;
}

}  // namespace rodeira::measures
