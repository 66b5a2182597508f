// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the traffic: vehicles that exist, and are on the road where that is needed; rates, times and
// speeds above 0.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/results/lane_statistics.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

// Two vehicles that wait for a place: none is on the road.
TrafficModel Waiting() {
  auto model = TrafficModel::Make(OnlyScripted({kCar, kCar}), lanes::MapNetwork("overpass"), {});
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return std::move(model).value();
}

TEST(ContractsDeathTest, ATrafficIsOfAWorldOrANetwork) {
  EXPECT_DEATH((void)TrafficModel::Make({}, std::shared_ptr<const road::World>(), {}), "world != nullptr");
  EXPECT_DEATH((void)TrafficModel::Make({}, std::shared_ptr<const network::Network>(), {}), "network != nullptr");
}

TEST(ContractsDeathTest, AStepIsLongerThanNothing) {
  TrafficModel model = Waiting();
  for (const double dt_s : {0.0, -0.02}) EXPECT_DEATH(model.Step(dt_s, {}), "simulation.cpp.*dt_s > 0.0");
  model.Step(kStep_s, {});
}

TEST(ContractsDeathTest, ACommandIsForAVehicleThatExists) {
  TrafficModel model = Waiting();
  const auto none = static_cast<std::uint32_t>(model.vehicles());
  ASSERT_EQ(none, 2U);
  model.Release(none - 1);
  EXPECT_DEATH(model.Brake(none, 2.0), "agents.size\\(\\) && deceleration_mps2 > 0.0");
  EXPECT_DEATH(model.CapSpeed(none, 2.0), "agents.size\\(\\) && speed_mps > 0.0");
  EXPECT_DEATH(model.HoldSpeed(none, 2.0), "agents.size\\(\\) && speed_mps > 0.0");
  EXPECT_DEATH(model.Release(none), "traffic_commands.cpp.*agents.size\\(\\)\n");
  EXPECT_DEATH(model.CommandOvertake(none), "traffic_commands.cpp.*agents.size\\(\\)\n");
  EXPECT_DEATH(model.CommandLaneChange(none, 1), "agents.size\\(\\) && \\(side == 1");
  EXPECT_DEATH(model.Strike(none, {1.0, 0.0}, {0.0, 0.0}), "out_.agents.size\\(\\)");
  EXPECT_DEATH((void)model.Remove(none), "traffic_control.cpp.*simulation.store.agents.size\\(\\)\n");
}

TEST(ContractsDeathTest, ACommandHasAValueThatCanBeObeyed) {
  TrafficModel model = Waiting();
  EXPECT_DEATH(model.Brake(0, 0.0), "deceleration_mps2 > 0.0");
  EXPECT_DEATH(model.CapSpeed(0, 0.0), "agents.size\\(\\) && speed_mps > 0.0");
  EXPECT_DEATH(model.CommandLaneChange(0, 0), "side == 1 \\|\\| side == -1");
  EXPECT_DEATH((void)model.Spawn(0, "1:-1", 10.0, -0.1), "speed_mps >= 0.0");
  const std::string controller;
  EXPECT_DEATH((void)model.HoldLight(controller, network::LightColour::kAmber, 5.0), "LightColour::kGreen");
  EXPECT_DEATH((void)model.HoldLight(controller, network::LightColour::kRed, -1.0), "duration_s >= 0.0");
  EXPECT_FALSE(model.HoldLight(controller, network::LightColour::kRed, 5.0).ok()) << "no controller has this name";
}

TEST(ContractsDeathTest, ARouteIsOfAVehicleOnTheRoad) {
  TrafficModel model = Waiting();
  ASSERT_FALSE(model.agent(0).on_road);
  for (const std::uint32_t id : {0U, 2U}) {
    EXPECT_DEATH((void)model.SetRoute(id, {}), "traffic_control.cpp.*agents\\[id\\].on_road");
    EXPECT_DEATH((void)model.RoadsAhead(id), "traffic_control.cpp.*agents\\[id\\].on_road");
  }
}

TEST(ContractsDeathTest, AStatisticHasCellsABodyIsKnownAndAPathHasPieces) {
  const TrafficModel model = Waiting();
  EXPECT_DEATH(LaneStatistics(model, 0.0), "cell_m > 0.0");
  EXPECT_GT(TraitsOfBody(kBodies - 1).length_m, 0.0);
  EXPECT_DEATH((void)TraitsOfBody(kBodies), "agent_traits.cpp.*false");
  EXPECT_DEATH((void)PieceAt(Path(), 0.0), "!path.empty\\(\\)");
}

}  // namespace
}  // namespace rodeira::traffic
