// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "common/view/scene/terrain/terrain_mesh.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// Everything of a world that stands still.
struct WorldScene {
  std::vector<GroundTile> ground;    // of a network; or
  std::vector<TerrainTile> terrain;  // of a world without one
};

// The land of a world without roads, with the picture that lies on it: a plane as far as it is drawn.
std::vector<TerrainTile> BareLand(const road::World& world);

// How far something has come, from 0 to 1: never less than before, 1 at last.
using Progress = std::function<void(double share)>;

// A pure function of the world and of which models can be read: the same meshes, bit by bit. `progress` is told on this
// thread.
WorldScene BuildWorldScene(const road::World& world, const ModelIsThere& is_there = {}, const Progress& progress = {});

}  // namespace rodeira::scene
