// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/world_scene.hpp"

#include "common/view/scene/ground_materials/lay_picture.hpp"

namespace rodeira::scene {
namespace {

constexpr double kPlanShare = 0.1;  // of a network's time: its lines, before there are tiles

void LayOnLand(const road::World& world, std::vector<TerrainTile>& tiles) {
  if (world.ground_picture() == nullptr) return;
  for (TerrainTile& tile : tiles) {
    for (Mesh& mesh : tile.levels) LayPicture(*world.ground_picture(), mesh);
  }
}

}  // namespace

std::vector<TerrainTile> BareLand(const road::World& world) {
  std::vector<TerrainTile> tiles = BuildTerrain(Lattice(world));
  LayOnLand(world, tiles);
  return tiles;
}

WorldScene BuildWorldScene(const road::World& world, const ModelIsThere& is_there, const Progress& progress) {
  const auto tell = [&progress](double share) {
    if (progress) progress(share);
  };
  WorldScene scene;
  if (world.network() != nullptr) {
    const GroundPlan plan(world, 0, is_there);
    scene.ground.resize(plan.tiles().size());
    const double count = static_cast<double>(plan.tiles().size());
    const auto told = [&](std::size_t done) {
      tell(kPlanShare + (1.0 - kPlanShare) * static_cast<double>(done) / count);
    };
    tell(kPlanShare);
    if (!plan.tiles().empty())
      ForEachAtOnce(
          plan.tiles().size(), 0, [&](std::size_t i) { scene.ground[i] = plan.Build(plan.tiles()[i]); }, told);
    tell(1.0);
    return scene;
  }
  tell(0.1);
  scene.terrain = BuildTerrain(Lattice(world));
  tell(0.9);
  LayOnLand(world, scene.terrain);
  tell(1.0);
  return scene;
}

}  // namespace rodeira::scene
