// SPDX-License-Identifier: Apache-2.0
// World files: what is taken is a world that answers finite heights, what is refused has a sentence.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/world/road/world.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto world = rodeira::road::World::Parse(std::string(reinterpret_cast<const char*>(data), size), "fuzz.yaml");
  if (!world) {
    if (world.error().message.empty()) std::abort();
    return 0;
  }
  for (const double x : {-140.0, 0.25, 37.5, 1e6}) {
    const auto at = world.value()->At(x, 6.5);
    if (at.inside && !std::isfinite(at.z_m)) std::abort();
  }
  return 0;
}
