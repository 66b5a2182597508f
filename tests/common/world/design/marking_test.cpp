// SPDX-License-Identifier: Apache-2.0
// Crossings, stop lines and arrows of a world file, against the places that their keys say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

std::string RoadWith(const std::string& markings) {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    z_m: 0\n    section: {lanes: "
         "[{id: -2, type: sidewalk, width_m: 2}, {id: -1, width_m: 3.5}, {id: 1, width_m: 3}]}\n"
         "    markings:\n" +
         markings;
}

const network::RoadSpec& SpecOf(const Design& design) { return design.network->roads()[0].spec(); }

// Between t = -3.5 and 3 there is room for exactly 7 stripes and 6 gaps of 0.5 m.
TEST(Markings, ACrossingIsStripesOverWhatIsDrivenOn) {
  const Design design = SoundDesign(RoadWith("      - {type: crossing, s_m: 40, length_m: 3}\n"));
  const auto& lines = SpecOf(design).lines;
  ASSERT_EQ(lines.size(), 7u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_NEAR(lines[i].t.Value(40.0), -3.25 + static_cast<double>(i), 1e-12);
    EXPECT_EQ(lines[i].width_m, 0.5);
    EXPECT_EQ(lines[i].from_s_m, 38.5);
    EXPECT_EQ(lines[i].to_s_m, 41.5);
    EXPECT_EQ(lines[i].gap_m, 0.0);
  }
}

// Its stripes are lines; the object, which paints nothing, says where people cross.
TEST(Markings, ACrossingIsAnObjectToo) {
  const Design design = SoundDesign(RoadWith("      - {type: crossing, s_m: 40, length_m: 3}\n"));
  const auto& objects = SpecOf(design).objects;
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].type, "crosswalk");
  EXPECT_EQ(objects[0].subtype, "virtual");
  EXPECT_EQ(objects[0].s_m, 40.0);
  EXPECT_EQ(objects[0].length_m, 3.0);
  EXPECT_NEAR(objects[0].t_m, -0.25, 1e-12);
  EXPECT_NEAR(objects[0].width_m, 6.5, 1e-12);
}

TEST(Markings, AStopLineIsBeforeItsTraffic) {
  const auto only = [](const std::string& keys) {
    const Design design = SoundDesign(RoadWith("      - {type: stop_line, s_m: 50" + keys + "}\n"));
    EXPECT_EQ(SpecOf(design).lines.size(), 1u);
    return SpecOf(design).lines.at(0);
  };
  const network::PaintedLine along = only(""), against = only(", for: against, length_m: 0.4"),
                             lane = only(", lane: 1");
  EXPECT_NEAR(along.t.Value(50.0), -1.75, 1e-12);
  EXPECT_NEAR(along.width_m, 3.3, 1e-12);
  EXPECT_EQ(along.to_s_m - along.from_s_m, 0.5);
  EXPECT_NEAR(against.t.Value(50.0), 1.5, 1e-12);
  EXPECT_NEAR(against.to_s_m - against.from_s_m, 0.4, 1e-12);
  EXPECT_NEAR(lane.t.Value(50.0), 1.5, 1e-12);
  EXPECT_NEAR(lane.width_m, 2.8, 1e-12);
}

TEST(Markings, AnArrowLooksWhereItsLaneIsDriven) {
  const Design design =
      SoundDesign(RoadWith("      - {type: arrow, s_m: 60, lane: -1, ways: [right, straight]}\n      - {type: arrow, "
                           "s_m: 60, lane: 1, ways: [left], length_m: 6}\n"));
  const auto& objects = SpecOf(design).objects;
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].type, "roadMark");
  EXPECT_EQ(objects[0].subtype, "arrowStraightRight");
  EXPECT_NEAR(objects[0].t_m, -1.75, 1e-12);
  EXPECT_EQ(objects[0].hdg_rad, 0.0);
  EXPECT_EQ(objects[1].subtype, "arrowLeft");
  EXPECT_NEAR(objects[1].hdg_rad, geometry::kPi, 1e-12);
  EXPECT_EQ(objects[1].length_m, 6.0);
}

TEST(Markings, WhatDoesNotFitIsToldWithItsLine) {
  EXPECT_THAT(FirstProblem(RoadWith("      - {type: arrow, s_m: 60, lane: -1, ways: [up]}\n")),
              HasSubstr("made.yaml:8: 'up' is no way that an arrow points; left, straight or right was expected"));
  EXPECT_THAT(FirstProblem(RoadWith("      - {type: stop_line, s_m: 60, lane: -9}\n")),
              HasSubstr("made.yaml:8: the road has no lane -9"));
  EXPECT_THAT(FirstProblem(RoadWith("      - {type: zebra, s_m: 60}\n")), HasSubstr("crossing"));
  EXPECT_THAT(FirstProblem(RoadWith("      - {type: crossing, s_m: 160}\n")), HasSubstr("made.yaml:8"));
}

}  // namespace
}  // namespace rodeira::design
