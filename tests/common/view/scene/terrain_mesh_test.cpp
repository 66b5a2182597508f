// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/terrain_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "common/core/base/hash.hpp"
#include "common/core/base/random.hpp"
#include "common/view/scene/terrain/ribbon_cover.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"
#include "tests/common/view/scene/plan.hpp"
#include "tests/common/view/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

struct Level {
  Plan terrain, road;
  double extent_m2 = 0.0;
};

Level Look(const road::World& world, std::size_t level) {
  const Lattice lattice(world);
  std::vector<Ribbon> ribbons;
  for (const road::Road& road : world.roads()) ribbons.push_back(LayRibbon(road, {}));
  Level look;
  for (const TerrainTile& tile : BuildTerrain(lattice, ribbons)) look.terrain.Add(tile.levels[level]);
  for (std::size_t i = 0; i < ribbons.size(); ++i) {
    for (const RoadTile& tile : BuildRoad(world, world.roads()[i], ribbons[i], lattice)) {
      for (const Mesh& mesh : tile.ground) look.road.Add(mesh);
    }
  }
  look.extent_m2 = (lattice.columns() - 1) * lattice.spacing_m().x() * (lattice.rows() - 1) * lattice.spacing_m().y();
  return look;
}

class TerrainMesh : public testing::TestWithParam<std::tuple<std::shared_ptr<const road::World> (*)(), std::size_t>> {};
INSTANTIATE_TEST_SUITE_P(WorldsAndLevels, TerrainMesh,
                         testing::Combine(testing::Values(N222OfVersion1, PlaneWithRoad),
                                          testing::Values(std::size_t{0}, std::size_t{1}, std::size_t{2})));

// Together, terrain and road are the whole rectangle: no hole, nothing twice.
TEST_P(TerrainMesh, FillsExactlyWhatTheRoadLeaves) {
  const auto world = std::get<0>(GetParam())();
  const Level look = Look(*world, std::get<1>(GetParam()));
  EXPECT_EQ(look.terrain.downward(), 0U);
  // Slivers below a square millimetre are left out, and float rounds the corners.
  EXPECT_NEAR(look.terrain.area_m2() + look.road.area_m2(), look.extent_m2, 1.0);
}

TEST_P(TerrainMesh, NothingOfItLiesOverOrUnderTheCarriageway) {
  const auto world = std::get<0>(GetParam())();
  const road::Road& road = world->roads()[0];
  const Level look = Look(*world, std::get<1>(GetParam()));
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    const double s = base::RandomUniform({1, k}, 0.0, road.length_m());
    const double t = base::RandomUniform({2, k}, road.section().verge_right_m(), road.section().verge_left_m());
    const Eigen::Vector3d p = road.Position(s, t);
    ASSERT_TRUE(look.terrain.HeightsOver(p.x(), p.y()).empty()) << "s = " << s << ", t = " << t;
  }
}

// Across the edge between road and terrain the ground goes on: no step, no crack.
TEST_P(TerrainMesh, MeetsTheRoadsEdge) {
  const auto world = std::get<0>(GetParam())();
  const road::Road& road = world->roads()[0];
  const Level look = Look(*world, std::get<1>(GetParam()));
  int checked = 0;
  for (std::uint64_t k = 0; k < 4'000; ++k) {
    const double s = base::RandomUniform({3, k}, 1.0, road.length_m() - 1.0);
    const bool left = k % 2 == 0;
    const double edge = left ? road.section().blend_left_m() : road.section().blend_right_m();
    for (const double out : {-0.15, -0.05, 0.05, 0.15}) {
      const Eigen::Vector3d p = road.Position(s, edge + (left ? out : -out));
      std::vector<double> heights = look.terrain.HeightsOver(p.x(), p.y());
      for (const double z : look.road.HeightsOver(p.x(), p.y())) heights.push_back(z);
      ASSERT_GE(heights.size(), 1U) << "a hole at s = " << s;
      const double terrain_z = world->TerrainAt(p.x(), p.y()).z_m;
      for (const double z : heights)
        ASSERT_NEAR(z, terrain_z, 0.05) << "s = " << s << ", " << out << " m beyond the edge";
      ++checked;
    }
  }
  EXPECT_GT(checked, 1'000);
}

TEST(TerrainMeshLevels, TheFinestIsSueloItself) {
  const auto world = N222OfVersion1();
  const Level look = Look(*world, 0);
  const auto ground = world->MakeGround();
  const road::Extents extents = world->extents();
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    const double x = base::RandomUniform({5, k}, extents.west_m + 1.0, extents.east_m - 1.0);
    const double y = base::RandomUniform({6, k}, extents.south_m + 1.0, extents.north_m - 1.0);
    for (const double z : look.terrain.HeightsOver(x, y)) ASSERT_NEAR(z, ground->At(x, y).z_m, 1e-3);
  }
}

// Any two levels of neighbouring tiles fit: on a tile's edge every level has the same vertices.
TEST(TerrainMeshLevels, ShareTheVerticesOnATilesEdge) {
  const auto world = N222OfVersion1();
  const Lattice lattice(*world);
  const std::vector<Ribbon> ribbons = {LayRibbon(world->roads()[0], {})};
  const double side_m = 32.0 * lattice.spacing_m().x();
  const road::Extents extents = world->extents();
  std::size_t on_edges = 0, coarsest = 0, finest = 0;
  for (const TerrainTile& tile : BuildTerrain(lattice, ribbons)) {
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
  EXPECT_GT(on_edges, 50'000U);
}

TEST(WorldScene, IsAPureFunctionOfTheWorld) {
  const auto digest = [](const WorldScene& scene) {
    base::Digest sum = 0;
    const auto add = [&sum](const Mesh& mesh) {
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.positions.data(), mesh.positions.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.normals.data(), mesh.normals.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.colours.data(), mesh.colours.size()))));
      sum = base::Combine(sum, base::Hash(std::as_bytes(std::span(mesh.triangles.data(), mesh.triangles.size()))));
    };
    for (const TerrainTile& tile : scene.terrain) {
      for (const Mesh& mesh : tile.levels) add(mesh);
    }
    for (const RoadTile& tile : scene.roads) {
      for (const Mesh& mesh : tile.ground) add(mesh);
      add(tile.marks);
    }
    for (const auto& trees : scene.trees) {
      for (const Mesh& mesh : Merged(trees)) add(mesh);
    }
    return sum;
  };
  const auto world = PlaneWithRoad();
  EXPECT_EQ(digest(BuildWorldScene(*world)), digest(BuildWorldScene(*world)));
  EXPECT_EQ(digest(BuildWorldScene(*N222OfVersion1())), digest(BuildWorldScene(*N222OfVersion1())));
}

TEST(RibbonCover, CuttingKeepsTheArea) {
  for (std::uint64_t k = 0; k < 2'000; ++k) {
    const auto draw = [k](std::uint64_t what) { return base::RandomUniform({9, k, what}, 0.0, 10.0); };
    Polygon triangle = {{draw(0), draw(1)}, {draw(2), draw(3)}, {draw(4), draw(5)}};
    if (Area(triangle) < 0.0) std::swap(triangle[0], triangle[1]);
    // A rectangle, turned.
    const double angle = draw(6), x = draw(7), y = draw(8), a = 0.3 * draw(9) + 0.1, b = 0.3 * draw(10) + 0.1;
    const Eigen::Vector2d u(std::cos(angle), std::sin(angle)), v(-u.y(), u.x()), at(x, y);
    const std::array<Eigen::Vector2d, 4> hole = {at - a * u - b * v, at + a * u - b * v, at + a * u + b * v,
                                                 at - a * u + b * v};
    double outside = 0.0;
    const auto pieces = Subtract(triangle, hole);
    for (const Polygon& piece : pieces) outside += Area(piece);
    // By counting: the share of random points of the triangle that lie in the hole.
    int in = 0;
    constexpr int kPoints = 2'000;
    for (std::uint64_t i = 0; i < kPoints; ++i) {
      double p = base::RandomUniform({10, k, i, 0}), q = base::RandomUniform({10, k, i, 1});
      if (p + q > 1.0) p = 1.0 - p, q = 1.0 - q;
      const Eigen::Vector2d point =
          triangle[0] + p * (triangle[1] - triangle[0]) + q * (triangle[2] - triangle[0]) - at;
      in += std::fabs(point.dot(u)) < a && std::fabs(point.dot(v)) < b;
    }
    const double share = static_cast<double>(in) / kPoints;
    // Five standard deviations of the count, and a point for shares near nought.
    const double slack = 5.0 * std::sqrt(std::max(share * (1.0 - share), 1.0 / kPoints) / kPoints);
    EXPECT_NEAR(outside / Area(triangle), 1.0 - share, slack) << k;
  }
}

}  // namespace
}  // namespace rodeira::scene
