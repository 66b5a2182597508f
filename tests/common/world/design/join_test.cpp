// SPDX-License-Identifier: Apache-2.0
// Roads that go on into one another: what does not meet there is told with both stations. The numbers are computed by
// hand here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/names.hpp"

#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// East for 100 m to the origin of `b`, which goes on as it says; line 6 is the link.
std::string Two(const std::string& b, const std::string& section = "{template: rural}",
                const std::string& a = "z_m: 0") {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 100}]\n    section: {template: rural}\n    "
         "successor: {road: b, end: start}\n    " +
         a + "\n  - id: b\n    axis: [line: {length_m: 50}]\n    " + b + "\n    section: " + section + "\n";
}

std::vector<std::string> Warnings(const std::string& text) { return SoundDesign(text).warnings; }

TEST(Join, OfRoadsThatMeetSaysNothing) {
  EXPECT_THAT(Warnings(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0")), IsEmpty());
  // End to end: the other road runs the other way.
  std::string turned = Two("start: {x_m: 150, y_m: 0, heading_deg: 180}\n    z_m: 0");
  turned.replace(turned.find("end: start"), 10, "end: end");
  EXPECT_THAT(Warnings(turned), IsEmpty());
}

TEST(Join, AKinkIsRefused) {
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0, heading_deg: 30}\n    z_m: 0")),
              HasSubstr("made.yaml:6: road 'a' at s = 100.000 m and road 'b' at s = 0.000 m meet with a kink of 30.000 "
                        "degrees to the left; at most 0.057 degrees was expected"));
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0, heading_deg: -0.06}\n    z_m: 0")),
              HasSubstr("a kink of 0.060 degrees to the right"));
  EXPECT_EQ(FirstProblem(Two("start: {x_m: 100, y_m: 0, heading_deg: -0.05}\n    z_m: 0")), "none");
}

TEST(Join, AStepOfTheAxesIsRefusedAndAGapToldApart) {
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0.5")),
              HasSubstr("made.yaml:6: road 'b' at s = 0.000 m is 0.500 m higher than road 'a' at s = 100.000 m; at "
                        "most 0.05 m was expected"));
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0.06}\n    z_m: 0")), HasSubstr("are 0.060 m apart in plan"));
}

// The edge between lane and shoulder, 3.5 m from the axis, stands 3.5 * 0.025 m lower than it on a crowned road; a bank
// of 6 % lowers it by 3.5 sin(atan(0.06)) more.
TEST(Join, ABankAgainstNoneIsRefused) {
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0\n    superelevation: [{s_m: 0, slope: 0.06}]")),
              HasSubstr("a step of 0.210 m in the road's surface between road 'a' at s = 100.000 m and road 'b' at s = "
                        "0.000 m, 3.50 m to the"));
}

TEST(Join, LanesOfAnotherWidthAreRefused) {
  EXPECT_THAT(FirstProblem(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0", "{template: motorway}")),
              HasSubstr("the edges of lane -1 of road 'a' at s = 100.000 m and of lane -1 of road 'b' at s = 0.000 m "
                        "are up to 0.250 m apart; at most 0.05 m was expected"));
}

TEST(Join, SmallStepsLanesThatEndAndGradesAreWarnings) {
  EXPECT_THAT(Warnings(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0.02")),
              ElementsAre(HasSubstr("made.yaml:6: a step of 0.020 m in the road's surface")));
  EXPECT_THAT(
      Warnings(Two("start: {x_m: 100, y_m: 0}\n    z_m: 0", "{template: rural, lanes: [{id: -1, width_m: 3.5}]}")),
      testing::Contains(HasSubstr(
          "lane 1 of road 'a' at s = 100.000 m, 3.50 m wide, ends there: road 'b' has no lane 1 to drive on")));
  EXPECT_THAT(Warnings(Two("start: {x_m: 100, y_m: 0}\n    vertical: [{s_m: 0, z_m: 0}, {s_m: 50, z_m: 1}]")),
              ElementsAre(Names("road 'a' at s = 100.000 m … road 'b' at s = 0.000 m … 2.00 % in their grade")));
}

// Said by both roads it is told once.
TEST(Join, SaidTwiceIsToldOnce) {
  const Design design =
      DesignOf(Two("start: {x_m: 100, y_m: 0, heading_deg: 3}\n    z_m: 0\n    predecessor: {road: a, end: end}"));
  EXPECT_EQ(design.problems.size(), 1u);
}

}  // namespace
}  // namespace rodeira::design
