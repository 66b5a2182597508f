// SPDX-License-Identifier: Apache-2.0
// The keys of the file beside a map, each in generated files.
#include "common/world/traffic_map/companion_schema.hpp"

#include <gtest/gtest.h>

#include "common/world/traffic_map/heights.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::traffic_map {
namespace {

// A message about a curve or a lane has its number, not the name of the mapping.
TEST(CompanionKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto heights = ParseHeights(text, "x.motors.yaml");
    if (heights) return "";
    for (const auto& [mapping, number] : {std::pair("heights_m", "3"), std::pair("flows_vehph", "1")}) {
      if (text.find(mapping) == std::string::npos) continue;
      EXPECT_TRUE(heights.error().Text().find(number) != std::string::npos) << heights.error().Text();
      return mapping;
    }
    return heights.error().Text();
  };
  config::ExpectEveryKey(CompanionSchema(), problem,
                         {{"signs[].kind=speed_limit", {{"signs[].limit_kmh", "50"}}},
                          {"signs[].limit_kmh", {{"signs[].kind", "speed_limit"}}},
                          {"lights[].red_amber_s", {{"lights[].amber_s", "10"}}}});
}

}  // namespace
}  // namespace rodeira::traffic_map
