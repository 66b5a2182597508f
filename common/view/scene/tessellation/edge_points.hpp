// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "common/core/tessellation/grid_point.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Puts more points among those on a tile's edges, where the ground is not straight from each to the next. They follow
// from the edge's own points and SUELO alone, so that both tiles have the same. decks: by edge (west, south, east,
// north), whether one of its two tiles may have a bridge, below which ground is met too.
void RefineEdges(const road::World& world, const TileKey& tile, std::vector<tessellation::GridPoint>& edge,
                 const std::array<bool, 4>& decks);

}  // namespace rodeira::scene
