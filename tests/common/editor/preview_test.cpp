// SPDX-License-Identifier: Apache-2.0
// Traffic in the editor is the traffic of `rodeira traffic run`.
#include <string>

#include "common/editor/preview.hpp"

#include <gtest/gtest.h>

#include "common/editor/commands.hpp"
#include "common/editor/templates.hpp"
#include "common/traffic/demand/arrivals.hpp"
#include "common/world/lanes/signs.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/common/editor/drawing.hpp"

namespace rodeira::editor {
namespace {

TEST(Preview, ItIsTheModelWhateverTheFramesAre) {
  History history(EmptyDocument());
  ASSERT_TRUE(history.Do([](Document& d) { return Place(d, Template::kRoundabout, {}); }).ok());
  auto preview = Preview::Start(history.document(), {12, 7});
  ASSERT_TRUE(preview.ok()) << preview.error().Text();
  for (int i = 0; i < 300; ++i) preview.value().Run(0.033);
  for (int i = 0; i < 100; ++i) preview.value().Run(0.001);
  const auto lanes = traffic_map::MakeLaneMap(history.document().map, history.document().companion, "map");
  traffic::TrafficSettings settings;
  settings.vehicles = 12;
  settings.seed = 7;
  auto model = traffic::TrafficModel::Make(settings, traffic_map::ToNetwork(lanes.value(), "map").value(), {});
  ASSERT_TRUE(model.ok());
  const auto steps = static_cast<int>(std::lround(preview.value().time_s() / Preview::kStep_s));
  EXPECT_NEAR(preview.value().time_s(), 10.0, 0.011);
  for (int i = 0; i < steps; ++i) model.value().Step(Preview::kStep_s, {});
  ASSERT_EQ(preview.value().model().poses().size(), model.value().poses().size());
  for (std::size_t i = 0; i < model.value().poses().size(); ++i)
    EXPECT_EQ(preview.value().model().poses()[i].p_WB_W, model.value().poses()[i].p_WB_W);
}

TEST(Preview, HeatLiesWhereVehiclesDrove) {
  History history(Parsed(traffic_map::GoodMap()));
  auto preview = Preview::Start(history.document(), {2, 1});
  ASSERT_TRUE(preview.ok()) << preview.error().Text();
  EXPECT_TRUE(preview.value().Heat().empty());
  preview.value().Run(20.0);
  const auto heat = preview.value().Heat();
  EXPECT_GT(heat.size(), 20u);
  for (const HeatPatch& patch : heat) {
    EXPECT_GT(patch.share, 0.0);
    EXPECT_LE(patch.share, 1.0);
    EXPECT_NEAR(patch.length_m, 1.0, 0.1);
    EXPECT_GT(patch.p_W.x(), -1.0);
    EXPECT_LT(patch.p_W.x(), 61.0);
  }
}

// Signs of the companion, as traffic reads them from the roads that the map becomes.
TEST(Preview, SignsAreObeyed) {
  Document document = Parsed(traffic_map::GoodMap(),
                             "rodeira: motors/1\nsigns:\n  - {lane: 1, kind: give_way}\n  - {lane: 2, kind: "
                             "speed_limit, limit_kmh: 18, before_end_m: 20}\n  - {lane: 3, kind: priority}\n");
  document.map.connections[1].value.stop = false;
  const auto preview = Preview::Start(document, {2, 1});
  ASSERT_TRUE(preview.ok()) << preview.error().Text();
  const lanes::Graph& graph = preview.value().model().graph();
  ASSERT_EQ(graph.tracks().size(), 3u);
  for (std::uint32_t track = 0; track < 3; ++track) {
    const std::string& id = graph.network().roads()[graph[track].lane.road].spec().id;
    const double end_m = graph[track].length_m();
    const lanes::Sign sign = lanes::SignFor(graph, track, end_m);
    if (id == "1") {
      EXPECT_EQ(sign, lanes::Sign::kGiveWay);
    } else if (id == "3") {
      EXPECT_EQ(sign, lanes::Sign::kPriority);
    } else {
      EXPECT_GT(graph.SpeedLimit_mps(track, end_m - 20.5), 10.0);
      EXPECT_NEAR(graph.SpeedLimit_mps(track, end_m - 19.5), 5.0, 1e-9);
    }
  }
}

// No vehicle is there before one has arrived, and the arrivals are those of the flow's own law.
TEST(Preview, FlowsOfStartLanesBringTheVehicles) {
  const Document document = Parsed(traffic_map::GoodMap(), "rodeira: motors/1\nflows_vehph: {1: 600}\n");
  auto preview = Preview::Start(document, {20, 5});
  ASSERT_TRUE(preview.ok()) << preview.error().Text();
  traffic::FlowSettings flow;
  flow.per_h = {600.0};
  std::uint64_t arrived = 0;
  std::int64_t next_ns = traffic::NextArrival_ns(flow, 5, 0, 0, 0);
  for (int second = 0; second <= 60; ++second) {
    ASSERT_EQ(preview.value().model().flows().size(), 1u);
    for (; next_ns < std::llround(preview.value().time_s() * 1e9);
         next_ns = traffic::NextArrival_ns(flow, 5, 0, arrived, next_ns))
      ++arrived;
    EXPECT_EQ(preview.value().model().flows()[0].arrived, arrived) << second;
    if (arrived == 0) {
      EXPECT_TRUE(preview.value().model().poses().empty()) << second;
    }
    preview.value().Run(1.0);
  }
  EXPECT_GT(arrived, 3u);
}

TEST(Preview, AFaultyMapIsRefusedWithTheFault) {
  Document document = Parsed(traffic_map::GoodMap());
  document.map.lanes[0].value.mode = traffic_map::LaneMode::kNone;
  const auto preview = Preview::Start(document, {});
  ASSERT_FALSE(preview.ok());
  EXPECT_NE(preview.error().Text().find("no lane is a start lane"), std::string::npos) << preview.error().Text();
}

}  // namespace
}  // namespace rodeira::editor
