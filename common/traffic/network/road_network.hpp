// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/driving/driver/footprint.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::traffic {

// The roads of a world as a network, which keeps the world alive; an empty one where it has none.
std::shared_ptr<const network::Network> NetworkOf(const std::shared_ptr<const road::World>& world);
// A world that has nothing but these roads.
std::shared_ptr<const road::World> WorldOf(std::shared_ptr<const network::Network> network);

// Where the driver's car starts, which is known before anything is published: no traffic begins there, in a run nor
// without one.
driver::Footprint KeptClear(const road::World& world);

}  // namespace rodeira::traffic
