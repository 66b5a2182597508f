// SPDX-License-Identifier: Apache-2.0
// What experiments tell single vehicles: to overtake, and to change lanes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "common/traffic/place_orders.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/traffic/two_way_ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

// Cars 0 and 1 follow one another around the ring with 12 and at most 17 m/s; 2 comes against them.
TrafficModel Following(bool left_hand, double comes_m) {
  TrafficModel model =
      TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), TwoWayRing(Mark("broken"), left_hand), {}).value();
  const std::string own = left_hand ? "1:1" : "1:-1", other = left_hand ? "1:-1" : "1:1";
  Put(model, 0, own, 400.0, 12.0);
  Put(model, 1, own, 375.0, 12.0);
  Put(model, 2, other, std::fmod(400.0 + comes_m, kRound * kRadius_m), 18.0);
  model.CapSpeed(0, 12.0);
  model.CapSpeed(1, 17.0);
  Step(model, 25);
  EXPECT_EQ(model.on_road(), 3u);
  return model;
}

// A commanded vehicle overtakes, though none slow enough holds it up; not before oncoming traffic is far enough, and
// back in time; others do not.
TEST(Scripted, ACommandedVehicleOvertakesAsSoonAsItIsSafe) {
  for (const bool left_hand : {false, true}) {
    for (const double comes_m : {1800.0, 300.0}) {
      TrafficModel calm = Following(left_hand, comes_m), model = calm;
      RingWatch still(left_hand), watch(left_hand);
      model.CommandOvertake(1);
      std::optional<int> began;
      for (int i = 0; i < 50 * 90; ++i) {
        Step(calm), still.Observe(calm, i * kStep_s);
        Step(model), watch.Observe(model, i * kStep_s);
        if (!began && model.agent(1).overtaking.active()) began = i;
      }
      EXPECT_EQ(still.passes, 0);
      EXPECT_TRUE(still.crossings.empty());
      ASSERT_TRUE(began.has_value()) << left_hand << " " << comes_m;
      EXPECT_EQ(*began == 0, comes_m > 1000.0) << *began;  // at once, or when oncoming traffic has gone by
      ASSERT_EQ(watch.crossings.size(), 1u);
      EXPECT_EQ(watch.passed_by[0], std::set<std::uint32_t>{1});
      EXPECT_GE(watch.crossings[0].spare_s, 2.0);
      EXPECT_TRUE(watch.touches.empty());
      EXPECT_FALSE(model.agent(1).told_past);
    }
  }
}

// Before an overtaker none appears on the lane of oncoming traffic, as long as it overtakes.
TEST(Scripted, NoVehicleAppearsBeforeAnOvertaker) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), TwoWayRing(Mark("broken")), {}).value();
  Put(model, 0, "1:-1", 400.0, 12.0);
  Put(model, 1, "1:-1", 375.0, 12.0);
  model.CapSpeed(0, 12.0);
  Step(model, 25);
  model.CommandOvertake(1);
  Step(model, 50);
  ASSERT_TRUE(model.agent(1).overtaking.active());
  Put(model, 2, "1:1", PoseOf(model, 1) == nullptr ? 0.0 : model.agent(1).o_m + 120.0, 5.0);
  int waits = 0;
  const auto beside = [&] { return model.agent(1).overtaking.active() && !model.agent(1).overtaking.back; };
  for (; beside() && waits < 1500; ++waits) {
    Step(model);
    ASSERT_TRUE(model.IsSpawning(2) || !beside()) << waits;
  }
  EXPECT_GT(waits, 100);
  Step(model, 50 * 10);
  EXPECT_EQ(model.on_road(), 3u);
}

TEST(Scripted, ToOvertakeIsForgottenByARelease) {
  TrafficModel model = Following(false, 300.0);
  model.CommandOvertake(1);
  Step(model);
  EXPECT_TRUE(model.agent(1).told_past);
  model.Release(1);
  RingWatch watch;
  for (int i = 0; i < 50 * 60; ++i) Step(model), watch.Observe(model, i * kStep_s);
  EXPECT_TRUE(watch.crossings.empty());
}

// Two lanes of one direction around a circle of 500 m.
std::shared_ptr<const network::Network> TwoLanes(const std::string& mark) {
  opendrive::RoadText road = CircleRoad(kRound * 500.0);
  road.left = "";
  road.right = CircleLane(-1, 20.0, Mark(mark)) + CircleLane(-2, 20.0, Mark("solid"));
  return opendrive::MustRead(opendrive::Document(road.Text()));
}
double LaneOf(const TrafficModel& model, std::uint32_t id) {  // 1 and 2 in the lanes' middles
  const AgentPose& pose = *PoseOf(model, id);
  return (std::hypot(pose.p_WB_W.x(), pose.p_WB_W.y() - 500.0) - 500.0) / 3.5 + 0.5;
}

// Alone: in the next step, over as far as the lanes' middles are apart, and there it stays.
TEST(Scripted, ACommandedVehicleChangesLanesAtOnceWhereTheLaneIsFree) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 300.0, 15.0);
  Step(model);
  model.CommandLaneChange(0, -1);  // no lane there: it waits for one
  Step(model, 50);
  EXPECT_EQ(model.agent(0).change.side, 0);
  for (const int side : {1, -1, 1}) {
    EXPECT_NEAR(LaneOf(model, 0), side > 0 ? 2.0 : 1.0, 1e-3);
    model.CommandLaneChange(0, side);
    Step(model);
    EXPECT_EQ(model.agent(0).change.side, side);
    Step(model, 50 * 9);
    EXPECT_NEAR(LaneOf(model, 0), side > 0 ? 1.0 : 2.0, 1e-3);
    EXPECT_EQ(model.agent(0).told_side, 0);
  }
}

TEST(Scripted, MarksAreKeptWhateverIsTold) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), TwoLanes("solid"), {}).value();
  Put(model, 0, "1:-2", 300.0, 15.0);
  Step(model);
  model.CommandLaneChange(0, 1);
  Step(model, 1000);
  EXPECT_NEAR(LaneOf(model, 0), 2.0, 1e-3);
  EXPECT_EQ(model.agent(0).told_side, 1);
}

// A vehicle comes faster on the lane beside: it begins in the first step in which that one need not brake harder than 2
// m/s² by the IDM, worked out from the poses, and has gone by where it does not before.
TEST(Scripted, ACommandedVehicleChangesLanesWhenItIsSafe) {
  for (const double behind_m : {12.0, 35.0, 90.0}) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoLanes("broken"), {}).value();
    Put(model, 0, "1:-2", 400.0, 12.0);
    Put(model, 1, "1:-1", 400.0 - behind_m, 20.0);
    model.CapSpeed(0, 12.0);
    Step(model);
    ASSERT_EQ(model.on_road(), 2u);
    model.CommandLaneChange(0, 1);
    const auto angle = [&](std::uint32_t id) {
      return std::atan2(PoseOf(model, id)->p_WB_W.x(), 500.0 - PoseOf(model, id)->p_WB_W.y());
    };
    const auto safe = [&] {
      const double gap = std::remainder(angle(0) - angle(1), kRound) * 501.75 -
                         0.5 * (model.traits(0).length_m + model.traits(1).length_m);
      const driver::IdmSettings& idm = model.traits(1).idm;
      if (gap > 0.0)
        return gap > idm.min_gap_m &&
               driver::IdmAcceleration(idm, PoseOf(model, 1)->speed_mps, 20.0, gap, PoseOf(model, 0)->speed_mps) > -2.0;
      const double ahead = -gap - model.traits(0).length_m - model.traits(1).length_m;
      const driver::IdmSettings& own = model.traits(0).idm;
      return ahead > own.min_gap_m &&
             driver::IdmAcceleration(own, PoseOf(model, 0)->speed_mps, 12.0, ahead, PoseOf(model, 1)->speed_mps) > -2.0;
    };
    int waited = 0;
    bool before = safe();
    while (model.agent(0).change.side == 0 && waited < 1500) {
      before = safe();
      Step(model);
      ++waited;
      EXPECT_EQ(model.agent(0).change.side != 0, before) << behind_m << " at " << waited;
    }
    EXPECT_TRUE(before);
    EXPECT_EQ(waited == 1, behind_m > 80.0) << behind_m << " " << waited;
  }
}

// On a road of several lanes a vehicle that is told to overtake goes over to the lane for it, and by.
TEST(Scripted, OnSeveralLanesTheCommandedVehiclePassesOnTheOther) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 400.0, 12.0);
  Put(model, 1, "1:-2", 360.0, 12.0);
  model.CapSpeed(0, 12.0);
  Step(model, 500);
  EXPECT_NEAR(LaneOf(model, 1), 2.0, 1e-3);
  model.CommandOvertake(1);
  Step(model);
  EXPECT_EQ(model.agent(1).change.side, 1);
  Step(model, 50 * 30);
  EXPECT_GT(PoseOf(model, 1)->speed_mps, 15.0);
  const auto angle = [&](std::uint32_t id) {
    return std::atan2(PoseOf(model, id)->p_WB_W.x(), 500.0 - PoseOf(model, id)->p_WB_W.y());
  };
  EXPECT_GT(std::remainder(angle(1) - angle(0), kRound), 0.1);
}

// Told at a place: in the step in which its middle passes.
TEST(Scripted, ToldWhenTheyPassAPlace) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 300.0, 15.0);
  Step(model);
  PlaceOrders orders;
  PlaceOrder order = PlaceOrders::At(model, "1", 360.0).value();
  order.kind = OrderKind::kChangeLane, order.value = 1.0, order.recipients = PlaceOrder::Recipients::kNext;
  orders.Add(order);
  const auto station = [&] {
    return std::atan2(PoseOf(model, 0)->p_WB_W.x(), 500.0 - PoseOf(model, 0)->p_WB_W.y()) * 500.0;
  };
  bool passed = false;
  for (int i = 0; i < 700; ++i) {
    EXPECT_EQ(model.agent(0).told_side == 1 || model.agent(0).change.side == 1 || LaneOf(model, 0) < 1.5, passed)
        << station();
    orders.Before(model);
    Step(model);
    orders.After(model);
    passed = passed || station() > 360.0;
  }
  EXPECT_NEAR(LaneOf(model, 0), 1.0, 1e-3);
  EXPECT_TRUE(IsSound(OrderKind::kChangeLane, -1.0));
  EXPECT_FALSE(IsSound(OrderKind::kChangeLane, 0.5));
  EXPECT_FALSE(IsSound(OrderKind::kBrake, 0.0));
  EXPECT_TRUE(IsSound(OrderKind::kOvertake, 0.0));
}

// Restored while one waits to appear, one to overtake and one to change lanes: the same bits.
TEST(Scripted, RestoredTheSameBits) {
  TrafficModel model = Following(false, 300.0);
  model.CommandOvertake(1);
  model.CommandLaneChange(0, 1);
  PlaceOrders orders;
  PlaceOrder order = PlaceOrders::At(model, "1", 700.0).value();
  order.kind = OrderKind::kOvertake, order.recipients = PlaceOrder::Recipients::kAll;
  orders.Add(order);
  for (int part = 0; part < 3; ++part) {
    base::StateWriter writer;
    model.Save(writer);
    orders.Save(writer);
    TrafficModel other = TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), TwoWayRing(Mark("broken")), {}).value();
    PlaceOrders others;
    base::StateReader reader(writer.bytes());
    other.Restore(reader);
    others.Restore(reader, other);
    ASSERT_TRUE(reader.Finish().ok());
    for (int i = 0; i < 1500; ++i) {
      orders.Before(model), Step(model), orders.After(model);
      others.Before(other), Step(other), others.After(other);
      ASSERT_EQ(DigestOf(model), DigestOf(other)) << part << " " << i;
    }
  }
  // And one that waits for room.
  TrafficModel full = TrafficModel::Make(OnlyScripted({kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value(),
               fresh = full;
  Put(full, 0, "test:-1", 500.0, 0.0);
  Step(full);
  Put(full, 1, "test:-1", 501.0, 4.0);
  Step(full);
  ASSERT_TRUE(full.IsSpawning(1));
  base::StateWriter writer;
  full.Save(writer);
  base::StateReader reader(writer.bytes());
  fresh.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  ASSERT_TRUE(fresh.IsSpawning(1));
  for (int i = 0; i < 1500; ++i) {
    Step(full), Step(fresh);
    ASSERT_EQ(DigestOf(full), DigestOf(fresh)) << i;
  }
  EXPECT_EQ(full.on_road(), 2u);
}

}  // namespace
}  // namespace rodeira::traffic
