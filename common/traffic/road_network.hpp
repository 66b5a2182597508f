#pragma once

#include <memory>

#include "common/road/world.hpp"

namespace rodeira::traffic {

// The roads of a world as a network, which keeps the world alive; an empty one where it has none.
std::shared_ptr<const network::Network> NetworkOf(const std::shared_ptr<const road::World>& world);
// A world that has nothing but these roads.
std::shared_ptr<const road::World> WorldOf(std::shared_ptr<const network::Network> network);

}  // namespace rodeira::traffic
