// SPDX-License-Identifier: Apache-2.0
// Where roads, lanes and records go on: steps, kinks, banks that jump, bends too sharp for their lanes. Expected
// numbers are computed by hand.
#include <gmock/gmock.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

struct Told {
  std::vector<std::string> errors, warnings;
};

Told Of(const std::string& text, const Tolerance& tolerance = Tolerance::Unrepaired()) {
  const auto import = Read(text, "sample.xodr", tolerance);
  EXPECT_TRUE(import.ok());
  Told told;
  for (const Finding& finding : import.value().errors) told.errors.push_back(finding.Text());
  for (const Finding& finding : import.value().warnings) told.warnings.push_back(finding.Text());
  return told;
}

std::string Lanes(const char* link, int id) {
  return fmt::format(
      R"(<lane id="{}" type="driving"><link><{} id="{}"/></link><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>)",
      id, link, id);
}

// Road 1 from the origin 100 m east, road 2 on from there.
struct Pair {
  RoadText first, second;
  Pair() {
    first.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
    first.left = Lanes("successor", 1), first.right = Lanes("successor", -1);
    second.id = "2", second.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)";
    second.left = Lanes("predecessor", 1), second.right = Lanes("predecessor", -1);
    Second(0.0, "<line/>");
  }
  void Second(double heading, const std::string& kind) {
    second.geometry =
        fmt::format(R"(<geometry s="0" x="100" y="0" hdg="{}" length="100">{}</geometry>)", heading, kind);
  }
  void Height(double z_m) { second.elevation = fmt::format(R"(<elevation s="0" a="{}" b="0" c="0" d="0"/>)", z_m); }
  std::string Text() const { return Document(first.Text() + second.Text()); }
};

TEST(Joints, OfRoadsThatMeetSayNothing) {
  EXPECT_THAT(Of(Pair().Text()).warnings, IsEmpty());
  EXPECT_THAT(Of(Pair().Text(), Tolerance::Strict()).errors, IsEmpty());
}

TEST(Joints, AStepBetweenRoadsIsToldOnce) {
  Pair pair;
  pair.Height(1.0);
  EXPECT_THAT(Of(pair.Text()).errors, ElementsAre("road.elevation.contact_point: road 1, s 100: a step of 1 m to the "
                                                  "start of road 2; at most 0.2 m was expected"));
  pair.Height(0.15);
  EXPECT_THAT(Of(pair.Text()).errors, IsEmpty());
  EXPECT_THAT(Of(pair.Text()).warnings,
              ElementsAre(StartsWith("road.elevation.contact_point: road 1, s 100: a step of 0.15 m to the start of "
                                     "road 2; at most 0.2 m is passed")));
  EXPECT_THAT(Of(pair.Text(), Tolerance::Strict()).errors, Contains(StartsWith("road.elevation.contact_point")));
  pair.Height(0.0005);
  EXPECT_THAT(Of(pair.Text()).warnings, IsEmpty());
}

TEST(Joints, AKinkBetweenRoadsIsTold) {
  Pair pair;
  pair.Second(0.002, "<line/>");
  EXPECT_THAT(Of(pair.Text()).errors,
              Contains(StartsWith("road.geometry.contact_heading: road 1, s 100: a kink of 0.002 rad to the start of "
                                  "road 2; at most 0.001 rad was expected")));
  pair.Second(0.0005, "<line/>");
  EXPECT_THAT(Of(pair.Text()).errors, IsEmpty());
  EXPECT_THAT(Of(pair.Text()).warnings,
              Contains(HasSubstr("a kink of 0.0005 rad to the start of road 2; it is closed")));
  EXPECT_THAT(Of(pair.Text(), Tolerance::Strict()).errors, Contains(StartsWith("road.geometry.contact_heading")));
}

// 3.5 m beside the axis a bank of 0.1 rad lies 3.5 sin(0.1) = 0.3494 m lower or higher; the axis itself does not.
TEST(Joints, ABankAgainstNoneIsAStepOfTheLanes) {
  Pair pair;
  pair.second.lateral = R"(<superelevation s="0" a="0.1" b="0" c="0" d="0"/>)";
  const Told told = Of(pair.Text());
  EXPECT_THAT(told.errors,
              Contains(StartsWith("lane_smoothness.contact_point_no_vertical_gaps: road 1, lane -1, s 100: a step of "
                                  "0.3494 m between the lane's edges and those of lane -1 of road 2")));
  EXPECT_THAT(told.errors, testing::Each(HasSubstr("lane_smoothness.contact_point_no_vertical_gaps")));
}

TEST(Joints, AJumpOfTheElevationWithinARoad) {
  RoadText road;
  road.elevation = R"(<elevation s="0" a="0" b="0.01" c="0" d="0"/><elevation s="50" a="1.5" b="0" c="0" d="0"/>)";
  EXPECT_THAT(Of(Document(road.Text())).errors,
              ElementsAre("road.elevation.contact_point: road 1, s 50: the elevation jumps by 1 m from one record to "
                          "the next; at most 0.2 m was expected"));
  road.elevation = R"(<elevation s="0" a="0" b="0.01" c="0" d="0"/><elevation s="50" a="0.5" b="0" c="0" d="0"/>)";
  EXPECT_THAT(Of(Document(road.Text())).warnings, IsEmpty());
}

TEST(Joints, AJumpOfTheBankWithinARoad) {
  RoadText road;
  road.lateral = R"(<superelevation s="0" a="0" b="0" c="0" d="0"/><superelevation s="40" a="0.1" b="0" c="0" d="0"/>)";
  EXPECT_THAT(Of(Document(road.Text())).errors,
              ElementsAre(HasSubstr("road.lateral.contact_point: road 1, s 40: bank or cross-section jump: the road's "
                                    "surface by 0.3494 m at t 3.5; at most 0.2 m was expected")));
  road.lateral =
      R"(<superelevation s="0" a="0" b="0.0025" c="0" d="0"/><superelevation s="40" a="0.1" b="0" c="0" d="0"/>)";
  EXPECT_THAT(Of(Document(road.Text())).errors, IsEmpty());
  EXPECT_THAT(Of(Document(road.Text())).warnings, IsEmpty());
}

TEST(Joints, ALaneThatFoldsInABendIsNamedWithItsStation) {
  RoadText road;
  road.length = 6.0, road.left = "";
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="6"><arc curvature="-0.5"/></geometry>)";
  EXPECT_THAT(Of(Document(road.Text())).warnings,
              ElementsAre("road.lane.fold: road 1, s 0: the edge of the lanes that are driven on 3.50 m to the right "
                          "folds: the bend there has a radius of 2 m"));
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="6"><arc curvature="0.5"/></geometry>)";
  EXPECT_THAT(Of(Document(road.Text())).warnings, IsEmpty());
  // A clothoid from none to 1 / 3 m over 6 m: 3.5 m beside it the edge folds where k * 3.5 > 0.95, from s = 4.886 m on,
  // first seen at 5.5 m.
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="6"><spiral curvStart="0" curvEnd="-0.33333333333333333"/>
          </geometry>)";
  EXPECT_THAT(
      Of(Document(road.Text())).warnings,
      ElementsAre(HasSubstr("road 1, s 5.5: the edge of the lanes that are driven on 3.50 m to the right folds")));
  // Only a pavement folds.
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="6"><arc curvature="-0.25"/></geometry>)";
  road.right += R"(<lane id="-2" type="sidewalk"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane>)";
  EXPECT_THAT(Of(Document(road.Text())).warnings,
              ElementsAre(HasSubstr("road 1, s 0: the edge of the lanes 5.50 m to the right folds")));
}

TEST(Joints, ALaneNarrowerThanNothingIsTold) {
  RoadText road;
  road.right = R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="-0.05" c="0" d="0"/></lane>)";
  EXPECT_THAT(Of(Document(road.Text())).warnings,
              ElementsAre("road.lane.width: road 1, lane -1, s 100: the lane is -1.5 m wide here, its narrowest place; "
                          "0 or more was expected"));
}

// Between roads too, and once for each road that has any.
TEST(Joints, CurvatureThatJumpsIsToldOnceARoad) {
  Pair pair;
  pair.Second(0.0, R"(<arc curvature="0.01"/>)");
  EXPECT_THAT(Of(pair.Text()).warnings,
              ElementsAre("road.geometry.curvature: road 1, s 100: the curvature jumps by 0.01000 1/m to road 2"));
  RoadText a, b;
  b.id = "2";
  for (RoadText* road : {&a, &b}) {
    road->geometry = fmt::format(
        R"(<geometry s="0" x="0" y="{0}" hdg="0" length="50"><line/></geometry>
            <geometry s="50" x="50" y="{0}" hdg="0" length="50"><arc curvature="0.001"/></geometry>)",
        road == &a ? 0 : 100);
  }
  EXPECT_THAT(Of(Document(a.Text() + b.Text())).warnings,
              ElementsAre("road.geometry.curvature: road 1, s 50: the curvature jumps by 0.00100 1/m",
                          "road.geometry.curvature: road 2, s 50: the curvature jumps by 0.00100 1/m"));
}

}  // namespace
}  // namespace rodeira::opendrive
