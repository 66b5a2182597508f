#pragma once

#include <memory>

#include "common/road/world.hpp"

namespace rodeira::traffic {

// The roads of a world as a network, which keeps the world alive; an empty one where it has none.
std::shared_ptr<const network::Network> NetworkOf(const std::shared_ptr<const road::World>& world);

}  // namespace rodeira::traffic
