// SPDX-License-Identifier: Apache-2.0
// Promises of callers: a section has lanes without gaps, hills have room, a world has one ground, and a query has room
// for its answer.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/world/road/earthworks.hpp"
#include "common/world/road/hills.hpp"
#include "common/world/road/section.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

SectionSpec TwoLanes() {
  SectionSpec spec;
  spec.lanes = {{.id = -1, .width_m = 3.0}, {.id = 1, .width_m = 3.0}};
  return spec;
}

TEST(ContractsDeathTest, ASectionHasLanesOfSomeWidthAndABlend) {
  EXPECT_EQ(Section(TwoLanes()).lanes_left_m(), 3.0);
  SectionSpec narrow = TwoLanes(), abrupt = TwoLanes();
  narrow.lanes[0].width_m = 0.0;
  abrupt.blend_m = 0.0;
  EXPECT_DEATH(Section{SectionSpec()}, "!spec_.lanes.empty\\(\\)");
  EXPECT_DEATH(Section(std::move(abrupt)), "spec_.blend_m > 0.0");
  EXPECT_DEATH(Section(std::move(narrow)), "lane.width_m > 0.0");
}

TEST(ContractsDeathTest, LanesAreNumberedFromTheAxisWithoutGaps) {
  SectionSpec right = TwoLanes(), left = TwoLanes();
  right.lanes[0].id = -2;
  left.lanes[1].id = 2;
  EXPECT_DEATH(Section(std::move(right)), "lane->id == expected--");
  EXPECT_DEATH(Section(std::move(left)), "lane.id == expected\\+\\+");
}

TEST(ContractsDeathTest, HillsGrowBetweenTwoDistances) {
  HillsSpec spec;
  spec.columns = spec.rows = 3;
  spec.spacing_m = 5.0;
  spec.flat_m = 10.0, spec.full_m = 60.0, spec.reach_m = 180.0;
  const std::span<const AxisPoint> none;
  EXPECT_EQ(MakeHills(spec, none).frame().columns, 3);
  HillsSpec steep = spec, level = spec, dense = spec, near = spec;
  steep.full_m = 10.0;
  level.flat_m = 0.0;
  dense.spacing_m = 0.0;
  near.reach_m = 59.0;
  for (const HillsSpec& wrong : {steep, level, dense, near})
    EXPECT_DEATH((void)MakeHills(wrong, none), "spec.full_m > spec.flat_m");
}

TEST(ContractsDeathTest, AWorldHasATerrainOrRoadsButNotTwoTerrains) {
  WorldSpec none, both;
  both.plane = PlaneSpec();
  both.grid = std::make_shared<const terrain::ElevationGrid>(terrain::ElevationGrid::Frame{2, 2, 0.0, 0.0, 1.0, 1.0},
                                                             std::vector<float>(4, 0.0F));
  EXPECT_DEATH((void)World::Make(none), "grid\\(\\) != nullptr \\|\\| plane\\(\\)");
  EXPECT_DEATH((void)World::Make(both), "grid\\(\\) == nullptr \\|\\| !plane\\(\\)");
  both.grid.reset();
  EXPECT_NE(World::Make(both), nullptr);
}

TEST(ContractsDeathTest, QueriesHaveRoomForTheirAnswers) {
  const auto ground = Sample()->MakeGround();
  const std::array<ground::GroundQuery, 2> queries{};
  std::array<ground::GroundPoint, 2> points{};
  ground->Query(queries, points);
  EXPECT_TRUE(points[0].inside);
  EXPECT_DEATH(ground->Query(queries, std::span(points).first(1)), "queries.size\\(\\) == points.size\\(\\)");
}

// The one road of the sample has a blend (version 1).
TEST(ContractsDeathTest, ARoadWithABlendIsAlone) {
  const network::Network& sample = *Sample()->network();
  const auto network_of = [&](int roads) {
    network::NetworkSpec spec;
    for (int i = 0; i < roads; ++i) spec.roads.push_back(sample.roads()[0]);
    return std::make_shared<const network::Network>(std::move(spec));
  };
  ASSERT_EQ(sample.roads().size(), 1U);
  SurfacePoint ground;
  Earthworks(network_of(1), {}).Shape({0.0, 0.0}, ground);
  EXPECT_DEATH(Earthworks(network_of(2), {}), "!blends_ \\|\\|");
}

}  // namespace
}  // namespace rodeira::road
