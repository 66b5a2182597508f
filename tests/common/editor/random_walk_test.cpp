// SPDX-License-Identifier: Apache-2.0
// 10 000 drawn actions on a map, undo and redo among them: whatever comes, the document stays a map that the file can
// hold, and all of it can be taken back to the first byte.
#include <gtest/gtest.h>

#include <set>

#include "common/core/base/random.hpp"
#include "common/editor/lane_tools.hpp"
#include "common/editor/templates.hpp"
#include "common/world/traffic_map/companion_text.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

class Walk {
 public:
  explicit Walk(std::uint64_t seed) : seed_(seed), history_(Parsed(traffic_map::GoodMap())) {}

  void Step() {
    switch (Below(24)) {
      case 0:
      case 1:
        Do([&](Document& d) { return NewCurve(d, {Point(), Point(), Point(), Point()}); });
        break;
      case 2:
      case 3:
        Do([&](Document& d) {
          return MoveHandles(d, {{Number(), int(Below(4))}, {Number(), int(Below(4))}}, Point());
        });
        break;
      case 4:
        Do([&](Document& d) { return NewLane(d, AnySide(), AnySide(), AnyMode()); });
        break;
      case 5:
        Do([&](Document& d) { return SetLane(d, {Number(), AnySide(), AnySide(), AnyMode()}); });
        break;
      case 6:
      case 7:
        Do([&](Document& d) { return NewConnection(d, Number(), Number(), Below(2) == 1); });
        break;
      case 8:
        Do([&](Document& d) { return SetStop(d, Number(), Number(), Below(2) == 1); });
        break;
      case 9:
        Do([&](Document& d) { return Remove(d, {{}, {Number()}, {}, {}}); });
        break;
      case 10:
        Do([&](Document& d) { return Remove(d, {{}, {}, {Number()}, {{Number(), Number()}}}); });
        break;
      case 11:
        if (Below(40) == 0) Do([&](Document& d) { return Reset(d); });
        break;
      case 12:
        Do([&](Document& d) { return SetHeights(d, Number(), {0, 0, double(Below(3)), 0}); });
        break;
      case 13:
        Do([&](Document& d) { return SetFlow(d, Number(), double(Below(3)) * 100.0); });
        break;
      case 14:
        Do([&](Document& d) {
          return SetSigns(d, {{Number(), traffic_map::SignKind(Below(4)), 3.0, 50.0, 0},
                              {Number(), traffic_map::SignKind::kStop, 0, 0, 0}});
        });
        break;
      case 15:
        Do([&](Document& d) { return SetLights(d, {AnyLights()}); });
        break;
      case 16:
        Do([&](Document& d) { return SetPicture(d, std::string(Below(9), 'i'), 1.0f + float(Below(5))); });
        break;
      case 17:
        Do([&](Document& d) { return ScaleByDistance(d, Point(), Point(), double(Below(100))); });
        break;
      case 18:
        Do([&](Document& d) {
          return LaneAlong(d, {Point(), Point(), Point(), Point()}, {.width_m = double(Below(8)), .mode = AnyMode()});
        });
        break;
      case 19:
        Do([&](Document& d) { return LaneBeside(d, Number(), Below(2) == 1, Below(2) == 1); });
        break;
      case 20:
        Do([&](Document& d) { return Connect(d, MissingConnections(d)); });
        break;
      case 21:
        if (Below(40) == 0)
          Do([&](Document& d) { return Place(d, Template(Below(3)), {Point(), double(Below(7)), 3.5, 40.0}); });
        break;
      case 22:
        for (auto n = Below(12); n > 0 && history_.CanUndo(); --n) history_.Undo();
        break;
      default:
        for (auto n = Below(12); n > 0 && history_.CanRedo(); --n) history_.Redo();
        break;
    }
  }

  History& history() { return history_; }
  int done() const { return done_; }
  int refused() const { return refused_; }

 private:
  template <class Command>
  void Do(const Command& command) {
    const std::uint64_t before = history_.state();
    const bool ok = history_.Do(command).ok();
    (ok ? done_ : refused_) += 1;
    EXPECT_TRUE(ok || history_.state() == before);
  }
  std::uint64_t Below(std::uint64_t end) { return base::RandomBits({seed_, count_++}) % end; }
  std::int32_t Number() { return static_cast<std::int32_t>(Below(14)); }
  Eigen::Vector2d Point() { return {double(Below(4000)) * 0.05 - 100.0, double(Below(4000)) * 0.05 - 100.0}; }
  traffic_map::LaneSide AnySide() {
    return {Number(), Below(2) == 1, traffic_map::BorderType(Below(traffic_map::kBorderTypes))};
  }
  traffic_map::LaneMode AnyMode() { return traffic_map::LaneMode(Below(3)); }
  lights::LightPlan AnyLights() {
    lights::LightPlan plan;
    for (int i = 0; i < 2; ++i) plan.phases.push_back({{std::to_string(Number())}, 5.0 + double(Below(20)), ""});
    return plan;
  }

  std::uint64_t seed_, count_ = 0;
  History history_;
  int done_ = 0, refused_ = 0;
};

// What must hold of every document that began without faults, whatever was done to it.
void ExpectWhole(const Document& document) {
  std::set<std::int32_t> curves, lanes;
  for (const auto& line : document.map.curves) EXPECT_TRUE(curves.insert(line.value.id).second);
  for (const auto& line : document.map.lanes) {
    EXPECT_TRUE(lanes.insert(line.value.id).second);
    EXPECT_TRUE(curves.contains(line.value.left.curve) && curves.contains(line.value.right.curve));
    EXPECT_NE(line.value.left.curve, line.value.right.curve);
  }
  std::set<std::pair<std::int32_t, std::int32_t>> connections;
  for (const auto& line : document.map.connections) {
    EXPECT_TRUE(connections.insert({line.value.from, line.value.to}).second);
    EXPECT_TRUE(lanes.contains(line.value.from) && lanes.contains(line.value.to) && line.value.from != line.value.to);
  }
  for (const auto& one : document.companion.curves) EXPECT_TRUE(curves.contains(one.curve));
  for (const auto& sign : document.companion.signs) EXPECT_TRUE(lanes.contains(sign.lane));
  for (const auto& flow : document.companion.flows) EXPECT_TRUE(lanes.contains(flow.lane));
  for (const auto& plan : document.companion.lights) {
    for (const std::string& name : plan.Names()) EXPECT_TRUE(lanes.contains(std::stoi(name)));
  }
}

// The files of this document, read again, say the same.
void ExpectReadAgain(const Document& document) {
  const std::string bytes = traffic_map::WriteMap(document.map);
  EXPECT_EQ(bytes.find('i'), bytes.find("\ni\n") + 1) << "where the original program looks for the picture (A.17)";
  const auto map = traffic_map::ParseMap(bytes, "x.motors");
  ASSERT_TRUE(map.ok()) << map.error().Text();
  EXPECT_EQ(traffic_map::WriteMap(map.value()), bytes);
  EXPECT_EQ(map.value().picture, document.map.picture);
  const std::string text = traffic_map::CompanionText(document.companion);
  if (text.empty()) return;
  const auto heights = traffic_map::ParseHeights(text, "x.motors.yaml");
  ASSERT_TRUE(heights.ok()) << heights.error().Text();
  EXPECT_EQ(traffic_map::CompanionText(heights.value()), text);
}

TEST(RandomWalk, TenThousandActionsKeepTheMapWholeAndAreAllUndone) {
  Walk walk(20261122);
  std::size_t most = 0;
  for (int i = 0; i < 10'000 && !testing::Test::HasFailure(); ++i) {
    walk.Step();
    ExpectWhole(walk.history().document());
    most = std::max(most, walk.history().document().map.lanes.size());
    if (i % 50 == 0) ExpectReadAgain(walk.history().document());
  }
  EXPECT_GT(walk.done(), 2000);
  EXPECT_GT(walk.refused(), 1000);
  EXPECT_GT(most, 20u);
  while (walk.history().CanRedo()) walk.history().Redo();
  const std::string last = BytesOf(walk.history().document());
  while (walk.history().CanUndo()) walk.history().Undo();
  EXPECT_EQ(traffic_map::WriteMap(walk.history().document().map), traffic_map::GoodMap());
  EXPECT_EQ(traffic_map::CompanionText(walk.history().document().companion), "");
  while (walk.history().CanRedo()) walk.history().Redo();
  EXPECT_TRUE(BytesOf(walk.history().document()) == last);
}

}  // namespace
}  // namespace rodeira::editor
