// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/tessellation/tile_plan.hpp"

namespace rodeira::scene {

// A triangle of the ground, for what lies on it.
struct GroundTriangle {
  std::array<Eigen::Vector3d, 3> p_W;
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();
};

// The ground of one tile at one level of detail.
struct WovenTile {
  std::vector<Mesh> meshes;               // the ground by material; then walls and undersides
  std::vector<GroundTriangle> triangles;  // the ground again, without walls
};

// The middle of a tile in plan, and a height near its ground that is a multiple of the patterns' length.
Eigen::Vector3d TileOrigin(const TileKey& key, double z_m);

// The plan's triangles at SUELO's heights. Where SUELO steps between two faces there is a wall, and where a level ends
// in the air (a bridge's side) an apron hangs from it; a deck over another level has an underside; its normals look
// down. Nothing where no ground is known.
WovenTile WeaveTile(const road::World& world, const TilePlan& plan);

}  // namespace rodeira::scene
