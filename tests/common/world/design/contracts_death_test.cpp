// SPDX-License-Identifier: Apache-2.0
// Promises of callers: a part of a road has a length and its road one lane section, a junction has arms and an outline.
#include <gtest/gtest.h>

#include <vector>

#include "common/world/design/cut.hpp"
#include "common/world/design/junction_surface.hpp"
#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

constexpr const char* kRoad = R"(rodeira: world/2
roads:
  - id: a
    start: {x_m: 0, y_m: 0, heading_deg: 0}
    axis: [line: {length_m: 80}]
    section: {template: rural}
)";

TEST(ContractsDeathTest, APartGoesForwardOnARoadOfOneSection) {
  const Design design = SoundDesign(kRoad);
  const network::Road& road = design.network->roads()[0];
  EXPECT_NEAR(Cut(road, 10.0, 30.0, "part").length_m(), 20.0, 1e-9);
  EXPECT_DEATH((void)Cut(road, 30.0, 30.0, "part"), "from_m < to_m");
  network::RoadSpec twice = road.spec();
  twice.sections.push_back(twice.sections.front());
  twice.sections.back().s_m = 40.0;
  const network::Road two_sections(twice, road.axis());
  EXPECT_DEATH((void)Cut(two_sections, 10.0, 30.0, "part"), "whole.sections.size\\(\\) == 1");
}

TEST(ContractsDeathTest, AJunctionHasTwoArmsAndAnOutline) {
  const Design design = SoundDesign(kRoad);
  const network::Road& road = design.network->roads()[0];
  const std::vector<ArmSection> arms{SectionOf(road, network::End::kStart, 1.0),
                                     SectionOf(road, network::End::kEnd, 1.0)};
  const std::vector<Eigen::Vector2d> outline{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  EXPECT_EQ(JunctionSurface("j", arms, outline, {}, {}).arms().size(), 2U);
  EXPECT_DEATH(JunctionSurface("j", {arms[0]}, outline, {}, {}), "arms_.size\\(\\) >= 2");
  EXPECT_DEATH(JunctionSurface("j", arms, {outline[0], outline[1]}, {}, {}), "outline_.size\\(\\) >= 3");
}

}  // namespace
}  // namespace rodeira::design
