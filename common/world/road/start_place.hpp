// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// A warning where a start lies beside all lanes and outside of junctions: "the start (12.0, 8.0) is 6.3 m beside the
// nearest lane, of road 'main'". Empty on a lane, a verge included, and where there is no road.
std::string StartBesideRoads(const network::Network& network, double x_m, double y_m);

}  // namespace rodeira::road
