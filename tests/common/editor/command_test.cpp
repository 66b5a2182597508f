// SPDX-License-Identifier: Apache-2.0
// Each action of a person: what it does to the file, that undo gives the same bytes again, and what is refused.
#include <gtest/gtest.h>

#include "common/editor/lane_tools.hpp"
#include "common/editor/templates.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

const std::string kBeside =
    "rodeira: motors/1\nheights_m:\n  1: [0, 0, 1, 1]\nlights:\n  - phases:\n      - {green: [1], for_s: 20}\n      - "
    "{green: [2, 3], for_s: 10}\n"
    "signs:\n  - {lane: 2, kind: give_way}\nflows_vehph:\n  1: 300\n";

History Good() { return History(Parsed(traffic_map::GoodMap(), kBeside)); }

TEST(Command, TheThesisExampleGivesTheFileThatItDescribes) {
  History history(EmptyDocument());
  // Two parallel curves, numbered by themselves; a start lane between them with the number 1 (figures 12 to 14).
  ExpectUndone(history, [](Document& d) { return NewCurve(d, Straight({0, 3}, {40, 3})); });
  ExpectUndone(history, [](Document& d) { return NewCurve(d, Straight({0, 0}, {40, 0})); });
  ExpectUndone(history, [](Document& d) {
    return NewLane(d, Side(1), Side(2, false, traffic_map::BorderType::kDashedSame), traffic_map::LaneMode::kStart);
  });
  ExpectUndone(history, [](Document& d) { return NewCurve(d, Straight({40, 3}, {80, 3})); });
  ExpectUndone(history, [](Document& d) { return NewCurve(d, Straight({80, 0}, {40, 0})); });
  ExpectUndone(history, [](Document& d) { return NewLane(d, Side(3), Side(4, true), traffic_map::LaneMode::kEnd); });
  ExpectUndone(history, [](Document& d) { return NewConnection(d, 1, 2, true); });
  ExpectUndone(history, [](Document& d) { return SetPicture(d, traffic_map::kPng2x1, 7.5f); });
  EXPECT_EQ(traffic_map::WriteMap(history.document().map),
            "p,1,0,14.70026,3,13.333333,14.70026,3,26.666666,14.70026,3,40,14.70026,3\n"
            "p,2,0,14.70026,0,13.333333,14.70026,0,26.666666,14.70026,0,40,14.70026,0\n"
            "p,3,40,14.70026,3,53.333332,14.70026,3,66.666664,14.70026,3,80,14.70026,3\n"
            "p,4,80,14.70026,0,66.666664,14.70026,0,53.333332,14.70026,0,40,14.70026,0\n"
            "l,1,1,False,1,2,False,4,1\nl,2,3,False,1,4,True,1,2\nc,1,2,True,0,0,0\ns,7.5\ni\n" +
                traffic_map::kPng2x1);
  for (const traffic_map::Finding& finding :
       traffic_map::CheckMap(history.document().map, history.document().companion))
    EXPECT_NE(finding.severity, traffic_map::Severity::kError) << finding.Text();
  while (history.CanUndo()) history.Undo();
  EXPECT_EQ(traffic_map::WriteMap(history.document().map), "s,10\ni\n");
  ExpectRefused(
      history, [](Document& d) { return NewLane(d, Side(5), Side(6), traffic_map::LaneMode::kNone); },
      "no lane was made: the left curve 5 does not exist");  // figure 16
}

TEST(Command, EveryOneIsUndoneToTheByte) {
  History history = Good();
  ExpectUndone(history, [](Document& d) { return MoveHandles(d, {{3, 3}, {1, 3}, {3, 0}}, {0.25, -1.5}); });
  ExpectUndone(history, [](Document& d) {
    return SetLane(d, {2, Side(3, true), Side(4), traffic_map::LaneMode::kNone});
  });
  ExpectUndone(history, [](Document& d) { return SetStop(d, 1, 2, true); });
  ExpectUndone(history, [](Document& d) { return SetScale(d, 12.5f); });
  ExpectUndone(history, [](Document& d) { return SetPicture(d, "", 3.0f); });
  ExpectUndone(history, [](Document& d) { return ScaleByDistance(d, {0, 0}, {3, 4}, 20.0); });
  EXPECT_EQ(history.document().map.scale.value.value, 12.0f);
  ExpectUndone(history, [](Document& d) { return SetHeights(d, 2, {1, 2, 3, 4.5}); });
  ExpectUndone(history, [](Document& d) { return SetHeights(d, 1, {}); });
  ExpectUndone(history, [](Document& d) {
    return SetSigns(d, {{3, traffic_map::SignKind::kSpeedLimit, 5.0, 30.0, 0}});
  });
  ExpectUndone(history, [](Document& d) { return SetFlow(d, 1, 720.0); });
  ExpectUndone(history, [](Document& d) { return SetFlow(d, 1, 0.0); });
  ExpectUndone(history, [](Document& d) { return SetLights(d, {}); });
  ExpectUndone(history, [](Document& d) { return LaneAlong(d, Straight({0, 50}, {60, 50}), {}); });
  ExpectUndone(history, [](Document& d) { return LaneBeside(d, 1, true, false); });
  ExpectUndone(history, [](Document& d) { return LaneBeside(d, 1, false, true); });
  ExpectUndone(history, [](Document& d) { return Place(d, Template::kRoundabout, {}); });
  ExpectUndone(history, [](Document& d) { return Remove(d, {{}, {5}, {2}, {}}); });
  ExpectUndone(history, [](Document& d) { return Reset(d); });
  EXPECT_TRUE(history.document().map.curves.empty());
  while (history.CanUndo()) history.Undo();
  EXPECT_EQ(BytesOf(history.document()), BytesOf(Good().document()));
  EXPECT_EQ(traffic_map::WriteMap(history.document().map), traffic_map::GoodMap());
}

TEST(Command, ADeletedElementTakesAlongWhatHangsOnIt) {
  History history = Good();
  ASSERT_TRUE(history.Do([](Document& d) { return Remove(d, {{}, {3}, {}, {}}); }).ok());  // the left border of lane 2
  const Document& document = history.document();
  EXPECT_FALSE(Find(document.map.lanes, 2));
  EXPECT_FALSE(Find(document.map.connections, 1, 2));
  EXPECT_TRUE(Find(document.map.connections, 1, 3));
  EXPECT_TRUE(document.companion.signs.empty());
  EXPECT_EQ(document.companion.lights.at(0).phases.at(1).green, std::vector<std::string>{"3"});
  EXPECT_EQ(document.companion.curves.size(), 1u);
  EXPECT_EQ(history.Last(), "deleted: 1 curves, 1 lanes, 1 connections");
  ASSERT_TRUE(history.Do([](Document& d) { return Remove(d, {{}, {}, {}, {{1, 3}}}); }).ok());
  EXPECT_EQ(history.Last(), "connection 1 to 3 deleted");
}

TEST(Command, WhatCannotBeIsRefusedWithASentence) {
  History history = Good();
  ExpectRefused(
      history, [](Document& d) { return NewLane(d, Side(1), Side(1), traffic_map::LaneMode::kNone); },
      "curve 1 is on both sides");
  ExpectRefused(
      history,
      [](Document& d) {
        return SetLane(d, {9, Side(1), Side(2), traffic_map::LaneMode::kNone});
      },
      "lane 9 does not exist");
  ExpectRefused(
      history, [](Document& d) { return NewConnection(d, 1, 9, false); }, "lane 9 does not exist");
  ExpectRefused(
      history, [](Document& d) { return NewConnection(d, 1, 1, false); }, "back into it");
  ExpectRefused(
      history, [](Document& d) { return NewConnection(d, 1, 2, true); }, "connected to lane 2 already");
  ExpectRefused(
      history, [](Document& d) { return SetStop(d, 2, 1, true); }, "lane 2 is not connected to lane 1");
  ExpectRefused(
      history,
      [](Document& d) {
        return NewCurve(d, Straight({0, 0}, {2e6, 0}));
      },
      "farther out than 1 000 000 m");
  ExpectRefused(
      history,
      [](Document& d) {
        return MoveHandles(d, {{1, 0}, {2, 0}}, {0, 1e6});
      },
      "farther out");
  ExpectRefused(
      history,
      [](Document& d) {
        return MoveHandles(d, {{77, 0}}, {0, 1});
      },
      "curve 77 does not exist");
  ExpectRefused(
      history, [](Document& d) { return SetScale(d, 0.0f); }, "the scale is 0");
  ExpectRefused(
      history,
      [](Document& d) {
        return ScaleByDistance(d, {1, 1}, {1, 1}, 5.0);
      },
      "coincide");
  ExpectRefused(
      history,
      [](Document& d) {
        return ScaleByDistance(d, {1, 1}, {2, 1}, -5.0);
      },
      "one above 0");
  ExpectRefused(
      history, [](Document& d) { return Remove(d, {}); }, "nothing is selected");
  ExpectRefused(
      history, [](Document& d) { return SetFlow(d, 2, 5.0); }, "no start lane");
  ExpectRefused(
      history, [](Document& d) { return SetFlow(d, 1, -5.0); }, "the flow is -5");
  ExpectRefused(
      history,
      [](Document& d) {
        return SetHeights(d, 1, {0, 0, 0, 1e5});
      },
      "the height is 100000 m");
  ExpectRefused(
      history,
      [](Document& d) {
        return SetSigns(d, {{9, traffic_map::SignKind::kStop, 0, 0, 0}});
      },
      "lane 9 does not exist");
  ExpectRefused(
      history,
      [](Document& d) {
        return SetSigns(d, {{1, traffic_map::SignKind::kSpeedLimit, 0, 0, 0}});
      },
      "the limit is 0 km/h");
  ExpectRefused(
      history, [](Document& d) { return SetLights(d, {lights::LightPlan{}}); }, "without a phase");
  ExpectRefused(
      history,
      [](Document& d) {
        return LaneAlong(d, Straight({0, 0}, {9, 0}), {.width_m = 0.1});
      },
      "the lane is 0.1 m wide");
  ExpectRefused(
      history,
      [](Document& d) {
        return LaneAlong(d, Straight({0, 0}, {0, 0}), {});
      },
      "has no length");
  ExpectRefused(
      history, [](Document& d) { return Place(d, Template::kMerge, {.arm_m = 5.0}); }, "arms of 5 m");
}

// The gesture of dragging: many moves, one undo.
TEST(Command, AGestureIsOneStepBack) {
  History history = Good();
  const std::string before = BytesOf(history.document());
  ASSERT_TRUE(history.Do([](Document& d) { return MoveHandles(d, {{1, 0}}, {1, 0}); }).ok());
  for (int i = 2; i <= 50; ++i)
    ASSERT_TRUE(history.Again([i](Document& d) { return MoveHandles(d, {{1, 0}}, {double(i), 0}); }).ok());
  EXPECT_FALSE(history.Again([](Document& d) { return MoveHandles(d, {{1, 0}}, {1e9, 0}); }).ok());
  EXPECT_EQ(history.document().map.curves[0].value.points[0].x_m, 50.0f);
  history.Undo();
  EXPECT_EQ(BytesOf(history.document()), before);
  EXPECT_FALSE(history.CanUndo());
}

// A new action after undo: what was undone is gone for good; states tell documents apart.
TEST(Command, StatesAreNumbered) {
  History history = Good();
  const auto first = history.state();
  ASSERT_TRUE(history.Do([](Document& d) { return SetScale(d, 2.0f); }).ok());
  const auto second = history.state();
  EXPECT_NE(second, first);
  history.Undo();
  EXPECT_EQ(history.state(), first);
  history.Redo();
  EXPECT_EQ(history.state(), second);
  history.Undo();
  ASSERT_TRUE(history.Do([](Document& d) { return SetScale(d, 3.0f); }).ok());
  EXPECT_NE(history.state(), second);
  EXPECT_FALSE(history.CanRedo());
  ASSERT_TRUE(history.Do([](Document& d) { return SetScale(d, 3.0f); }).ok());  // nothing changes: nothing to undo
  EXPECT_EQ(history.document().map.scale.value.value, 3.0f);
  history.Undo();
  EXPECT_EQ(history.state(), first);
}

}  // namespace
}  // namespace rodeira::editor
