// SPDX-License-Identifier: Apache-2.0
// Where a network's squares end its plane goes on: around them and in gaps between them, once everywhere.
#include "common/view/scene/terrain/far_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

std::shared_ptr<const road::World> WorldOn(const std::string& ground) {
  const auto world =
      road::World::Parse("rodeira: world/2\nname: t\nground: " + ground +
                             "\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n    axis: [line: "
                             "{length_m: 100}]\n    section: {lanes: [{id: -1, width_m: 3.5}]}\n",
                         "t.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world ? world.value() : nullptr;
}

// Seven squares of nine, in the plane z = 2 + 0.01 x - 0.02 y: how often a place is covered by them and by what goes
// on, and at what height.
TEST(FarPlane, CoversWhatTheSquaresLeaveOutOnce) {
  const auto world = WorldOn("{kind: plane, z_m: 2, slope_x: 0.01, slope_y: -0.02, surface: gravel}");
  ASSERT_NE(world, nullptr);
  const std::vector<TileKey> tiles = {{-1, 4}, {-1, 5}, {-1, 6}, {0, 4}, {0, 6}, {1, 4}, {1, 5}};
  const Mesh mesh = BuildFarPlane(*world, tiles);
  EXPECT_EQ(mesh.material, Material::kGravel);
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const Eigen::Vector3d a = mesh.PositionW(mesh.triangles[i]), b = mesh.PositionW(mesh.triangles[i + 1]),
                          c = mesh.PositionW(mesh.triangles[i + 2]);
    const double twice = (b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x();
    EXPECT_GT(twice, 0.0) << "seen from above";
    area_m2 += 0.5 * twice;
  }
  const double side_m = 2.0 * kFarPlane_m + 3.0 * kTile_m;
  EXPECT_NEAR(area_m2, side_m * side_m - 7.0 * kTile_m * kTile_m, 1.0);
  const auto covered = [&](const Eigen::Vector2d& p) {
    int times = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      bool inside = true;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d a = mesh.PositionW(mesh.triangles[i + k]).head<2>(),
                              b = mesh.PositionW(mesh.triangles[i + (k + 1) % 3]).head<2>();
        inside = inside && (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() >= 0.0;
      }
      times += inside ? 1 : 0;
    }
    return times;
  };
  for (std::int64_t column = -3; column <= 3; ++column) {
    for (std::int64_t row = 2; row <= 8; ++row) {
      const bool known = std::find(tiles.begin(), tiles.end(), TileKey{column, row}) != tiles.end();
      EXPECT_EQ(covered(TileKey{column, row}.south_west_W() + Eigen::Vector2d(100.0, 31.0)), known ? 0 : 1)
          << column << " " << row;
    }
  }
  ASSERT_FALSE(mesh.positions.empty());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3d p = mesh.PositionW(i);
    EXPECT_NEAR(p.z(), 2.0 + 0.01 * p.x() - 0.02 * p.y(), 0.002);
  }
}

TEST(FarPlane, IsNoneWhereTheWorldHasHills) {
  const auto hilly = road::World::Load(SourceDir() + "/configs/worlds/example/world.yaml");
  ASSERT_TRUE(hilly.ok()) << hilly.error().Text();
  EXPECT_TRUE(BuildFarPlane(*hilly.value(), std::vector<TileKey>{{0, 0}}).triangles.empty());
}

}  // namespace
}  // namespace rodeira::scene
