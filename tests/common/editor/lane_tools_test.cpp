// SPDX-License-Identifier: Apache-2.0
// Lanes in one gesture, against what they should be by geometry.
#include "common/editor/lane_tools.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/editor/offset.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(LaneTools, TheCurveBesideAnArcIsTheArcBesideIt) {
  for (const double radius : {8.0, 20.0, 300.0}) {
    for (const double left : {-3.5, -1.5, 2.0, 4.0}) {
      const traffic_map::Cubic arc{CurveBetween({radius, 0.0}, kPi / 2.0, {0.0, radius}, kPi)};
      const traffic_map::Cubic beside = Beside(arc, left);
      for (int i = 0; i <= 100; ++i)
        EXPECT_NEAR(beside.At(i / 100.0).norm(), radius - left, 1e-3 * radius) << radius << " " << left;
      EXPECT_NEAR((beside.p_W[0] - Eigen::Vector2d(radius - left, 0.0)).norm(), 0.0, 1e-12);
    }
  }
}

TEST(LaneTools, TheCurveBesideALineIsTheLineBesideIt) {
  const traffic_map::Cubic line{Straight({1.0, 2.0}, {31.0, 42.0})};
  const Eigen::Vector2d left(-0.8, 0.6);
  for (const double d : {-2.0, 3.5}) {
    for (int i = 0; i < 4; ++i)
      EXPECT_LT((Beside(line, d).p_W[std::size_t(i)] - line.p_W[std::size_t(i)] - d * left).norm(), 1e-12);
  }
}

// Its width by the lane's own shape, at right angles to its middle.
TEST(LaneTools, ALaneAlongABendKeepsItsWidth) {
  History history(EmptyDocument());
  const Points bend = CurveBetween({30.0, 0.0}, kPi / 2.0, {0.0, 30.0}, kPi);
  ASSERT_TRUE(
      history
          .Do([&](Document& d) { return LaneAlong(d, bend, {.width_m = 3.5, .mode = traffic_map::LaneMode::kStart}); })
          .ok());
  const Document& document = history.document();
  ASSERT_EQ(document.map.lanes.size(), 1u);
  const traffic_map::Lane lane = document.map.lanes[0].value;
  const traffic_map::LaneShape shape(traffic_map::BorderOf(lane.left, document.map.curves[0].value, {}),
                                     traffic_map::BorderOf(lane.right, document.map.curves[1].value, {}));
  for (int i = 0; i <= 50; ++i) {
    const traffic_map::LanePoint at = shape.AtParameter(i / 50.0);
    EXPECT_NEAR(at.width_m(), 3.5, 0.01);
    EXPECT_NEAR(at.p_W.norm(), 30.0, 0.03);
  }
}

TEST(LaneTools, LanesBesideShareTheBorderAndTheDrivenDirection) {
  for (const bool on_left : {true, false}) {
    for (const bool same_way : {true, false}) {
      History history(EmptyDocument());
      ASSERT_TRUE(
          history
              .Do([](Document& d) {
                return LaneAlong(d, Straight({0, 0}, {50, 0}), {.width_m = 3.0, .mode = traffic_map::LaneMode::kStart});
              })
              .ok());
      ASSERT_TRUE(history.Do([&](Document& d) { return LaneBeside(d, 1, on_left, same_way); }).ok());
      const Document& document = history.document();
      EXPECT_EQ(document.map.curves.size(), 3u);
      const auto old_borders = BordersOf(document, document.map.lanes[0].value),
                 borders = BordersOf(document, document.map.lanes[1].value);
      ASSERT_TRUE(borders && old_borders);
      const traffic_map::Cubic middle = borders->Middle();
      const Eigen::Vector2d along = middle.p_W[3] - middle.p_W[0];
      EXPECT_NEAR(along.x(), same_way ? 50.0 : -50.0, 1e-4);
      EXPECT_NEAR(middle.p_W[0].y(), on_left ? 3.0 : -3.0, 1e-5);
      const Eigen::Vector2d across = borders->left.p_W[0] - borders->right.p_W[0];
      EXPECT_GT(along.x() * across.y(), 0.0) << "the left border lies on the left";
      EXPECT_EQ(document.map.lanes[1].value.mode,
                same_way ? traffic_map::LaneMode::kStart : traffic_map::LaneMode::kEnd);
      for (const traffic_map::Finding& finding : traffic_map::CheckMap(document.map, document.companion))
        EXPECT_EQ(finding.sentence.find("border"), std::string::npos) << finding.Text();
    }
  }
}

TEST(LaneTools, ConnectionsAreProposedWhereEndsMeet) {
  Document document = Parsed(traffic_map::GoodMap());
  EXPECT_TRUE(MissingConnections(document).empty());
  document.map.connections.clear();
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
  EXPECT_EQ(MissingConnections(document), (Pairs{{1, 2}, {1, 3}}));
  EXPECT_EQ(MissingConnections(document, 3), (Pairs{{1, 3}}));
  document.map.curves[2].value.points[3].x_m += 1.0f;  // the left border of lane 2 begins 1 m later: its middle 0.5 m
  EXPECT_EQ(MissingConnections(document), (Pairs{{1, 3}}));
  History history(std::move(document));
  ExpectUndone(history, [](Document& d) { return Connect(d, MissingConnections(d)); });
  EXPECT_EQ(history.Last(), "connection 1 to 3 made");
  ExpectRefused(
      history, [](Document& d) { return Connect(d, MissingConnections(d)); }, "no two lanes meet");
}

}  // namespace
}  // namespace rodeira::editor
