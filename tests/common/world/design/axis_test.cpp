// SPDX-License-Identifier: Apache-2.0
// Axes as an author writes them, against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

std::string RoadWith(const std::string& keys) {
  return "rodeira: world/2\nroads:\n  - id: a\n    section: {template: rural}\n" + keys;
}

TEST(Axis, AClothoidByItsParameterIsAsLongAsItsCurvatureChanges) {
  const Design design = SoundDesign(RoadWith(
      "    axis:\n      - clothoid: {a_m: 120, radius_end_m: 300}\n      - arc: {turn_deg: 90, radius_m: 300}\n"));
  const auto& elements = design.network->roads()[0].axis().elements();
  ASSERT_EQ(elements.size(), 2u);
  EXPECT_NEAR(elements[0].length_m, 48.0, 1e-12);  // A^2 / R
  EXPECT_NEAR(elements[1].length_m, 300.0 * std::acos(-1.0) / 2.0, 1e-9);
  EXPECT_NEAR(elements[1].heading_rad, 0.5 * 48.0 / 300.0, 1e-12);
}

TEST(Axis, GapsAreClosedOrRefusedAndJumpsOfCurvatureTold) {
  const std::string start =
      "    axis:\n      - line: {length_m: 100}\n      - arc: {length_m: 50, radius_m: 80}\n        from: {x_m: ";
  const Design closed = SoundDesign(RoadWith(start + "100.02, y_m: 0, heading_deg: 0}\n"));
  ASSERT_EQ(closed.warnings.size(), 2u);
  EXPECT_THAT(closed.warnings[0], HasSubstr("a gap of 0.0200 m and 0.00000 rad at s = 100.000 m is closed"));
  EXPECT_THAT(closed.warnings[1], HasSubstr("the curvature jumps by 0.01250 1/m at s = 100.000 m"));
  EXPECT_THAT(FirstProblem(RoadWith(start + "100.2, y_m: 0, heading_deg: 0}\n")),
              HasSubstr("made.yaml:8: the element begins 0.200 m"));
}

TEST(Axis, TheFirstCuspOfAnEdgeIsNamed) {
  EXPECT_THAT(
      FirstProblem(RoadWith("    axis:\n      - line: {length_m: 40}\n      - arc: {length_m: 12, radius_m: 5.5}\n")),
      HasSubstr("the edge of road 'a' 5.75 m to the left folds at s = 40 m: the bend there has a radius of 5.5 m"));
}

// Points on a circle of 100 m: the spline passes through them and stays near the circle.
TEST(Axis, SmoothedPointsArePassedAndCurvatureDoesNotJump) {
  std::string list;
  for (int i = 0; i <= 12; ++i) {
    const double angle = 0.1 * i;
    list +=
        (i == 0 ? "" : ", ") + ("[" + std::to_string(100.0 * std::sin(angle)) + ", " +
                                std::to_string(100.0 - 100.0 * std::cos(angle)) + ", " + std::to_string(2.0 * i) + "]");
  }
  const Design design = SoundDesign(RoadWith("    points: {list: [" + list + "]}\n"));
  const network::Road& road = design.network->roads()[0];
  const auto& elements = road.axis().elements();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    EXPECT_NEAR(
        (elements[i].start_W - Eigen::Vector2d(100.0 * std::sin(angle), 100.0 - 100.0 * std::cos(angle))).norm(), 0.0,
        1e-5);
    EXPECT_NEAR(road.spec().elevation.Value(elements[i].s_m), 2.0 * static_cast<double>(i), 1e-5);
    if (i == 0) continue;
    const double before = road.axis().Evaluate(elements[i].s_m - 1e-6).curvature_1pm,
                 after = road.axis().Evaluate(elements[i].s_m + 1e-6).curvature_1pm;
    EXPECT_NEAR(before, after, 1e-5);
  }
  for (double s = 30.0; s < 90.0; s += 1.0) {
    EXPECT_NEAR((road.axis().Evaluate(s).p_W - Eigen::Vector2d(0.0, 100.0)).norm(), 100.0, 0.01);
  }
}

TEST(Axis, PointsAsTheyAreKeepTheirStraightsAndComeWithinTheDistanceGiven) {
  const Design design = SoundDesign(
      RoadWith("    points: {list: [[0, 0], [100, 0], [200, 8], [300, 8]], smooth: false, within_m: 0.08}\n"));
  const network::Road& road = design.network->roads()[0];
  EXPECT_NEAR(road.axis().Evaluate(50.0).p_W.y(), 0.0, 1e-12);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(100.0, 0.0), Eigen::Vector2d(200.0, 8.0)}) {
    double nearest = 1e9;
    for (double s = 0.0; s < road.length_m(); s += 0.01)
      nearest = std::min(nearest, (road.axis().Evaluate(s).p_W - corner).norm());
    EXPECT_LE(nearest, 0.0801);
    EXPECT_GT(nearest, 0.05);
  }
  EXPECT_NEAR((road.axis().Evaluate(road.length_m()).p_W - Eigen::Vector2d(300.0, 8.0)).norm(), 0.0, 1e-9);
}

TEST(Axis, ARoadIsPlacedOnAnotherOne) {
  const Design design = SoundDesign(
      "rodeira: world/2\nroads:\n"
      "  - {id: a, start: {x_m: 10, y_m: 20, heading_deg: 30}, axis: [line: {length_m: 500}], z_m: 7, section: "
      "{template: rural}}\n"
      "  - {id: b, place: {road: a, s_m: 200, turn_deg: 60, own_s_m: 80}, axis: [arc: {length_m: 200, radius_m: -90}], "
      "section: {template: rural}}\n");
  const network::Road& b = design.network->roads()[1];
  const geometry::PlanPoint at = b.axis().Evaluate(80.0);
  EXPECT_NEAR(at.p_W.x(), 10.0 + 200.0 * std::cos(std::acos(-1.0) / 6.0), 1e-9);
  EXPECT_NEAR(at.p_W.y(), 20.0 + 200.0 * 0.5, 1e-9);
  EXPECT_NEAR(at.tangent_W.y(), 1.0, 1e-12);
  EXPECT_NEAR(b.spec().elevation.Value(0.0), 7.0, 1e-12);
}

TEST(Axis, WrongNamesAreToldWithTheNearestRightOnes) {
  EXPECT_THAT(FirstProblem(
                  "rodeira: world/2\nroads:\n  - {id: a, axis: [line: {length_m: 90}], section: {template: rurall}}\n"),
              HasSubstr("made.yaml:3: there is no template 'rurall'; did you mean 'rural'?"));
  EXPECT_THAT(FirstProblem(RoadWith("    axis: [line: {length_m: 90}]\n    signs: [{type: stopp, s_m: 3}]\n")),
              HasSubstr("there is no sign 'stopp'; did you mean 'stop'?"));
  EXPECT_THAT(FirstProblem("rodeira: world/2\nmaterials: {worn: {texture: worn.png}}\nroads: []\n"),
              HasSubstr("made.yaml:2: there is no texture file 'worn.png'"));
}

}  // namespace
}  // namespace rodeira::design
