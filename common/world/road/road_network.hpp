// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>

#include "common/world/network/network.hpp"
#include "common/world/road/road.hpp"
#include "common/world/road/surface_point.hpp"

namespace rodeira::road {

// A road of version 1 as version 2 has it: the same surface from verge to verge, lanes with shoulders (type shoulder)
// and verges (type none) outside of them, materials, limits, the painted lines, and the blend into the terrain.
network::Road AsNetworkRoad(const Road& road, const FrictionTable& friction);

// The network of a world file of version 1, which has one road at most; null without a road.
std::shared_ptr<const network::Network> AsNetwork(std::string name, std::string geo_reference,
                                                  std::span<const Road> roads, const FrictionTable& friction);

}  // namespace rodeira::road
