// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "common/world/network/network.hpp"

namespace rodeira::sumo {

// The traffic lights of the first two controllers that are green or amber together where their ways cross, which a run
// refuses; empty where there are none. `light_of`: the light of a controller, by its id.
std::set<std::string> ClashingLights(const network::Network& network,
                                     const std::map<std::string, std::string>& light_of);

}  // namespace rodeira::sumo
