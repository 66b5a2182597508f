// SPDX-License-Identifier: Apache-2.0
// Roads that run into themselves, out of their terrain, or fold: each is a sentence with file, line and station,
// computed by hand here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/names.hpp"

#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

// 'rural' is 5.75 m wide on both sides of its axis: 3.5 m of lane, 0.75 of shoulder, 1.5 of verge.
std::string Road(const std::string& axis, const std::string& keys = "") {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [{" + axis + "}]\n    section: {template: rural}\n" + keys;
}

// East for 100 m, round to the left by 270 degrees about (100, 40), south along x = 60: across its own beginning at s =
// 100 + 60 pi + 40 = 328.5 m.
std::string Loop(const std::string& keys = "") {
  return Road("line: {length_m: 100}}, {arc: {turn_deg: 270, radius_m: 40}}, {line: {length_m: 100}", keys);
}

TEST(SelfCrossing, AtGradeIsNamedWithBothStations) {
  // The left edge, at y = 5.75, comes to x = 60 - 5.75 behind s = 54.25 m; there lies s = 322.7 m.
  EXPECT_THAT(
      FirstProblem(Loop()),
      HasSubstr(
          "made.yaml:4: road 'a' comes too near to itself: its left edge at s = 55 m lies on the road at s = 323 m; "
          "move the axis, or let one of them pass on a bridge"));
}

TEST(SelfCrossing, OnAnotherLevelIsNone) {
  // Over itself by 2.5 m, and by 1.5 m, which is one level: the road rises by as much on its bend.
  const auto rising = [](double by_m) {
    return "    vertical: [{s_m: 0, z_m: 0}, {s_m: 100, z_m: 0}, {s_m: 280, z_m: " + std::to_string(by_m) +
           "}, {s_m: 388, z_m: " + std::to_string(by_m) + "}]\n";
  };
  EXPECT_EQ(FirstProblem(Loop(rising(2.5))), "none");
  EXPECT_THAT(FirstProblem(Loop(rising(1.5))), HasSubstr("comes too near to itself"));
  EXPECT_EQ(FirstProblem(Loop("    bridges: [{from_s_m: 310, to_s_m: 345}]\n")), "none");
  EXPECT_EQ(FirstProblem(Loop("    tunnels: [{from_s_m: 310, to_s_m: 345}]\n")), "none");
  EXPECT_EQ(FirstProblem(Loop("    bridges: [{from_s_m: 50, to_s_m: 70}]\n")), "none");
  // A bridge that is too short: the right edge of its road still lies on the other one.
  EXPECT_THAT(FirstProblem(Loop("    bridges: [{from_s_m: 327, to_s_m: 345}]\n")),
              HasSubstr("its left edge at s = 55 m lies on the road at s = 323 m"));
}

// Back beside itself, 20 m away, then 40 (1 - cos(turn)) nearer: verges touch where both axes are 11.5 m apart.
TEST(SelfCrossing, BesideItselfVergesMayNotOverlap) {
  const auto beside = [](double apart_m) {
    const std::string turn = std::to_string(std::acos(1.0 - (20.0 - apart_m) / 40.0) * 180.0 / std::acos(-1.0));
    return Road("line: {length_m: 150}}, {arc: {turn_deg: 180, radius_m: 10}}, {arc: {turn_deg: " + turn +
                ", radius_m: 20}}, {arc: {turn_deg: " + turn + ", radius_m: -20}}, {line: {length_m: 60}");
  };
  EXPECT_EQ(FirstProblem(beside(11.6)), "none");
  EXPECT_THAT(FirstProblem(beside(11.4)), HasSubstr("road 'a' comes too near to itself: its left edge at s = "));
}

// A road closed in itself touches its own end, and a turn as sharp as may be does not meet its other leg.
TEST(SelfCrossing, RingsAndHairpinsAreNone) {
  EXPECT_EQ(FirstProblem(Road("arc: {turn_deg: 360, radius_m: 30}",
                              "    predecessor: {road: a, end: end}\n    successor: {road: a, end: start}\n")),
            "none");
  EXPECT_EQ(FirstProblem(Road("line: {length_m: 80}}, {arc: {turn_deg: 180, radius_m: 6.1}}, {line: {length_m: 80}")),
            "none");
  EXPECT_EQ(FirstProblem(Road("arc: {turn_deg: 180, radius_m: 6.1}}, {arc: {turn_deg: 180, radius_m: -6.1}}, {arc: "
                              "{turn_deg: 180, radius_m: 6.1}")),
            "none");
}

// Two rounds of one circle lie on one another wholly.
TEST(SelfCrossing, ASecondRoundIsNamed) {
  EXPECT_THAT(FirstProblem(Road("arc: {turn_deg: 400, radius_m: 30}")), HasSubstr("comes too near to itself"));
}

// What a junction takes is not compared: there the crossing is one surface.
TEST(SelfCrossing, InAJunctionIsNone) {
  const std::string loop = Loop();
  EXPECT_EQ(FirstProblem(loop + "junctions:\n  - {id: x, roads: [{road: a, s_m: 60}, {road: a, s_m: 328.4956}]}\n"),
            "none");
}

TEST(Folds, OfAnArcShorterThanAMetreAreNamed) {
  const auto with = [](const std::string& arc) {
    return Road("line: {length_m: 40.3}}, {" + arc + "}, {line: {length_m: 40}");
  };
  EXPECT_THAT(FirstProblem(with("arc: {length_m: 0.4, radius_m: 5.5}")),
              Names("made.yaml:4: … road 'a' 5.75 m to the left … s = 40 m: … 5.5 m"));
  EXPECT_THAT(FirstProblem(with("arc: {length_m: 0.1, radius_m: -5.5}")),
              HasSubstr("5.75 m to the right folds at s = 40 m"));
  // A clothoid is sharpest at its end, between two of the metres that are looked at.
  EXPECT_THAT(FirstProblem(with("clothoid: {length_m: 20.4, radius_end_m: 6}")),
              Names("5.75 m to the left … s = 61 m: … 6 m"));
  EXPECT_EQ(FirstProblem(with("clothoid: {length_m: 20.4, radius_end_m: 6.1}")), "none");
}

}  // namespace
}  // namespace rodeira::design
