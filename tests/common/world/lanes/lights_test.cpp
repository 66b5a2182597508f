// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/world/traffic_map/map_network.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/tree.hpp"

namespace rodeira::lanes {
namespace {

using testing::HasSubstr;

// The crossing with lights, with lanes 1, 3, 5 and 7 that come from the east, north, west and south.
std::shared_ptr<const network::Network> Crossing(const std::string& lights) {
  const auto file = traffic_map::LoadMap(std::filesystem::path(SourceDir()) / "configs/maps/lights.motors");
  const auto heights = traffic_map::ParseHeights("rodeira: motors/1\nlights:\n" + lights, "lights.motors.yaml");
  EXPECT_TRUE(heights.ok()) << heights.error().Text();
  const auto made = traffic_map::MakeLaneMap(file.value(), heights.value(), "lights.motors");
  EXPECT_TRUE(made.ok()) << made.error().Text();
  return traffic_map::ToNetwork(made.value(), "lights").value();
}

std::string Said(const network::Network& network) {
  const Graph graph(network);
  const auto status = CheckLights(graph, Zones(graph));
  return status ? "" : status.error().Text();
}

TEST(Lights, StandAtTheEndsOfTheirLanes) {
  const auto network = MapNetwork("lights");
  const Graph graph(*network);
  std::size_t lit = 0;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const auto lights = LightsOf(graph, track);
    const std::string& road = network->roads()[graph[track].lane.road].id();
    const bool arrives = road == "1" || road == "3" || road == "5" || road == "7";
    ASSERT_EQ(lights.size(), arrives ? 1u : 0u) << road;
    if (!arrives) continue;
    ++lit;
    EXPECT_NEAR(lights[0].d_m, graph[track].length_m(), 0.01);
    EXPECT_EQ(lights[0].signal, "light " + road);
    for (const Link& link : graph[track].next)
      EXPECT_EQ(LightFor(graph, link.to, 5.0)->controller, lights[0].controller);
  }
  EXPECT_EQ(lit, 4u);
}

// Oncoming traffic may be green, too; traffic from the side may not, not even at the other's amber.
TEST(Lights, ConflictingGreensAreNamed) {
  EXPECT_EQ(Said(*Crossing("- phases: [{green: [1, 5], for_s: 20}, {green: [3, 7], for_s: 20}]\n")), "");
  EXPECT_EQ(Said(*Crossing("- phases: [{green: [1], for_s: 9}, {green: [3], for_s: 9}, {green: [5], for_s: 9}, {green: "
                           "[7], for_s: 9}]\n")),
            "");
  const std::string together = Said(*Crossing("- phases: [{green: [1, 5, 3], for_s: 20}, {green: [7], for_s: 20}]\n"));
  EXPECT_THAT(together, HasSubstr("'lane 1' (signal light 1, road '1', lane -1)"));
  EXPECT_THAT(together, HasSubstr("'lane 3' (signal light 3, road '3', lane -1)"));
  EXPECT_THAT(together, HasSubstr("green or amber together, and their ways"));
  const std::string early =
      Said(*Crossing("- phases: [{green: [1, 5], for_s: 20}, {green: [9], for_s: 30}]\n- {offset_s: 22, phases: "
                     "[{green: [3, 7], for_s: 20}, {green: [10], for_s: 30}]}\n"));
  EXPECT_THAT(early, HasSubstr("green or amber together"));
}

TEST(Lights, OfRealFilesTakeTurnsWithoutConflict) {
  if (RealFiles().empty()) GTEST_SKIP() << "the real files are not beside the project";
  const auto network = opendrive::LoadNetwork(RealFolder() / "esmini_multi_intersections.xodr").value();
  const Graph graph(*network);
  const auto status = CheckLights(graph, Zones(graph));
  EXPECT_TRUE(status.ok()) << status.error().Text();
  std::size_t lights = 0;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) lights += LightsOf(graph, track).size();
  EXPECT_GT(lights, 20u);
}

}  // namespace
}  // namespace rodeira::lanes
