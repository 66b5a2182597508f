// SPDX-License-Identifier: Apache-2.0
// Dashes against a polyline of the line itself.
#include "common/world/network/strokes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::network {
namespace {

Road Bend() {
  std::vector<geometry::PlanElement> elements(3);
  elements[0].length_m = 50.0;
  elements[1].s_m = 50.0, elements[1].length_m = 60.0, elements[1].curvature_end_1pm = 1.0 / 40.0;
  elements[2].s_m = 110.0, elements[2].length_m = 90.0;
  elements[2].curvature_start_1pm = elements[2].curvature_end_1pm = 1.0 / 40.0;
  for (std::size_t i = 1; i < 3; ++i) {
    const geometry::PlanPoint end = geometry::PlanAxis::End(elements[i - 1]);
    elements[i].start_W = end.p_W;
    elements[i].heading_rad = end.heading_rad;
  }
  RoadSpec spec;
  spec.id = "bend";
  spec.length_m = 200.0;
  spec.sections.emplace_back();
  return Road(std::move(spec), *geometry::PlanAxis::Make(elements));
}

// The line's length from one station to another, by chords of a millimetre; one cuts a corner of 0.3 rad short by 1e-5
// m.
double Walked(const Road& road, const PaintedLine& line, double from_s_m, double to_s_m) {
  const auto at = [&](double s) {
    const geometry::PlanPoint axis = road.axis().Evaluate(s);
    return Eigen::Vector2d(axis.p_W + line.t.Value(s) * axis.left_W());
  };
  const int count = static_cast<int>((to_s_m - from_s_m) * 1000.0) + 1;
  double length = 0.0;
  Eigen::Vector2d before = at(from_s_m);
  for (int i = 1; i <= count; ++i) {
    const Eigen::Vector2d here = at(from_s_m + (to_s_m - from_s_m) * i / count);
    length += (here - before).norm();
    before = here;
  }
  return length;
}

TEST(Strokes, AreEquallyLongOnTheLineItself) {
  const Road road = Bend();
  // It lies on the inner side, crosses the axis, and goes on at the outer side.
  const PaintedLine line{
      12.5,
      180.0,
      geometry::CubicTable({{0.0, 6.0, 0.0, 0.0, 0.0}, {60.0, 6.0, -0.3, 0.0, 0.0}, {100.0, -6.0, 0.0, 0.0, 0.0}}),
      0.1,
      3.0,
      5.0,
      "white"};
  const auto strokes = Strokes(road, line);
  ASSERT_GT(strokes.size(), 15u);
  EXPECT_EQ(strokes.front().from_s_m, 12.5);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    EXPECT_LE(strokes[i].to_s_m, 180.0);
    if (i + 1 == strokes.size()) break;
    EXPECT_NEAR(Walked(road, line, strokes[i].from_s_m, strokes[i].to_s_m), 3.0, 2e-5) << i;
    EXPECT_NEAR(Walked(road, line, strokes[i].to_s_m, strokes[i + 1].from_s_m), 5.0, 2e-5) << i;
  }
  const Stroke& last = strokes.back();
  EXPECT_NEAR(Walked(road, line, 12.5, last.from_s_m), 8.0 * static_cast<double>(strokes.size() - 1), 1e-4);
  EXPECT_LT(Walked(road, line, last.from_s_m, 180.0), 8.0);
}

TEST(Strokes, AContinuousLineIsOnePieceWithinTheRoad) {
  const Road road = Bend();
  const PaintedLine line{-5.0, 500.0, {}, 0.1, 0.0, 0.0, "white"};
  const auto strokes = Strokes(road, line);
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].from_s_m, 0.0);
  EXPECT_EQ(strokes[0].to_s_m, 200.0);
  EXPECT_TRUE(Strokes(road, {20.0, 20.0, {}, 0.1, 0.0, 0.0, "white"}).empty());
}

}  // namespace
}  // namespace rodeira::network
