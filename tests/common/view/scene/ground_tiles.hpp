// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "common/view/scene/visual_world/ground_tile.hpp"
#include "tests/setting.hpp"

namespace rodeira::scene {

inline std::vector<GroundTile> BuildAll(const road::World& world, unsigned threads = 0) {
  const GroundPlan plan(world, threads);
  std::vector<GroundTile> tiles(plan.tiles().size());
  ForEachAtOnce(tiles.size(), threads, [&](std::size_t i) { tiles[i] = plan.Build(plan.tiles()[i]); });
  return tiles;
}

// Whether it is no ground: a wall, or the underside of a deck.
inline bool IsWall(const Mesh& mesh, std::size_t triangle) {
  return mesh.normals[mesh.triangles[3 * triangle]].z() < 1e-6F;
}

inline std::array<Eigen::Vector3d, 3> CornersOf(const Mesh& mesh, std::size_t triangle) {
  return {mesh.PositionW(mesh.triangles[3 * triangle]), mesh.PositionW(mesh.triangles[3 * triangle + 1]),
          mesh.PositionW(mesh.triangles[3 * triangle + 2])};
}

// Real files with ground that is looked at as a whole, RODEIRA_GROUND_FILES (2) of them.
inline std::vector<std::string> RealGrounds() {
  std::vector<std::string> names{"esmini_curves_elevation", "esmini_fabriksgatan", "esmini_e6mini",
                                 "esmini_highway_exit",     "carla_Town04",        "esmini_multi_intersections",
                                 "esmini_tunnels",          "asamqc_positive_v18", "asamqc_lane_gap_issue119"};
  names.resize(std::min<std::size_t>(names.size(), Setting("RODEIRA_GROUND_FILES", 2)));
  return names;
}

}  // namespace rodeira::scene
