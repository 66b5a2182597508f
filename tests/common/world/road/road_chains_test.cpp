// SPDX-License-Identifier: Apache-2.0
// Names and stations of roads that junctions cut: the whole road, or one of its parts.
#include "common/world/road/road_chains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/world/road/world.hpp"

namespace rodeira::road {
namespace {

// A straight road to the east from x = 0 on, so that its stations are x; another one crosses it at 100 m.
std::shared_ptr<const World> Cross() {
  const auto world = World::Parse(
      "rodeira: world/2\nname: cross\nground: {kind: plane}\nroads:\n"
      "  - {id: main, axis: [line: {length_m: 300}], z_m: 0, section: {template: rural}}\n"
      "  - {id: side, place: {road: main, s_m: 100, turn_deg: 90, own_s_m: 80}, axis: [line: {length_m: 160}], "
      "section: {template: rural}}\n"
      "junctions:\n  - {id: j, roads: [{road: main, s_m: 100}, {road: side, s_m: 80}]}\n",
      "cross.yaml");
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().Text());
  return world.ok() ? world.value() : nullptr;
}

double EastOf(const network::Network& network, const RoadChain& chain, double s_m) {
  const auto [road, along_m] = chain.At(network, s_m);
  return road->axis().Evaluate(along_m).p_W.x();
}

TEST(RoadChains, ANameMeansTheWholeRoadOrOnePart) {
  const auto world = Cross();
  ASSERT_NE(world, nullptr);
  const network::Network& network = *world->network();
  const auto whole = FindRoadOrChain(network, "main");
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->parts.size(), 3u) << "two parts and the way between them";
  EXPECT_NEAR(whole->length_m, 300.0, 1e-6);
  for (const double s_m : {0.0, 40.0, 100.0, 250.0}) EXPECT_NEAR(EastOf(network, *whole, s_m), s_m, 1e-6);
  const auto behind = FindRoadOrChain(network, "main/2");
  ASSERT_TRUE(behind.has_value());
  EXPECT_EQ(behind->parts.size(), 1u);
  EXPECT_NEAR(EastOf(network, *behind, 40.0), 300.0 - behind->length_m + 40.0, 1e-6);
  EXPECT_FALSE(FindRoadOrChain(network, "mian").has_value());
}

TEST(RoadChains, NamesAreThoseOfWholeRoadsAndOfParts) {
  const auto world = Cross();
  ASSERT_NE(world, nullptr);
  EXPECT_THAT(NamesOfRoads(*world->network()),
              testing::ElementsAre("main", "side", "main/1", "main/2", "side/1", "side/2"));
}

}  // namespace
}  // namespace rodeira::road
