// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/network/road.hpp"

namespace rodeira::road {

// A road's <lanes> of OpenDRIVE: widths, heights, materials, limits, links, and its painted lines as the marks of the
// lane edges that they lie nearest to. A mark's offset from its edge is constant: that of the line's middle station.
std::string LanesText(const network::Road& road);

}  // namespace rodeira::road
