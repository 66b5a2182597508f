// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/visual_world/world_scene.hpp"

#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/road_furniture/trees.hpp"

namespace rodeira::scene {
namespace {

constexpr std::uint64_t kTreeSeed = 1;
constexpr double kPlanShare = 0.1;  // of a network's time: its lines, before there are tiles

void LayOnLand(const road::World& world, std::vector<TerrainTile>& tiles) {
  if (world.ground_picture() == nullptr) return;
  for (TerrainTile& tile : tiles) {
    for (Mesh& mesh : tile.levels) LayPicture(*world.ground_picture(), mesh);
  }
}

}  // namespace

std::vector<TerrainTile> BareLand(const road::World& world) {
  std::vector<TerrainTile> tiles = BuildTerrain(Lattice(world), {});
  LayOnLand(world, tiles);
  return tiles;
}

WorldScene BuildWorldScene(const road::World& world, const RoadTolerance& tolerance, const ModelIsThere& is_there,
                           const Progress& progress) {
  const auto tell = [&progress](double share) {
    if (progress) progress(share);
  };
  WorldScene scene;
  if (world.network() != nullptr && world.roads().empty()) {  // not a world file of version 1
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
  const Lattice lattice(world);
  std::vector<Ribbon> ribbons;
  for (const road::Road& road : world.roads()) ribbons.push_back(LayRibbon(road, tolerance));
  tell(0.1);
  scene.terrain = BuildTerrain(lattice, ribbons);
  tell(0.5);
  for (std::size_t i = 0; i < ribbons.size(); ++i) {
    for (RoadTile& tile : BuildRoad(world, world.roads()[i], ribbons[i], lattice))
      scene.roads.push_back(std::move(tile));
  }
  LayOnLand(world, scene.terrain);
  tell(0.9);
  if (const terrain::LaidPicture* picture = world.ground_picture()) {
    for (RoadTile& tile : scene.roads) {
      for (Mesh& mesh : tile.ground) {
        if (mesh.material == lattice.material())
          LayPicture(*picture, mesh);  // verges, and what passes into the terrain
      }
    }
  }
  scene.trees = BuildTrees(PlantTrees(world, kTreeSeed));
  tell(1.0);
  return scene;
}

}  // namespace rodeira::scene
