// SPDX-License-Identifier: Apache-2.0
// What agents are told when they come to a place.
#include "common/traffic/place_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.01, kPlace_m = 700.0;

TrafficModel Made(std::uint32_t vehicles) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = 4;
  settings.overtaking.allowed = false;
  return TrafficModel::Make(settings, driver::StraightWorld(2000.0, 20.0), {}).value();
}

PlaceOrder Brake(const TrafficModel& model, PlaceOrder::Recipients recipients, std::uint32_t id = 0,
                 double s_m = kPlace_m) {
  PlaceOrder order = PlaceOrders::At(model, "test", s_m).value();
  order.value = 3.0;
  order.recipients = recipients;
  order.id = id;
  return order;
}

// The stations of all cars, by the world's own axis, which lies at 0.3 rad.
std::map<std::uint32_t, double> Stations(const TrafficModel& model) {
  std::map<std::uint32_t, double> stations;
  for (const AgentPose& pose : model.poses())
    stations[pose.id] = pose.p_WB_W.x() * std::cos(0.3) + pose.p_WB_W.y() * std::sin(0.3);
  return stations;
}

// Drives until a time, and says which passed the place when: those that are on the road in one trip before and after.
std::vector<std::pair<int, std::uint32_t>> Drive(TrafficModel& model, PlaceOrders& orders, int steps,
                                                 const std::function<void(int)>& look = {}) {
  std::vector<std::pair<int, std::uint32_t>> passed;
  for (int i = 0; i < steps; ++i) {
    const auto before = Stations(model);
    std::map<std::uint32_t, std::uint32_t> trips;
    for (const AgentPose& pose : model.poses()) trips[pose.id] = pose.trip;
    orders.Before(model);
    model.Step(kStep_s, {});
    orders.After(model);
    for (const auto& [id, s] : Stations(model)) {
      if (before.contains(id) && trips.at(id) == model.agent(id).trip && (before.at(id) < kPlace_m) != (s < kPlace_m))
        passed.emplace_back(i, id);
    }
    if (look) look(i);
  }
  return passed;
}

// The first to pass, in either direction, brakes at exactly the rate from there to rest; the others are not told.
TEST(PlaceOrders, TheNextOneBrakesWhereItPasses) {
  TrafficModel model = Made(30);
  PlaceOrders orders;
  orders.Add(Brake(model, PlaceOrder::Recipients::kNext));
  std::set<std::uint32_t> told;
  const auto passed = Drive(model, orders, 4000, [&](int) {
    for (std::uint32_t id = 0; id < model.vehicles(); ++id) {
      if (model.agent(id).brake_mps2 > 0.0) told.insert(id);
    }
  });
  ASSERT_GT(passed.size(), 2u);
  EXPECT_EQ(told, std::set<std::uint32_t>{passed.front().second});
  const std::uint32_t id = passed.front().second;
  EXPECT_EQ(model.agent(id).speed_mps, 0.0);
  // The way from the place to rest is v²/(2 a), and what is left of a step.
  TrafficModel again = Made(30);
  PlaceOrders none;
  (void)Drive(again, none, passed.front().first + 1);
  const double v = again.agent(id).speed_mps, s = Stations(again).at(id);
  EXPECT_NEAR(std::fabs(Stations(model).at(id) - s), v * v / 6.0, 0.01);
  EXPECT_NEAR(s, kPlace_m, v * kStep_s);
}

TEST(PlaceOrders, OneAgentIsToldWhenItPassesAndAllAreToldEachTime) {
  TrafficModel calm = Made(30);
  PlaceOrders none;
  const auto passed = Drive(calm, none, 6000);
  ASSERT_GT(passed.size(), 6u);
  TrafficModel model = Made(30);
  PlaceOrders orders;
  PlaceOrder slow = Brake(model, PlaceOrder::Recipients::kOne, passed[3].second);
  slow.kind = OrderKind::kSpeed;
  slow.value = 5.0;
  orders.Add(slow);
  (void)Drive(model, orders, passed[3].first);
  EXPECT_EQ(model.agent(passed[3].second).cap_mps, Agent::kNoCap_mps);
  (void)Drive(model, orders, 1);
  for (std::uint32_t id = 0; id < model.vehicles(); ++id)
    EXPECT_EQ(model.agent(id).cap_mps, id == passed[3].second ? 5.0 : Agent::kNoCap_mps) << id;
  TrafficModel many = Made(30);
  PlaceOrders all;
  PlaceOrder each = Brake(many, PlaceOrder::Recipients::kAll);
  each.kind = OrderKind::kSpeed;
  each.value = 15.0;
  all.Add(each);
  const auto slowed = Drive(many, all, 6000);
  std::set<std::uint32_t> passers, capped;
  for (const auto& [step, id] : slowed) passers.insert(id);
  for (std::uint32_t id = 0; id < many.vehicles(); ++id) {
    if (many.agent(id).cap_mps < Agent::kNoCap_mps) capped.insert(id);
  }
  EXPECT_TRUE(std::includes(passers.begin(), passers.end(), capped.begin(), capped.end()));
  EXPECT_GT(capped.size(), 6u);
}

// A place at the very end of a short road, where cars are on the next one within a step, is passed as any other.
TEST(PlaceOrders, APlaceWhereARoadEndsIsPassedToo) {
  TrafficSettings settings;
  settings.vehicles = 30;
  const auto network = lanes::MapNetwork("crossing");
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  std::map<std::string, int> told, gone;
  PlaceOrders orders;
  for (const network::Road& road : network->roads()) {
    for (const double s : {0.0, road.length_m()}) {
      PlaceOrder order = PlaceOrders::At(model, road.id(), s == 0.0 ? 1e-9 : s - 1e-9).value();
      order.kind = OrderKind::kSpeed;
      order.value = 8.0 + (s == 0.0 ? 0.25 : 0.5);
      order.recipients = PlaceOrder::Recipients::kAll;
      orders.Add(order);
    }
  }
  std::map<std::uint32_t, std::pair<std::uint32_t, std::int32_t>> before;
  int changes = 0, capped = 0;
  for (int i = 0; i < 6000; ++i) {
    for (const AgentPose& pose : model.poses()) before[pose.id] = {pose.trip, pose.road};
    for (std::uint32_t id = 0; id < model.vehicles(); ++id) model.Release(id);
    orders.Before(model);
    model.Step(kStep_s, {});
    orders.After(model);
    for (const AgentPose& pose : model.poses()) {
      if (!before.contains(pose.id) || before.at(pose.id).first != pose.trip || before.at(pose.id).second == pose.road)
        continue;
      ++changes;
      capped += model.agent(pose.id).cap_mps < Agent::kNoCap_mps ? 1 : 0;
    }
  }
  EXPECT_GT(changes, 30);
  EXPECT_EQ(capped, changes);
}

TEST(PlaceOrders, RestoredTheyAreObeyedAtTheSameSteps) {
  for (const int at : {0, 500, 1700}) {
    TrafficModel model = Made(20), other = Made(20);
    PlaceOrders orders, restored;
    orders.Add(Brake(model, PlaceOrder::Recipients::kNext));
    orders.Add(Brake(model, PlaceOrder::Recipients::kOne, 7, 900.0));
    PlaceOrder slow = Brake(model, PlaceOrder::Recipients::kAll, 0, 1200.0);
    slow.kind = OrderKind::kSpeed;
    orders.Add(slow);
    (void)Drive(model, orders, at);
    base::StateWriter out;
    model.Save(out);
    orders.Save(out);
    base::StateReader in(out.bytes());
    other.Restore(in);
    restored.Restore(in, other);
    ASSERT_TRUE(in.Finish().ok());
    for (int i = 0; i < 40; ++i) {
      (void)Drive(model, orders, 100);
      (void)Drive(other, restored, 100);
      base::StateWriter a, b;
      model.Save(a), orders.Save(a);
      other.Save(b), restored.Save(b);
      ASSERT_EQ(a.digest(), b.digest()) << at << " " << i;
    }
  }
}

TEST(PlaceOrders, APlaceThatIsNotThereIsRefused) {
  const TrafficModel model = Made(1);
  EXPECT_EQ(PlaceOrders::At(model, "tst", 3.0).error().Text(), "there is no road 'tst'; did you mean 'test'?");
  EXPECT_EQ(PlaceOrders::At(model, "test", 2000.5).error().Text(),
            "the station 2000.5 m is not on the road 'test', which is 2000.00 m long");
  EXPECT_EQ(PlaceOrders::At(model, "test", 2000.5).error().exit_status(), 2);
}

}  // namespace
}  // namespace rodeira::traffic
