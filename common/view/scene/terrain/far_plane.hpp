// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// So far from the squares' middle it goes on: as far as the view draws.
inline constexpr double kFarPlane_m = 16'000.0;

// A network's squares end some 600 m beside its roads; where the world's terrain is a plane, it goes on around and
// between them to where the eye can no longer tell. Only to be seen. No triangles where the world has another terrain,
// or a picture lies on it.
Mesh BuildFarPlane(const road::World& world, std::span<const TileKey> tiles);

}  // namespace rodeira::scene
