// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/terrain/lattice.hpp"

namespace rodeira::scene {

inline constexpr int kTerrainLevels = 3;

// A square of terrain at several levels of detail, the finest first. On the square's edge all levels have the same
// vertices, so that any two of them fit together without a crack.
struct TerrainTile {
  int column = 0, row = 0;  // which square, counted from the south-west
  std::array<Mesh, kTerrainLevels> levels;
  Eigen::Vector3d centre_W = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

// Up to this distance from the tile's centre a level is shown.
float TerrainSeen_m(const TerrainTile& tile, std::size_t level);

// The lattice's triangles.
std::vector<TerrainTile> BuildTerrain(const Lattice& lattice);

}  // namespace rodeira::scene
