// SPDX-License-Identifier: Apache-2.0
// Measured surfaces: what is taken answers finite heights.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "common/world/surface/crg_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = rodeira::surface::ParseCrg(std::as_bytes(std::span(data, size)), "fuzz.crg");
  if (!file) return 0;
  for (const double x : {0.0, 3.5, -7.25, 1e4, -1e300}) {
    const auto ground = file.value().surface->Ground(x, 0.3 * x);
    if (ground.inside && !std::isfinite(ground.z_m + ground.slope_x + ground.slope_y)) std::abort();
  }
  return 0;
}
