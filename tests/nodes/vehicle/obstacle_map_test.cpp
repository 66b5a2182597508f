// SPDX-License-Identifier: Apache-2.0
// What of a world stops a car, against where its file says that it stands; and that a query near something is told of
// it.
#include "nodes/vehicle/obstacle_map.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kReach_m = 3.0;

ObstacleMap MapOf(const std::string& file) {
  const auto world = road::World::Load(SourceDir() + "/" + file);
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().Text());
  return ObstacleMap(*world.value(), kReach_m);
}

TEST(ObstacleMap, HousesTreesAndRailsStandWhereTheirFileSays) {
  const ObstacleMap map = MapOf("tests/data/wall_ahead.yaml");
  double rail_m = 0.0;
  int houses = 0, trees = 0;
  for (std::size_t i = 0; i < map.all().size(); ++i) {
    const dynamics::Obstacle& box = map.all()[i];
    EXPECT_EQ(box.id, i);
    EXPECT_LT(box.centre_W.z() - box.half_m.z(), -0.9) << "founded";
    EXPECT_GT(box.centre_W.z() + box.half_m.z(), 1.5) << "2 m over the ground, which falls beside the road";
    const std::string& name = map.NameOf(i);
    if (name == "main-object0") {
      ++houses;
      EXPECT_NEAR(box.centre_W.x(), 300.0, 1e-9);
      EXPECT_NEAR(box.centre_W.y(), -1.75, 1e-9);
      EXPECT_EQ(box.half_m.x(), 6.0);
      EXPECT_NEAR(box.centre_W.z() + box.half_m.z(), 5.0, 1e-9);
    } else if (name == "main-object1") {
      rail_m += 2.0 * box.half_m.x();
      EXPECT_NEAR(box.half_m.y(), 0.15, 1e-12);
      EXPECT_LT(box.centre_W.y(), -3.5);
      EXPECT_GT(box.centre_W.y(), -5.5);
    } else {
      ++trees;
      EXPECT_EQ(name, "main-object2") << "bushes and delineators are driven over";
      EXPECT_NEAR(box.centre_W.y(), -10.0, 1e-9);
      EXPECT_LT(box.half_m.x(), 0.3) << "the trunk, not the crown";
    }
  }
  EXPECT_EQ(houses, 1);
  EXPECT_EQ(trees, 1);
  EXPECT_NEAR(rail_m, 500.0, 1e-6);
}

// In bends and on hills too: a car in reach of a box has it among those near.
TEST(ObstacleMap, WhatIsInReachIsNear) {
  for (const char* file : {"tests/data/wall_ahead.yaml", "configs/worlds/haste.yaml", "configs/worlds/motorway.yaml"}) {
    const ObstacleMap map = MapOf(file);
    ASSERT_FALSE(map.all().empty()) << file;
    for (std::size_t i = 0; i < map.all().size(); ++i) {
      const dynamics::Obstacle& box = map.all()[i];
      for (int k = 0; k < 8; ++k) {
        const double around = 0.999 * (box.half_m.head<2>().norm() + kReach_m), angle = 0.785 * k;
        const auto near = map.Near(box.centre_W + around * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
        ASSERT_TRUE(std::ranges::binary_search(near, static_cast<std::uint32_t>(i))) << file << " " << i;
      }
    }
  }
}

// On a plane that climbs by a tenth to the east, without any road: a house turned by 90 degrees, a tree, a wall of
// 12 m and a bush, which gives way.
TEST(ObstacleMap, WhatStandsAtNoRoadStopsACarToo) {
  const auto world = road::World::Parse(
      "rodeira: world/2\nname: w\nground: {kind: plane, z_m: 3, slope_x: 0.1}\nobjects:\n  - {type: house, x_m: 50, "
      "y_m: 20, heading_deg: 90, length_m: 10, width_m: 6, height_m: 5}\n"
      "  - {type: tree, x_m: -30, y_m: 0}\n  - {type: wall, along: [[0, -8], [0, 4]], width_m: 0.4}\n  - {type: bush, "
      "x_m: 5, y_m: 5}\n",
      "w.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const ObstacleMap map(*world.value(), kReach_m);
  ASSERT_EQ(map.all().size(), 4u);  // the wall is two pieces
  const dynamics::Obstacle& building = map.all()[0];
  EXPECT_EQ(map.NameOf(0), "object0");
  EXPECT_NEAR((building.centre_W.head<2>() - Eigen::Vector2d(50.0, 20.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(building.centre_W.z() - building.half_m.z(), 8.0 - 1.0, 1e-9);
  EXPECT_NEAR(building.centre_W.z() + building.half_m.z(), 8.0 + 5.0, 1e-9);
  EXPECT_NEAR((building.q_WO * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
  EXPECT_TRUE(building.half_m.x() == 5.0 && building.half_m.y() == 3.0);
  EXPECT_NEAR(map.all()[1].centre_W.z() - map.all()[1].half_m.z(), 3.0 - 3.0 - 1.0, 1e-9);
  double wall_m = 0.0;
  for (std::size_t i = 2; i < 4; ++i) {
    const dynamics::Obstacle& wall = map.all()[i];
    EXPECT_NEAR(wall.centre_W.x(), 0.0, 1e-9);
    EXPECT_NEAR(wall.half_m.y(), 0.2, 1e-12);
    wall_m += 2.0 * wall.half_m.x();
  }
  EXPECT_NEAR(wall_m, 12.0, 1e-9);
  EXPECT_FALSE(map.Near({0.0, 6.0, 3.0}).empty());
  EXPECT_TRUE(map.Near({500.0, 500.0, 3.0}).empty());
}

// A crossing and a parking place with the heights that ASAM's own examples give their outlines, a mast with an arm over
// the road, a hedge that leaves the road's line: only the last two are in the way, and the arm is passed under.
TEST(ObstacleMap, WhatLiesOnTheRoadIsNoBodyAndASkeletonIsItsBars) {
  const std::string corners =
      R"(<outlines><outline id="0"><cornerRoad s="18" t="3.5" dz="0" height="4" id="0"/>
          <cornerRoad s="18" t="-3.5" dz="0" height="4" id="1"/><cornerRoad s="22" t="-3.5" dz="0" height="4" id="2"/>
          </outline></outlines>)";
  const std::string text =
      "<?xml version=\"1.0\"?>\n<OpenDRIVE><header revMajor=\"1\" revMinor=\"8\"/><road id=\"1\" length=\"100\" "
      "junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"100\"><arc "
      "curvature=\"0.01\"/></geometry></planView>"
      "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width "
      "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes>"
      "<objects><object id=\"z\" type=\"crosswalk\" s=\"20\" t=\"0\" height=\"4\">" +
      corners +
      "</object><object id=\"p\" type=\"parkingSpace\" s=\"30\" t=\"0\" length=\"5\" width=\"2.5\" height=\"4\"/>"
      R"(<object id="m" type="pole" s="0" t="-5" height="6" length="0.3" width="5"><skeleton><polyline id="1">
          <vertexRoad s="0" t="-5" dz="0" radius="0.2"/><vertexRoad s="0" t="-5" dz="6" radius="0.1"/></polyline>
      <polyline id="2"><vertexLocal u="0" v="0" z="5" radius="0.1"/><vertexLocal u="0" v="4" z="5.5" radius="0.1"/>
        </polyline></skeleton></object>
      <object id="w" type="barrier" s="40" t="-6" height="1" width="0.3">
        <repeat s="40" length="40" distance="0" tStart="-6" tEnd="-6" detachFromReferenceLine="true"/></object>
        </objects></road></OpenDRIVE>)";
  const auto file =
      std::filesystem::temp_directory_path() / ("rodeira-obstacles-" + std::to_string(::getpid()) + ".xodr");
  ASSERT_TRUE(base::WriteWhole(file, std::string_view(text)).ok());
  const auto world = road::World::Load(file);
  std::filesystem::remove(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const ObstacleMap map(*world.value(), kReach_m);
  double wall_m = 0.0;
  std::size_t bars = 0;
  const Eigen::Vector2d begin(106.0 * std::sin(0.4), 100.0 - 106.0 * std::cos(0.4)),
      end(106.0 * std::sin(0.8), 100.0 - 106.0 * std::cos(0.8)), way = (end - begin).normalized();
  for (std::size_t i = 0; i < map.all().size(); ++i) {
    const dynamics::Obstacle& box = map.all()[i];
    if (map.NameOf(i) == "w") {
      wall_m += 2.0 * box.half_m.x();
      EXPECT_NEAR((box.centre_W.head<2>() - begin).dot(Eigen::Vector2d(-way.y(), way.x())), 0.0, 1e-9);
      continue;
    }
    ASSERT_EQ(map.NameOf(i), "m");
    if (bars++ == 0) {
      EXPECT_NEAR((box.centre_W.head<2>() - Eigen::Vector2d(0.0, -5.0)).norm(), 0.0, 1e-9);
      EXPECT_NEAR(box.half_m.x(), 0.2, 1e-12);
      EXPECT_NEAR(box.centre_W.z() - box.half_m.z(), -1.0, 1e-9);
      EXPECT_NEAR(box.centre_W.z() + box.half_m.z(), 6.0, 1e-9);
    } else {
      EXPECT_NEAR((box.centre_W.head<2>() - Eigen::Vector2d(0.0, -3.0)).norm(), 0.0, 1e-9);
      EXPECT_NEAR(box.half_m.x(), 2.1, 1e-12);
      EXPECT_NEAR((box.q_WO * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-9);
      EXPECT_NEAR(box.centre_W.z() - box.half_m.z(), 4.9, 1e-9) << "a lorry of 4 m passes under it";
      EXPECT_NEAR(box.centre_W.z() + box.half_m.z(), 5.6, 1e-9);
    }
  }
  EXPECT_EQ(bars, 2u);
  EXPECT_NEAR(wall_m, (end - begin).norm(), 1e-9);
}

TEST(ObstacleMap, WhereNothingStandsNothingIsNear) {
  const ObstacleMap map = MapOf("configs/worlds/plane.yaml");
  EXPECT_TRUE(map.all().empty());
  EXPECT_TRUE(map.Near({0.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(ObstacleMap().Near({1e6, -1e6, 0.0}).empty());
}

}  // namespace
}  // namespace rodeira::nodes
