// SPDX-License-Identifier: Apache-2.0
// What is chosen by pointing, by a rectangle, by a finding of the check; where dragged handles come to rest.
#include "common/editor/selection.hpp"

#include <gtest/gtest.h>

#include "common/editor/snap.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

// Two lanes one behind the other from x = 0 to 60, a turn to the left from (30, 0); sample_map.hpp.
Document Good() { return Parsed(traffic_map::GoodMap()); }

TEST(Selection, WhatIsUnderThePointer) {
  const Document document = Good();
  EXPECT_EQ(HandleAt(document, {10.2, 1.4}, 0.5), (Handle{1, 1}));
  EXPECT_EQ(HandleAt(document, {15.0, 0.0}, 0.5), std::nullopt);
  EXPECT_EQ(CurveAt(document, {17.3, -1.4}, 0.3), 2);
  EXPECT_EQ(CurveAt(document, {17.3, 0.0}, 0.3), std::nullopt);
  EXPECT_EQ(LaneAt(document, {15.0, 0.0}), 1);
  EXPECT_EQ(LaneAt(document, {50.0, 0.0}), 2);
  EXPECT_EQ(LaneAt(document, {40.0, 9.0}), 3);
  EXPECT_EQ(LaneAt(document, {15.0, 5.0}), std::nullopt);
}

TEST(Selection, ARectangleTakesWhatLiesInItWhole) {
  const Document document = Good();
  const Selection first = Inside(document, {31.0, -2.0}, {-1.0, 2.0});
  EXPECT_EQ(first.curves, (std::set<std::int32_t>{1, 2}));
  EXPECT_EQ(first.lanes, std::set<std::int32_t>{1});
  EXPECT_TRUE(first.connections.empty());
  EXPECT_TRUE(first.handles.contains({3, 3}));  // the end of another curve
  const Selection all = Inside(document, {-5.0, -5.0}, {65.0, 15.0});
  EXPECT_EQ(all.lanes.size(), 3u);
  EXPECT_EQ(all.connections.size(), 2u);
  EXPECT_EQ(HandlesOf(document, all).size(), 24u);
  EXPECT_TRUE(Inside(document, {100.0, 100.0}, {101.0, 101.0}).empty());
}

TEST(Selection, AFindingChoosesItsElement) {
  Document document = Good();
  document.map.lanes[1].value.left.curve = 77;
  document.map.connections.push_back({{3, 99, false, {}}, "", 0});
  bool lane = false, connection = false;
  for (const traffic_map::Finding& finding : traffic_map::CheckMap(document.map, document.companion)) {
    const Selection chosen = Chosen(finding);
    if (finding.sentence == "its left curve 77 does not exist") lane = chosen.lanes == std::set<std::int32_t>{2};
    if (finding.sentence == "lane 99 does not exist") connection = chosen.connections.contains({3, 99});
  }
  EXPECT_TRUE(lane);
  EXPECT_TRUE(connection);
  const auto middle = MiddleOf(document, {{}, {}, {1}, {}});
  ASSERT_TRUE(middle);
  EXPECT_EQ(*middle, Eigen::Vector2d(15.0, 0.0));
  EXPECT_FALSE(MiddleOf(document, {{}, {77}, {}, {}}));
}

TEST(Snap, EndsGoToEndsAndHandlesToTangents) {
  const Document document = Good();
  EXPECT_EQ(Snap(document, {6, 0}, {6}, {30.4, -1.3}, 0.5).p_W, Eigen::Vector2d(30.0, -1.5));
  EXPECT_TRUE(Snap(document, {6, 0}, {6}, {30.4, -1.3}, 0.5).caught);
  EXPECT_FALSE(Snap(document, {6, 0}, {6}, {31.4, -1.3}, 0.5).caught);
  EXPECT_EQ(Snap(document, {6, 0}, {6}, {31.4, -1.3}, 0.5).p_W, Eigen::Vector2d(31.4, -1.3));
  // Curve 5 begins where curve 1 ends, at (30, 1.5), eastward: its first handle stays on that line.
  const Snapped smooth = Snap(document, {5, 1}, {5}, {36.0, 1.9}, 0.5);
  EXPECT_TRUE(smooth.caught);
  EXPECT_NEAR((smooth.p_W - Eigen::Vector2d(36.0, 1.5)).norm(), 0.0, 1e-12);
  EXPECT_FALSE(Snap(document, {5, 1}, {5}, {36.0, 2.9}, 0.5).caught);
  EXPECT_FALSE(Snap(document, {5, 2}, {5}, {38.0, 9.0}, 0.5).caught) << "nothing goes on from its end";
}

TEST(Selection, JoinedEndsAreFoundTogether) {
  EXPECT_EQ(HandlesTogether(Good(), {30.0, 1.5}), (std::vector<Handle>{{1, 3}, {3, 3}, {5, 0}}));
}

}  // namespace
}  // namespace rodeira::editor
