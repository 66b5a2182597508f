// SPDX-License-Identifier: Apache-2.0
// Lines of paint against circles of known lengths, and against the marks' own words.
#include "common/world/network/marking.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::network {
namespace {

// An arc to the left of radius 50 m with one lane of 4 m on each side; the right one's outer edge is 54 m from the
// middle.
Road Arc(std::vector<RoadMark> marks) {
  geometry::PlanElement arc;
  arc.length_m = 200.0;
  arc.curvature_start_1pm = arc.curvature_end_1pm = 0.02;
  RoadSpec spec;
  spec.id = "1";
  spec.length_m = 200.0;
  LaneSection section;
  section.end_s_m = 200.0;
  Lane left, right;
  left.id = 1;
  right.id = -1;
  left.width = right.width = geometry::CubicTable({{0.0, 4.0, 0.0, 0.0, 0.0}});
  right.marks = std::move(marks);
  section.left = {left};
  section.right = {right};
  spec.sections = {section};
  return {spec, *geometry::PlanAxis::Make({arc})};
}

RoadMark Mark(double s_m, const std::string& type) {
  RoadMark mark;
  mark.s_m = s_m;
  mark.type = type;
  mark.width_m = 0.2;
  mark.colour = "white";
  return mark;
}

TEST(Marking, DashesHaveTheirLengthOnTheLineItself) {
  RoadMark mark = Mark(0.0, "broken");
  MarkLine line;
  line.length_m = 3.0;
  line.space_m = 5.0;
  line.s_offset_m = 2.0;
  mark.lines = {line};
  const Road road = Arc({mark});
  const auto markings = MarkingsOf(road);
  ASSERT_EQ(markings.size(), 1u);
  EXPECT_NEAR(MarkingLength(road, markings[0], 0.0, 200.0), 200.0 * 54.0 / 50.0, 1e-9);
  const auto strokes = StrokesOf(road, markings[0]);
  ASSERT_EQ(strokes.size(), 27u);  // 216 m: the first begins after 2 m, then one every 8 m
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    EXPECT_NEAR(strokes[k].from_s_m, (2.0 + 8.0 * static_cast<double>(k)) * 50.0 / 54.0, 1e-7);
    EXPECT_NEAR(strokes[k].to_s_m - strokes[k].from_s_m, 3.0 * 50.0 / 54.0, 1e-7);
  }
}

// Records that cut a broken mark in two do not show: the pattern is that of one record.
// A short way over a junction, as SUMO writes it: its outer edge folds within a dash. The dashes end at the line's end,
// one behind the other.
TEST(Marking, DashesOfALineThatFoldsComeToAnEnd) {
  geometry::PlanElement cubic;
  cubic.kind = geometry::PlanElement::Kind::kCubic;
  cubic.length_m = 3.45055987;
  cubic.u = {0.0, 5.03959594, -5.96237186, 3.92030343};
  cubic.v = {0.0, 0.0, 3.27776874, -1.76033052};
  for (const double heading_rad : {0.0, 0.19237487}) {
    cubic.heading_rad = heading_rad;
    for (double width_m = 1.5; width_m < 4.0; width_m += 0.1) {
      RoadSpec spec;
      spec.id = "1";
      spec.length_m = cubic.length_m;
      LaneSection section;
      section.end_s_m = spec.length_m;
      Lane lane;
      lane.id = -1;
      lane.width = geometry::CubicTable({{0.0, width_m, 0.0, 0.0, 0.0}});
      lane.marks = {Mark(0.0, "broken")};
      section.right = {lane};
      spec.sections = {section};
      const Road road(spec, *geometry::PlanAxis::Make({cubic}));
      ASSERT_FALSE(MarkingsOf(road).empty());
      for (const Marking& marking : MarkingsOf(road)) {
        double before = marking.from_s_m;
        for (const Stroke& stroke : StrokesOf(road, marking)) {
          EXPECT_GE(stroke.from_s_m, before);
          EXPECT_GT(stroke.to_s_m, stroke.from_s_m);
          before = stroke.to_s_m;
        }
        EXPECT_LE(before, marking.to_s_m);
      }
    }
  }
}

TEST(Marking, DashesGoOnFromRecordToRecord) {
  const Road whole = Arc({Mark(0.0, "broken")}),
             cut = Arc({Mark(0.0, "broken"), Mark(37.0, "broken"), Mark(90.5, "broken")});
  const auto painted = [](const Road& road) {
    std::vector<Stroke> all;
    for (const Marking& line : MarkingsOf(road)) {
      for (const Stroke& stroke : StrokesOf(road, line)) {
        if (!all.empty() && stroke.from_s_m - all.back().to_s_m < 1e-6)
          all.back().to_s_m = stroke.to_s_m;
        else
          all.push_back(stroke);
      }
    }
    return all;
  };
  const auto expected = painted(whole), found = painted(cut);
  ASSERT_EQ(MarkingsOf(cut).size(), 3u);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].from_s_m, expected[k].from_s_m, 1e-6);
    EXPECT_NEAR(found[k].to_s_m, expected[k].to_s_m, 1e-6);
  }
}

TEST(Marking, TwoWordsAreTwoLinesTheInnerOneFirst) {
  const Road road = Arc({Mark(10.0, "solid broken"), Mark(60.0, "none")});
  const auto markings = MarkingsOf(road);
  ASSERT_EQ(markings.size(), 2u);
  const double solid = MarkingAt(road, markings[0], 20.0).value, broken = MarkingAt(road, markings[1], 20.0).value;
  EXPECT_EQ(markings[0].gap_m, 0.0);
  EXPECT_GT(markings[1].gap_m, 0.0);
  EXPECT_NEAR(0.5 * (solid + broken), -4.0, 1e-12);
  EXPECT_NEAR(solid - broken, 0.2 + kBetween_m, 1e-12);  // the inner one of a right lane lies to the left
  EXPECT_EQ(markings[0].from_s_m, 10.0);
  EXPECT_EQ(markings[0].to_s_m, 60.0);
}

TEST(Marking, ExplicitLinesStandWhereTheySay) {
  RoadMark mark = Mark(10.0, "custom");
  MarkLine line;
  line.length_m = 6.0;
  line.s_offset_m = 15.0;
  line.t_offset_m = -0.5;
  line.width_m = 0.3;
  mark.explicit_lines = {line};
  const Road road = Arc({mark});
  const auto markings = MarkingsOf(road);
  ASSERT_EQ(markings.size(), 1u);
  EXPECT_EQ(markings[0].width_m, 0.3);
  EXPECT_EQ(StrokesOf(road, markings[0]).size(), 1u);
  EXPECT_EQ(StrokesOf(road, markings[0])[0].from_s_m, 25.0);
  EXPECT_EQ(StrokesOf(road, markings[0])[0].to_s_m, 31.0);
  EXPECT_NEAR(MarkingAt(road, markings[0], 28.0).value, -4.5, 1e-12);
}

TEST(Marking, SomeTypesPaintNothing) {
  for (const char* type : {"none", "curb", "edge", "grass"})
    EXPECT_TRUE(MarkingsOf(Arc({Mark(0.0, type)})).empty()) << type;
}

}  // namespace
}  // namespace rodeira::network
