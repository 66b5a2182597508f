// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/view/scene/terrain/ribbon.hpp"
#include "tests/common/view/scene/plan.hpp"
#include "tests/common/view/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

constexpr double kOnSuelo_m = 1e-3;  // what float leaves of a metre-sized tile is far less

struct Built {
  Ribbon ribbon;
  std::vector<RoadTile> tiles;
};

Built Build(const road::World& world) {
  const Lattice lattice(world);
  Built built;
  built.ribbon = LayRibbon(world.roads()[0], {});
  built.tiles = BuildRoad(world, world.roads()[0], built.ribbon, lattice);
  return built;
}

class RoadMesh : public testing::TestWithParam<std::shared_ptr<const road::World> (*)()> {};
INSTANTIATE_TEST_SUITE_P(Worlds, RoadMesh, testing::Values(N222OfVersion1, PlaneWithRoad));

TEST_P(RoadMesh, EveryVertexLiesOnSuelo) {
  const auto world = GetParam()();
  const auto ground = world->MakeGround();
  std::size_t vertices = 0;
  double worst = 0.0;
  const auto look = [&](const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i, ++vertices) {
      const Eigen::Vector3d p = mesh.PositionW(i);
      const ground::GroundPoint at = ground->At(p.x(), p.y());
      ASSERT_TRUE(at.inside);
      worst = std::max(worst, std::fabs(p.z() - at.z_m));
    }
  };
  for (const RoadTile& tile : Build(*world).tiles) {
    for (const Mesh& mesh : tile.ground) look(mesh);
    look(tile.marks);
  }
  EXPECT_GT(vertices, 1000U);
  EXPECT_LT(worst, kOnSuelo_m);
}

TEST_P(RoadMesh, LooksUpwardWithTheGroundsNormals) {
  const auto world = GetParam()();
  const auto ground = world->MakeGround();
  for (const RoadTile& tile : Build(*world).tiles) {
    Plan plan;
    for (const Mesh& mesh : tile.ground) plan.Add(mesh);
    plan.Add(tile.marks);
    EXPECT_EQ(plan.downward(), 0U);
    for (const Mesh& mesh : tile.ground) {
      for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        ASSERT_NEAR(mesh.normals[i].norm(), 1.0F, 1e-5F);
        ASSERT_GT(mesh.normals[i].z(), 0.3F);
      }
    }
    for (std::size_t i = 0; i < tile.marks.normals.size(); ++i) {  // on the carriageway they are SUELO's own
      const Eigen::Vector3d p = tile.marks.PositionW(i);
      const road::World& w = *world;
      const auto at = w.roads()[0].Locate(p.x(), p.y());
      if (!at || std::fabs(at->t_m) < 1e-3) continue;  // on the crown there are two
      ASSERT_LT((tile.marks.normals[i].cast<double>() - ground->At(p.x(), p.y()).normal_W).norm(), 0.03);
    }
  }
}

// Anywhere on the paved road the picture is where the tyre is.
TEST_P(RoadMesh, BetweenTheVerticesTheRoadIsMetWithinTheTolerance) {
  const auto world = GetParam()();
  const road::Road& road = world->roads()[0];
  const Built built = Build(*world);
  Plan ground, marks;
  for (const RoadTile& tile : built.tiles) {
    for (const Mesh& mesh : tile.ground) ground.Add(mesh);
    marks.Add(tile.marks);
  }
  int painted = 0;
  for (std::uint64_t k = 0; k < 20'000; ++k) {
    const double s = base::RandomUniform({1, k}, 0.0, road.length_m());
    const double t = base::RandomUniform({2, k}, road.section().paved_right_m(), road.section().paved_left_m());
    const Eigen::Vector3d p = road.Position(s, t);
    const auto heights = ground.HeightsOver(p.x(), p.y());
    ASSERT_GE(heights.size(), 1U) << "a hole at s = " << s << ", t = " << t;
    for (const double z : heights) ASSERT_NEAR(z, p.z(), 0.012) << "s = " << s << ", t = " << t;
    for (const double z : marks.HeightsOver(p.x(), p.y())) {
      ASSERT_NEAR(z, heights.front(), 0.006) << "a mark stands off the road at s = " << s;
      ++painted;
    }
  }
  EXPECT_GT(painted, 100);
}

TEST_P(RoadMesh, PaintsWhatSueloCallsPaint) {
  const auto world = GetParam()();
  const road::Road& road = world->roads()[0];
  Plan marks;
  for (const RoadTile& tile : Build(*world).tiles) marks.Add(tile.marks);
  int differ = 0, painted = 0;
  for (std::uint64_t k = 0; k < 40'000; ++k) {
    const double s = base::RandomUniform({3, k}, 0.0, road.length_m());
    const road::Mark& mark = road.marks()[static_cast<std::size_t>(
        base::RandomUniform({4, k}, 0.0, static_cast<double>(road.marks().size())))];
    const double t = mark.t_m + base::RandomUniform({5, k}, -1.0, 1.0) * mark.width_m;
    const Eigen::Vector3d p = road.Position(s, t);
    const bool on_picture = !marks.HeightsOver(p.x(), p.y()).empty();
    const bool on_suelo = world->At(p.x(), p.y()).surface == ground::Surface::kRoadMark;
    painted += on_suelo;
    differ += on_picture != on_suelo;
  }
  EXPECT_GT(painted, 5'000);
  // A chord leaves its arc by up to a centimetre: that part of a mark's edge is another's.
  EXPECT_LT(differ, 40'000 / 20);
}

// Dashes are as long on the mesh as the world file says, on straights and in bends.
TEST(RoadMarks, DashesHaveTheirLength) {
  const auto world = PlaneWithRoad();
  const Built built = Build(*world);
  const road::Road& road = world->roads()[0];
  const road::Mark& dashed = road.marks()[0];
  ASSERT_TRUE(dashed.dashed());
  double yellow_m2 = 0.0;
  for (const RoadTile& tile : built.tiles) {
    for (std::size_t t = 0; t < tile.marks.triangle_count(); ++t) {
      if (!(tile.marks.colours[tile.marks.triangles[3 * t]] == Colour::Of(0xe5b52e))) continue;
      const Eigen::Vector3d a = tile.marks.PositionW(tile.marks.triangles[3 * t]);
      yellow_m2 += 0.5 * (tile.marks.PositionW(tile.marks.triangles[3 * t + 1]) - a)
                             .cross(tile.marks.PositionW(tile.marks.triangles[3 * t + 2]) - a)
                             .norm();
    }
  }
  // 120 m hold 15 whole dashes of 3 m on gaps of 5 m; the paint is 0.12 m wide.
  EXPECT_NEAR(yellow_m2, 15.0 * 3.0 * 0.12, 0.01);
}

TEST(RoadMesh, FarFromTheOriginItIsAsExact) {
  std::string text = R"(rodeira: world/1
name: far
ground: {kind: plane, z_m: 0, slope_x: 0, slope_y: 0, friction: 1.0}
start: {road: r, lane: -1, s_m: 5}
roads:
  - id: r
    start: {x_m: 4754321.125, y_m: -8566300.0625, heading_deg: 10}
    axis: [{line: {length_m: 20}}, {arc: {length_m: 60, radius_m: 60}}]
    vertical: [{s_m: 0, z_m: 0.5}]
    section:
      lanes: [{id: -1, width_m: 3, speed_limit_kmh: 50}]
      surface: asphalt
      crossfall: {kind: crown, fall: 0.02}
      verge: {width_m: 1, fall: 0.05, surface: grass}
      blend_m: 4
    marks: [{t_m: -0.1, width_m: 0.1, kind: continuous}]
)";
  const auto world = road::World::Parse(text, "far.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const Built built = Build(*world.value());
  for (const RoadTile& tile : built.tiles) {
    for (std::size_t i = 0; i + 1 < tile.marks.positions.size(); i += 2) {
      // Both edges of the paint: 0.1 m apart within a hundredth of a millimetre, which float at 8566 km could not say.
      EXPECT_NEAR((tile.marks.positions[i] - tile.marks.positions[i + 1]).norm(), 0.1F, 1e-4F);
    }
  }
}

}  // namespace
}  // namespace rodeira::scene
