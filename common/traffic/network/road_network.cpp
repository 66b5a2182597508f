// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/road_network.hpp"

namespace rodeira::traffic {

std::shared_ptr<const network::Network> NetworkOf(const std::shared_ptr<const road::World>& world) {
  if (world->network() == nullptr) return std::make_shared<const network::Network>(network::NetworkSpec{});
  return {world, world->network()};
}

std::shared_ptr<const road::World> WorldOf(std::shared_ptr<const network::Network> network) {
  road::WorldSpec spec;
  spec.name = network->name();
  spec.network = std::move(network);
  return road::World::Make(std::move(spec));
}

driver::Footprint KeptClear(const road::World& world) {
  constexpr double kLength_m = 20.0, kWidth_m = 2.0;
  const road::StartPose& start = world.start();
  return {0, start.x_m, start.y_m, start.heading_rad, 0.0, kLength_m, kWidth_m};
}

}  // namespace rodeira::traffic
