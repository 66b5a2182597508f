// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/way_from_start.hpp"

#include <gtest/gtest.h>

#include "common/world/network/network.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace rodeira::driver {
namespace {

TEST(WayFromStart, EachDrivableLaneOfTheRoadCanBeChosen) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const network::Network& network = *world.value()->network();
  const road::StartPose& start = world.value()->start();
  const auto at = network.Locate(start.x_m, start.y_m);
  ASSERT_TRUE(at);
  int driven = 0, refused = 0;
  for (const int lane : {-4, -3, -2, -1, 1, 2, 3, 4, 99}) {
    network::LaneKey key = at->lane;
    key.lane = lane;
    const network::Lane* found = network.Find(key);
    const auto way = WayFromStart(*world.value(), lane, "launch.yaml");
    if (found == nullptr || !network::IsDrivable(found->type)) {
      ++refused;
      ASSERT_FALSE(way.ok()) << lane;
      EXPECT_EQ(way.error().exit_status(), 2);
      EXPECT_NE(way.error().Text().find("has no lane " + std::to_string(lane) + " to drive on"), std::string::npos)
          << way.error().Text();
      continue;
    }
    ++driven;
    ASSERT_TRUE(way.ok()) << way.error().Text();
    const Eigen::Vector3d p_W = way.value().way->Position(20.0, 0.0);
    const auto place = network.Locate(p_W.x(), p_W.y());
    ASSERT_TRUE(place) << lane;
    EXPECT_EQ(place->lane.lane, lane);
    EXPECT_EQ(place->lane.road, at->lane.road);
  }
  EXPECT_EQ(driven, 2);
  EXPECT_EQ(refused, 7);
}

TEST(WayFromStart, AWorldWithoutARoadIsRefused) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const auto way = WayFromStart(*world.value(), std::nullopt, "launch.yaml");
  ASSERT_FALSE(way.ok());
  EXPECT_EQ(way.error().Text(), "launch.yaml: this world has no road to start on; the autopilot needs one");
}

TEST(WayFromStart, AStartBesideTheLanesIsNamedWithTheNearestRoad) {
  const auto world = road::World::Parse(R"(rodeira: world/2
name: one road
ground: {kind: plane, z_m: 0, surface: asphalt}
start: {x_m: 50, y_m: 40, heading_deg: 0}
roads:
  - id: main
    start: {x_m: 0, y_m: 0, heading_deg: 0}
    axis: [line: {length_m: 200}]
    section: {template: rural}
)",
                                        "world.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const auto way = WayFromStart(*world.value(), std::nullopt, "launch.yaml");
  ASSERT_FALSE(way.ok());
  EXPECT_EQ(way.error().id.text(), "world.no_lane");
  for (const char* part : {"x_m 50.00", "y_m 40.00", "road 'main'", "s_m 50.0", "t_m 40.0"})
    EXPECT_NE(way.error().Text().find(part), std::string::npos) << way.error().Text();
}

}  // namespace
}  // namespace rodeira::driver
