// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/start_place.hpp"

#include <fmt/format.h>

namespace rodeira::road {

std::string StartBesideRoads(const network::Network& network, double x_m, double y_m) {
  const auto place = network.Locate(x_m, y_m);
  if (!place || place->distance_m <= 0.0 || network.GroundAt({x_m, y_m}) != nullptr) return "";
  return fmt::format("the start ({:.1f}, {:.1f}) is {:.1f} m beside the nearest lane, of road '{}'", x_m, y_m,
                     place->distance_m, network.roads()[place->lane.road].id());
}

}  // namespace rodeira::road
