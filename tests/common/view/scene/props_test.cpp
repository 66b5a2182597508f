// SPDX-License-Identifier: Apache-2.0
// What stands at no road is seen where its file says, on SUELO's ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "common/view/scene/visual_world/seen_digest.hpp"

namespace rodeira::scene {
namespace {

std::shared_ptr<const road::World> With(
    const std::string& objects,
    const std::string& ground = "ground: {kind: plane, z_m: 5, slope_x: 0.1, slope_y: -0.05}") {
  const auto world = road::World::Parse("rodeira: world/2\nname: w\n" + ground + "\nobjects:\n" + objects, "w.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

double Ground(double x, double y) { return 5.0 + 0.1 * x - 0.05 * y; }

TEST(StaticProps, StandOnTheGroundTheWayTheyAreTurned) {
  const auto world = With(
      "  - {type: house, x_m: 120, y_m: 80, heading_deg: 30, length_m: 14, width_m: 8, height_m: 6}\n  - {type: tree, "
      "along: [[0, 0], [300, 0]], every_m: 100, height_m: 9, radius_m: 2}\n"
      "  - {type: lamp, x_m: -20, y_m: -20, z_m: 0.5}\n");
  const StaticObjects things(*world);
  int trees = 0, houses = 0, lamps = 0;
  for (const auto& [key, tile] : things.tiles()) {
    for (const Thing& thing : tile.things) {
      const Eigen::Vector3d& foot = thing.stand.foot_W;
      EXPECT_NEAR(foot.z(), Ground(foot.x(), foot.y()), 1e-9);
      EXPECT_TRUE(foot.x() >= key.south_west_W().x() && foot.x() < key.south_west_W().x() + kTile_m) << "in its tile";
      trees += thing.kind == ThingKind::kTree, houses += thing.kind == ThingKind::kHouse,
          lamps += thing.kind == ThingKind::kLamp;
      if (thing.kind == ThingKind::kHouse) {
        EXPECT_EQ(foot.head<2>(), Eigen::Vector2d(120.0, 80.0));
        EXPECT_NEAR(thing.stand.x_W.x(), std::cos(geometry::kPi / 6.0), 1e-9);
        EXPECT_NEAR(thing.stand.x_W.y(), 0.5, 1e-9);
        EXPECT_TRUE(thing.length_m == 14.0 && thing.width_m == 8.0 && thing.height_m == 6.0);
      }
      if (thing.kind == ThingKind::kTree) {
        EXPECT_NEAR(std::remainder(foot.x(), 100.0), 0.0, 1e-9);
        EXPECT_EQ(thing.radius_m, 2.0);
      }
      if (thing.kind == ThingKind::kLamp) {
        EXPECT_EQ(thing.above_m, 0.5);
      }
    }
  }
  EXPECT_TRUE(trees == 4 && houses == 1 && lamps == 1) << trees << " " << houses << " " << lamps;
}

// A wall of 30 m and, round a corner, 20 m: pieces of 4 m at most, each of which begins where the one before ends, on
// the ground.
TEST(StaticProps, AWallFollowsTheGroundWithoutAGap) {
  const auto world = With("  - {type: wall, along: [[10, 10], [40, 10], [40, 30]], height_m: 1.5, width_m: 0.4}\n");
  const StaticObjects things(*world);
  std::vector<RailPiece> pieces;
  for (const auto& [key, tile] : things.tiles()) pieces.insert(pieces.end(), tile.rails.begin(), tile.rails.end());
  ASSERT_EQ(pieces.size(), 8u + 5u);
  double length_m = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const RailPiece& piece = pieces[i];
    EXPECT_TRUE(piece.wall && piece.height_m[0] == 1.5 && piece.height_m[1] == 1.5 && piece.width_m[0] == 0.4 &&
                piece.width_m[1] == 0.4);
    const double own_m = (piece.foot_W[1] - piece.foot_W[0]).head<2>().norm();
    EXPECT_LE(own_m, 4.0 + 1e-9);
    length_m += own_m;
    for (const Eigen::Vector3d& foot : piece.foot_W) EXPECT_NEAR(foot.z(), Ground(foot.x(), foot.y()), 1e-9);
    if (i == 0) continue;
    EXPECT_EQ(piece.foot_W[0], pieces[i - 1].foot_W[1]);
    EXPECT_EQ(piece.left_W[0], pieces[i - 1].left_W[1]);
  }
  EXPECT_NEAR(length_m, 50.0, 1e-9);
  // East, then north: at the corner its left is between north and west.
  EXPECT_NEAR((pieces[0].left_W[0] - Eigen::Vector2d(0.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((pieces[7].left_W[1] - Eigen::Vector2d(-std::sqrt(0.5), std::sqrt(0.5))).norm(), 0.0, 1e-12);
  EXPECT_NEAR((pieces[12].left_W[1] - Eigen::Vector2d(-1.0, 0.0)).norm(), 0.0, 1e-12);
}

// On a bare elevation grid too every tile of the ground is there, with what stands in it; and what is seen is another
// where a thing is moved or is another model.
TEST(StaticProps, AreSeenOnABareGrid) {
  const std::string hills =
      "terrain: {surface: grass, generate: {seed: 3, columns: 65, rows: 65, spacing_m: 8, west_m: 0, south_m: 0, "
      "relief: [{wavelength_m: 90, amplitude_m: 4}]}}";
  const auto world = With("  - {type: tree, x_m: 100, y_m: 120}\n", hills);
  const GroundPlan plan(*world, 1);
  std::size_t ground = 0, repeated = 0, meshes = 0;
  for (const TileKey& key : plan.tiles()) {
    const GroundTile tile = plan.Build(key);
    for (const Mesh& mesh : tile.levels[0].ground) ground += mesh.triangle_count();
    meshes += tile.levels[0].things.size(), repeated += tile.levels[0].repeated.size();
  }
  EXPECT_GE(ground, 2u * 64u * 64u);
  EXPECT_EQ(meshes + repeated > 0, true);
  const base::Digest seen = SeenDigest(*world);
  EXPECT_EQ(SeenDigest(*With("  - {type: tree, x_m: 100, y_m: 120}\n", hills)), seen);
  EXPECT_NE(SeenDigest(*With("  - {type: tree, x_m: 100, y_m: 121}\n", hills)), seen);
  EXPECT_NE(SeenDigest(*With("  - {type: bush, x_m: 100, y_m: 120}\n", hills)), seen);
}

// A plane has no edge: around what stands on it, and around the start, there is ground to be seen.
TEST(StaticProps, OnAPlaneTheGroundAroundThemIsSeen) {
  const auto world = With("  - {type: tree, x_m: 3000, y_m: 100}\n", "ground: {kind: plane}");
  const GroundPlan plan(*world, 1);
  const auto shows = [&](double x, double y) {
    const WorldStep at = ToSteps({x, y});
    return std::find(plan.tiles().begin(), plan.tiles().end(), TileKey{TileOf(at.x), TileOf(at.y)}) !=
           plan.tiles().end();
  };
  for (const double angle : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    EXPECT_TRUE(shows(400.0 * std::cos(angle), 400.0 * std::sin(angle))) << angle;
    EXPECT_TRUE(shows(3000.0 + 400.0 * std::cos(angle), 100.0 + 400.0 * std::sin(angle))) << angle;
  }
}

}  // namespace
}  // namespace rodeira::scene
