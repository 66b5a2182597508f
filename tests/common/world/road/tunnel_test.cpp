// SPDX-License-Identifier: Apache-2.0
// A tunnel's road, the hill over it, and the floor beside it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/world/road/built_ground.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

// Through a hill that stands 9 m over the road: in the tunnel the terrain goes on above it as if there were no road,
// and the hint chooses between the two; before and behind it the hill is cut.
TEST(Tunnel, TheTerrainGoesOnOverATunnel) {
  const auto world = MustParse(R"(rodeira: world/2
name: tunnel
terrain: {surface: soil, generate: {seed: 2, columns: 61, rows: 61, spacing_m: 5, west_m: -50, south_m: -150,
  below_m: -9, flat_m: 30, full_m: 90, relief: [{wavelength_m: 60, amplitude_m: 3}]}}
roads:
  - id: a
    start: {x_m: 0, y_m: 0, heading_deg: 3}
    axis: [line: {length_m: 200}]
    z_m: 0
    section: {template: rural}
    tunnels: [{from_s_m: 60, to_s_m: 140, name: through the hill}]
)");
  ASSERT_NE(world, nullptr);
  const network::Road& road = world->network()->roads()[0];
  const auto ground = world->MakeGround();
  int whole = 0, roofs = 0;
  for (double s = 60.3; s < 140.0; s += 0.7) {
    for (const double t : {-5.5, -2.0, 0.3, 4.0, 5.6}) {
      const Eigen::Vector3d p = road.Surface(s, t).p_W;
      const auto layers = ground->Layers(p.x(), p.y());
      ASSERT_EQ(layers.size(), 2u) << s << " " << t;
      // Over the first metres the cut before the mouth goes on upward, from the roof of the mouth on.
      const double from_mouth_m = std::min(s - 60.0, 140.0 - s);
      if (from_mouth_m > 14.0) {
        EXPECT_EQ(layers[0].z_m, world->TerrainAt(p.x(), p.y()).z_m);
        EXPECT_NEAR(layers[0].z_m, 9.0, 1e-9);
        ++whole;
      } else {
        EXPECT_GE(layers[0].z_m, p.z() + 5.0 - 1e-9);
        EXPECT_LE(layers[0].z_m, 9.0 + 1e-9);
        roofs += std::fabs(layers[0].z_m - p.z() - 5.0) < 1e-9;
      }
      EXPECT_EQ(layers[0].surface, ground::Surface::kSoil);
      EXPECT_NEAR(layers[1].z_m, p.z(), 1e-9);
      EXPECT_EQ(world->At(p.x(), p.y(), 0.0).z_m, layers[1].z_m);
      EXPECT_EQ(world->At(p.x(), p.y(), 9.0).z_m, layers[0].z_m);
    }
  }
  EXPECT_GT(whole, 300);
  EXPECT_GT(roofs, 50);
  double z = 0.0;
  for (double s = 20.0; s < 180.0; s += 0.1) {  // a wheel that comes and goes on
    const Eigen::Vector3d p = road.Surface(s, -1.75).p_W;
    z = world->At(p.x(), p.y(), z).z_m;
    EXPECT_NEAR(z, p.z(), 1e-9) << s;
  }
  for (const double s : {30.0, 55.0, 145.0, 170.0}) {
    const Eigen::Vector3d edge = road.Surface(s, 5.75).p_W;  // of the verge; behind it the cut rises by 1 in 1.5
    const Eigen::Vector2d beside = edge.head<2>() + 3.0 * road.axis().Evaluate(s).left_W();
    EXPECT_EQ(ground->Layers(edge.x(), edge.y()).size(), 1u) << s;
    EXPECT_NEAR(world->At(beside.x(), beside.y()).z_m, edge.z() + 3.0 / 1.5, 0.05) << s;
  }
}

// Under a plane 20 m over a tunnel that climbs, bends and goes over into another bend: with a hint of a car in it
// there is a floor for 5 m beside its road, which goes on level across from the road's edge and along with it; without
// one and with one on the hill the hill is as it is. Nothing is there before the mouths, nor farther away.
TEST(Tunnel, BesideATunnelsRoadItsFloorGoesOnUnderTheHill) {
  const auto text = [](const char* tunnels) {
    return fmt::format(
        "rodeira: world/2\nname: t\nground: {{kind: plane, z_m: 20, surface: grass}}\nroads:\n  - id: a\n    start: "
        "{{x_m: 0, y_m: 0, heading_deg: 20}}\n    axis: [line: {{length_m: 80}}, arc: {{radius_m: 60, turn_deg: 80}}, "
        "arc: {{radius_m: -90, turn_deg: 60}}]\n"
        "    vertical: [{{s_m: 0, z_m: 0}}, {{s_m: 250, z_m: 5}}]\n    section: {{template: rural}}\n{}",
        tunnels);
  };
  const auto world = MustParse(text("    tunnels: [{from_s_m: 60, to_s_m: 230}]\n"));
  ASSERT_NE(world, nullptr);
  const network::Road& road = world->network()->roads()[0];
  const auto ground = world->MakeGround();
  for (double s = 60.5; s < 230.0; s += 0.37) {
    const geometry::PlanPoint axis = road.axis().Evaluate(s);
    for (const double side : {1.0, -1.0}) {
      double right, left;
      road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
      const Eigen::Vector3d edge = road.Surface(s, side > 0.0 ? left : right).p_W;
      for (const double beside : {1e-9, 1e-4, 0.03, 0.5, 1.7, 3.0, 4.9}) {
        const Eigen::Vector2d p = edge.head<2>() + side * beside * axis.left_W();
        const double near_mouth = std::min(s - 60.0, 230.0 - s);
        const SurfacePoint at = world->At(p.x(), p.y(), edge.z());
        if (std::hypot(near_mouth, beside) < 0.75 + 1e-6 && at.surface == ground::Surface::kGrass)
          continue;  // the cut before the mouth begins lower than a step
        ASSERT_TRUE(at.inside);
        ASSERT_NEAR(at.z_m, edge.z(), 1e-9) << s << " " << side * beside;
        ASSERT_EQ(at.surface, ground::Surface::kConcrete);
        const Eigen::Vector2d slope(at.slope_x, at.slope_y);
        EXPECT_NEAR(slope.dot(axis.left_W()), 0.0, 1e-9) << "level across";
        EXPECT_NEAR(slope.dot(axis.tangent_W),
                    0.02 / (1.0 - side * axis.curvature_1pm * (std::fabs(side > 0.0 ? left : right) + beside)), 1e-6)
            << s;
        // Nothing else is changed: a query without a hint, or from the hill, is on the hill.
        const SurfacePoint top = world->At(p.x(), p.y());
        EXPECT_EQ(top.surface, ground::Surface::kGrass);
        EXPECT_EQ(world->At(p.x(), p.y(), top.z_m).z_m, top.z_m);
        EXPECT_TRUE(near_mouth <= 40.0 || top.z_m == 20.0);
        const auto layers = ground->Layers(p.x(), p.y());
        ASSERT_EQ(layers.size(), 2u);
        EXPECT_EQ(layers[1].z_m, at.z_m);
      }
      const Eigen::Vector2d far = edge.head<2>() + side * 5.1 * axis.left_W();
      EXPECT_GT(world->At(far.x(), far.y(), edge.z()).z_m, edge.z() + 0.5) << "the hill alone";
    }
  }
  for (const double s : {20.0, 59.9, 230.1, 240.0}) {
    const Eigen::Vector3d edge = road.Surface(s, 5.75).p_W;
    const Eigen::Vector2d p = edge.head<2>() + 2.0 * road.axis().Evaluate(s).left_W();
    EXPECT_EQ(ground->Layers(p.x(), p.y()).size(), 1u) << s;
  }
}

// Beside a tunnel under another road: where that one passes over the tunnel's side it is what is driven on, from
// whatever side it is asked; and where it runs abreast of the tunnel's road, on its level and under a bridge, no floor
// takes its place.
TEST(Tunnel, AFloorBesideATunnelTakesNoRoadsPlace) {
  const auto world = MustParse(
      "rodeira: world/2\nname: t\nground: {kind: plane, z_m: 20}\nroads:\n  - {id: low, axis: [line: {length_m: 200}], "
      "z_m: 0, section: {template: rural}, tunnels: [{from_s_m: 20, to_s_m: 180}]}\n"
      "  - {id: over, start: {x_m: 100, y_m: -60, heading_deg: 90}, axis: [line: {length_m: 120}], z_m: 20, section: "
      "{template: rural}}\n"
      "  - {id: abreast, start: {x_m: 30, y_m: 12, heading_deg: 0}, axis: [line: {length_m: 30}], z_m: -1, section: "
      "{template: rural}}\n"
      "  - {id: bridge, start: {x_m: 45, y_m: -60, heading_deg: 90}, axis: [line: {length_m: 120}], z_m: 20, section: "
      "{template: rural}, bridges: [{from_s_m: 50, to_s_m: 90}]}\n");
  ASSERT_NE(world, nullptr);
  const auto ground = world->MakeGround();
  const double low_edge = world->network()->roads()[0].Surface(100.0, 5.75).p_W.z();
  for (const double y : {5.76, 7.0, 10.0}) {
    EXPECT_NEAR(world->At(100.0, y).z_m, world->At(100.0, y, 20.0).z_m, 0.0);
    EXPECT_GT(world->At(100.0, y).z_m, 19.0);
    EXPECT_NEAR(world->At(100.0, y, 0.0).z_m, low_edge, 1e-9);
  }
  // Many points on the road over it, near the tunnel: together as one by one.
  for (const double hint : {0.0, 20.0, std::numeric_limits<double>::quiet_NaN()}) {
    const ground::GroundPatch patch{100.0, 8.0, 0.3, 0.2, 0.18, 11, 9, hint};
    std::vector<ground::GroundPoint> points(patch.size());
    ground->Patch(patch, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ground::GroundQuery query =
          ground::PatchPoint(patch, static_cast<int>(k) / patch.across, static_cast<int>(k) % patch.across);
      EXPECT_EQ(points[k].z_m, world->At(query.x_m, query.y_m, query.z_hint_m).z_m);
    }
  }
  const auto& abreast = world->network()->roads()[2];
  for (const double t : {-5.7, -3.0, 0.0, 2.0}) {
    const Eigen::Vector3d p = abreast.Surface(15.0, t).p_W;
    EXPECT_NEAR(world->At(p.x(), p.y(), 0.0).z_m, p.z(), 1e-9) << t;
    EXPECT_GT(world->At(p.x(), p.y()).z_m, 19.0) << "the bridge";
  }
}

}  // namespace
}  // namespace rodeira::road
