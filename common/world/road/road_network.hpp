// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/world/network/network.hpp"
#include "common/world/road/world_spec.hpp"

namespace rodeira::road {

// A road of constant cross-section as a road of a network: the same surface from verge to verge, lanes with shoulders
// (type shoulder) and verges (type none) outside of them, materials, limits, and the painted lines.
network::Road AsNetworkRoad(const Road& road, const FrictionTable& friction);

// All roads of a world file of version 1, in their order. There is at least one.
std::shared_ptr<const network::Network> AsNetwork(const WorldSpec& spec, const std::vector<Road>& roads);

}  // namespace rodeira::road
