// SPDX-License-Identifier: Apache-2.0
#include "nodes/traffic/starts.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

#include "common/core/base/constants.hpp"
#include "common/traffic/network/road_network.hpp"

namespace rodeira::nodes {
namespace {

std::optional<double> StartNumber(const launch::LaunchNode& vehicle, const char* key) {
  const auto text = vehicle.config->Peek({"config", "start", key});
  double value = 0.0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{}) return std::nullopt;
  return value;
}

}  // namespace

std::vector<driver::Footprint> ClearAtStart(const launch::Launch& launch, const road::World& world) {
  const driver::Footprint at_world = traffic::KeptClear(world);
  std::vector<driver::Footprint> clear{at_world};
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "vehicle") continue;
    const auto x_m = StartNumber(node, "x_m"), y_m = StartNumber(node, "y_m");
    if (!x_m || !y_m) continue;
    driver::Footprint own = at_world;
    own.id = static_cast<std::uint32_t>(clear.size());
    own.x_m = *x_m, own.y_m = *y_m;
    own.heading_rad = StartNumber(node, "heading_deg").value_or(0.0) * base::kPi / 180.0;
    own.speed_mps = StartNumber(node, "speed_mps").value_or(0.0);
    clear.push_back(own);
  }
  return clear;
}

}  // namespace rodeira::nodes
