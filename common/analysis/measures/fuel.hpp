// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// What turns kilograms into litres.
struct FuelOptions {
  double density_kgpl = 0.745;  // of petrol, as gauges count it
};

// The fuel burnt from the first to the last valid sample, in litres. fuel_used_kg is what was burnt since the start; it
// must not fall: a fall (the engine of another trip) counts nothing.
Measure FuelUsed(Series fuel_used_kg, const FuelOptions& options);
// The same over the way, in litres for 100 km. Missing where the way is shorter than 1 m. speed_mps is as long as
// fuel_used_kg.
Measure FuelOverDistance(Series fuel_used_kg, Series speed_mps, double rate_hz, const FuelOptions& options);

}  // namespace rodeira::measures
