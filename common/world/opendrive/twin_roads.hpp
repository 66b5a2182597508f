// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {

// Several roads with one id are errors. The first keeps the id. Each other one gets a new id, and so do the links that
// meet the road where it lies; it is left out where a link cannot tell it from the road before it, or where more
// than 200 roads have the id.
void CheckTwinRoads(const network::Network& network, std::span<const RoadLines> lines, Findings& findings);

}  // namespace rodeira::opendrive
