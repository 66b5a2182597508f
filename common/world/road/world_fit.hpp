// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/config.hpp"
#include "common/world/road/road.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::road {

// Adds a problem to the road's map where the road with its blend leaves the terrain, bends more sharply than it is
// wide, or comes so near to itself that two parts of it would shape the same ground. Each kind is told once, at the
// first place. `grid` may be null: a plane holds everything.
void CheckRoadFits(const Road& road, const terrain::ElevationGrid* grid, const config::Map& map);

}  // namespace rodeira::road
