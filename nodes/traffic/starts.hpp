// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// Where no vehicle of traffic may be at first: the world's start, and the start of each vehicle node that names its own
// place. Their speeds are those at which the vehicles start, m/s. A start that cannot be read is left out: the vehicle
// node reports it.
std::vector<driver::Footprint> ClearAtStart(const launch::Launch& launch, const road::World& world);

}  // namespace rodeira::nodes
