// SPDX-License-Identifier: Apache-2.0
// Land of worlds without roads: hills, and a plane.
#include "common/view/scene/terrain/terrain_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <tuple>

#include "common/core/base/hash.hpp"
#include "common/core/base/random.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"
#include "tests/common/view/scene/plan.hpp"

namespace rodeira::scene {
namespace {

std::shared_ptr<const road::World> Parsed(const char* text) {
  const auto world = road::World::Parse(text, "land.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

// 150 and 100 cells: the last tiles are smaller than the others.
std::shared_ptr<const road::World> Hills() {
  static const auto world = Parsed(
      "rodeira: world/1\nname: hills\nterrain:\n  generate: {seed: 3, columns: 151, rows: 101, spacing_m: 10, west_m: "
      "1000, south_m: -500, relief: [{wavelength_m: 300, amplitude_m: 20}]}\nstart: {x_m: 1500, y_m: 0}\n");
  return world;
}

std::shared_ptr<const road::World> Plane() {
  static const auto world =
      Parsed("rodeira: world/1\nname: plane\nground: {kind: plane, z_m: 1, slope_x: 0.01}\nstart: {x_m: 30, y_m: 0}\n");
  return world;
}

class TerrainMesh : public testing::TestWithParam<std::tuple<std::shared_ptr<const road::World> (*)(), std::size_t>> {};
INSTANTIATE_TEST_SUITE_P(WorldsAndLevels, TerrainMesh,
                         testing::Combine(testing::Values(Hills, Plane),
                                          testing::Values(std::size_t{0}, std::size_t{1}, std::size_t{2})));

// The whole rectangle: no hole, nothing twice.
TEST_P(TerrainMesh, FillsTheLattice) {
  const auto world = std::get<0>(GetParam())();
  const Lattice lattice(*world);
  Plan plan;
  for (const TerrainTile& tile : BuildTerrain(lattice)) plan.Add(tile.levels[std::get<1>(GetParam())]);
  EXPECT_EQ(plan.downward(), 0U);
  const double extent_m2 =
      (lattice.columns() - 1) * lattice.spacing_m().x() * (lattice.rows() - 1) * lattice.spacing_m().y();
  EXPECT_NEAR(plan.area_m2(), extent_m2, 1e-6 * extent_m2);  // float rounds the corners
}

TEST(TerrainMeshLevels, TheFinestIsSueloItself) {
  const auto world = Hills();
  Plan plan;
  for (const TerrainTile& tile : BuildTerrain(Lattice(*world))) plan.Add(tile.levels[0]);
  const road::Extents extents = world->extents();
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    const double x = base::RandomUniform({5, k}, extents.west_m + 1.0, extents.east_m - 1.0);
    const double y = base::RandomUniform({6, k}, extents.south_m + 1.0, extents.north_m - 1.0);
    const std::vector<double> heights = plan.HeightsOver(x, y);
    ASSERT_FALSE(heights.empty());
    for (const double z : heights) ASSERT_NEAR(z, world->At(x, y).z_m, 1e-3);
  }
}

// Any two levels of neighbouring tiles fit: on a tile's edge every level has the same vertices.
TEST(TerrainMeshLevels, ShareTheVerticesOnATilesEdge) {
  const auto world = Hills();
  const Lattice lattice(*world);
  const double side_m = 32.0 * lattice.spacing_m().x();
  const road::Extents extents = world->extents();
  std::size_t on_edges = 0, coarsest = 0, finest = 0;
  for (const TerrainTile& tile : BuildTerrain(lattice)) {
    std::array<std::set<std::tuple<float, float, float>>, kTerrainLevels> edges;
    for (std::size_t level = 0; level < kTerrainLevels; ++level) {
      const Mesh& mesh = tile.levels[level];
      std::vector<bool> used(mesh.positions.size());
      for (const std::uint32_t index : mesh.triangles) used[index] = true;
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3d p = mesh.PositionW(i);
        const auto off = [side_m](double x) { return std::fabs(x / side_m - std::round(x / side_m)) * side_m; };
        if (used[i] && std::min(off(p.x() - extents.west_m), off(p.y() - extents.south_m)) < 1e-3) {
          edges[level].insert({mesh.positions[i].x(), mesh.positions[i].y(), mesh.positions[i].z()});
        }
      }
      on_edges += edges[level].size();
    }
    EXPECT_EQ(edges[0], edges[1]);
    EXPECT_EQ(edges[0], edges[2]);
    EXPECT_LT(tile.levels[1].triangle_count(), tile.levels[0].triangle_count());
    EXPECT_LE(tile.levels[2].triangle_count(), tile.levels[1].triangle_count());
    coarsest += tile.levels[2].triangle_count();
    finest += tile.levels[0].triangle_count();
  }
  EXPECT_LT(coarsest, finest / 6);
  EXPECT_GT(on_edges, 4'000U);
}

TEST(WorldScene, IsAPureFunctionOfTheWorld) {
  const auto digest = [](const road::World& world) {
    base::Digest sum = 0;
    const auto add = [&sum](const Mesh& mesh) {
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.positions.data(), mesh.positions.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.normals.data(), mesh.normals.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.colours.data(), mesh.colours.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.triangles.data(), mesh.triangles.size()))));
    };
    for (const TerrainTile& tile : BuildWorldScene(world).terrain) {
      for (const Mesh& mesh : tile.levels) add(mesh);
    }
    return sum;
  };
  EXPECT_EQ(digest(*Hills()), digest(*Hills()));
  EXPECT_NE(digest(*Hills()), digest(*Plane()));
}

}  // namespace
}  // namespace rodeira::scene
