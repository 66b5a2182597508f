// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "common/view/scene/visual_world/ground_tile.hpp"
#include "common/world/road/world.hpp"

// Shared by the tests of broken texts and the fuzzer's program.
namespace rodeira::property {

inline constexpr double kMaxRoad_m = 3000.0;  // longer ones take longer than a text may

inline bool IsDrawn(const scene::Mesh& mesh) {
  for (const auto& p : mesh.positions) {
    if (!p.allFinite()) return false;
  }
  for (const std::uint32_t index : mesh.triangles) {
    if (index >= mesh.positions.size()) return false;
  }
  return true;
}

// Lines, paint and things of all roads, and of the ground the tile in which the car starts and the network's first,
// coarsely. What is wrong with it; nothing where it is drawn, or is too long to be.
inline std::string DrawnWrongly(const road::World& world) {
  double length_m = 0.0;
  for (const network::Road& road : world.network()->roads()) length_m += road.length_m();
  if (length_m > kMaxRoad_m) return "";
  const scene::GroundPlan plan(world, 1);
  if (plan.tiles().empty()) return "a road, and no tile of ground";
  const scene::WorldStep start = scene::ToSteps({world.start().x_m, world.start().y_m});
  for (const scene::TileKey& key :
       {scene::TileKey{scene::TileOf(start.x), scene::TileOf(start.y)}, plan.tiles().front()}) {
    const scene::GroundLevel drawn = plan.BuildLevel(key, scene::kGroundLevels - 2);
    if (!IsDrawn(drawn.marks)) return "a mark that is not drawn";
    for (const auto* meshes : {&drawn.ground, &drawn.things}) {
      for (const scene::Mesh& mesh : *meshes) {
        if (!IsDrawn(mesh)) return "a mesh of places that are none";
      }
    }
  }
  return "";
}

}  // namespace rodeira::property
