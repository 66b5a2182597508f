#include "common/traffic/road_network.hpp"

namespace rodeira::traffic {

std::shared_ptr<const network::Network> NetworkOf(const std::shared_ptr<const road::World>& world) {
  if (world->network() == nullptr) return std::make_shared<const network::Network>(network::NetworkSpec{});
  return {world, world->network()};
}

}  // namespace rodeira::traffic
