// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/station_names.hpp"

#include <fmt/format.h>

#include "common/world/road/road_chains.hpp"

namespace rodeira::road {

StationNames::StationNames(const network::Network& network, bool own) : network_(network) {
  if (!own) return;
  for (const RoadChain& chain : ChainsOf(network)) {
    const std::string& id = network.roads()[chain.parts.front().road].id();
    for (const RoadChain::Part& part : chain.parts) of_[part.road] = {id.substr(0, id.find('/')), part.from_s_m};
  }
}

std::string StationNames::Road(std::uint32_t road) const {
  const auto name = of_.find(road);
  return fmt::format("road '{}'", name == of_.end() ? network_.roads()[road].id() : name->second.first);
}

double StationNames::StationOf(std::uint32_t road, double s_m) const {
  const auto name = of_.find(road);
  return name == of_.end() ? s_m : name->second.second + s_m;
}

std::string StationNames::At(std::uint32_t road, double s_m) const {
  return fmt::format("{} at s = {:.1f} m", Road(road), StationOf(road, s_m));
}

}  // namespace rodeira::road
