// What experiments ask of single vehicles: to overtake, to change lanes, to appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "common/traffic/place_orders.hpp"
#include "tests/common/driver/test_road.hpp"
#include "common/lanes/signs.hpp"
#include "tests/common/lanes/lane_networks.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/two_way_ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.02;
constexpr VehicleKind kCar = VehicleKind::kCar;

// Nobody is there but whom the test lets appear; they neither change lanes nor overtake of themselves.
TrafficSettings OnlyScripted(std::vector<VehicleKind> kinds) {
  TrafficSettings settings;
  settings.vehicles = 0;
  settings.scripted = std::move(kinds);
  settings.changes_lanes = settings.overtaking.allowed = false;
  settings.speed_factor_low = settings.speed_factor_high = 1.0;
  return settings;
}

void Step(TrafficModel& model, int steps = 1) {
  for (int i = 0; i < steps; ++i) model.Step(kStep_s, {});
}

void Put(TrafficModel& model, std::uint32_t id, const std::string& lane, double s_m, double speed_mps) {
  const auto told = model.LetAppear(id, lane, s_m, speed_mps);
  ASSERT_TRUE(told.ok()) << told.error().Text();
  ASSERT_TRUE(told.value());
}

const AgentPose* PoseOf(const TrafficModel& model, std::uint32_t id) {
  const auto found = std::find_if(model.poses().begin(), model.poses().end(), [id](const AgentPose& pose) { return pose.id == id; });
  return found == model.poses().end() ? nullptr : &*found;
}

// On a straight road at 0.3 rad its middle lies at the station, 1.5 m beside the axis, and goes on with the speed that was told.
TEST(Scripted, AVehicleAppearsWhereAndAsFastAsIsTold) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, VehicleKind::kLorry, VehicleKind::kBus}), driver::StraightWorld(2000.0, 20.0), {}).value();
  EXPECT_EQ(model.vehicles(), 3u);
  Step(model, 10);
  EXPECT_EQ(model.on_road(), 0u);
  Put(model, 0, "test:-1", 300.0, 13.0);
  Put(model, 1, "test:-1", 400.0, 0.0);
  Put(model, 2, "test:1", 400.0, 17.5);
  EXPECT_EQ(model.on_road(), 0u);
  Step(model);
  ASSERT_EQ(model.on_road(), 3u);
  const auto expect = [&](std::uint32_t id, double s_m, double t_m, double heading_rad, double speed_mps, VehicleKind kind) {
    const AgentPose& pose = *PoseOf(model, id);
    EXPECT_NEAR(pose.p_WB_W.x(), s_m * std::cos(0.3) - t_m * std::sin(0.3), 1e-6) << id;
    EXPECT_NEAR(pose.p_WB_W.y(), s_m * std::sin(0.3) + t_m * std::cos(0.3), 1e-6) << id;
    EXPECT_NEAR(FootprintOf(pose, model.traits(id)).heading_rad, heading_rad, 1e-9) << id;
    EXPECT_EQ(pose.speed_mps, speed_mps) << id;
    EXPECT_EQ(model.traits(id).kind, kind) << id;
  };
  expect(0, 300.0, -1.5, 0.3, 13.0, kCar);
  expect(1, 400.0, -1.5, 0.3, 0.0, VehicleKind::kLorry);
  expect(2, 400.0, 1.5, 0.3 - std::numbers::pi, 17.5, VehicleKind::kBus);
  const AgentPose before = *PoseOf(model, 0);
  Step(model);
  EXPECT_NEAR((PoseOf(model, 0)->p_WB_W - before.p_WB_W).norm(), 0.5 * (13.0 + PoseOf(model, 0)->speed_mps) * kStep_s, 1e-6);
  EXPECT_FALSE(model.LetAppear(0, "test:-1", 900.0, 3.0).value());  // it is there
  // They drive to the end, are gone, and may appear again, on another trip.
  Step(model, 50 * 150);
  EXPECT_EQ(model.on_road(), 0u);
  EXPECT_EQ(model.waiting(), 0u);
  EXPECT_EQ(model.ended(), 0u);
  Put(model, 0, "test:1", 900.0, 3.0);
  Step(model);
  ASSERT_EQ(model.on_road(), 1u);
  EXPECT_EQ(model.poses()[0].trip, 1u);
}

// Full physics: the car stands on its wheels there and drives on; another kind of driver too.
TEST(Scripted, AVehicleAppearsWithFullPhysicsToo) {
  for (const DriverKind driver : {DriverKind::kStandard, DriverKind::kMotors}) {
    TrafficSettings settings = OnlyScripted({kCar});
    settings.physics = Physics::kFull;
    settings.driver = driver;
    TrafficModel model = TrafficModel::Make(settings, driver::StraightWorld(1500.0, 20.0), {}).value();
    Step(model, 10);
    Put(model, 0, "test:-1", 300.0, 13.0);
    Step(model);
    ASSERT_EQ(model.on_road(), 1u);
    EXPECT_NEAR(PoseOf(model, 0)->p_WB_W.x(), 300.0 * std::cos(0.3) + 1.5 * std::sin(0.3), 1e-3);
    EXPECT_NEAR(PoseOf(model, 0)->speed_mps, 13.0, 1e-6);
    Step(model, 250);
    EXPECT_NEAR((PoseOf(model, 0)->p_WB_W - Eigen::Vector3d(300.0 * std::cos(0.3), 300.0 * std::sin(0.3), 0.0)).norm(), 5.0 * 14.5, 12.0);
  }
}

// Somebody stands there: it waits, and appears in the first step in which nobody's rectangle is within its standing gap, nor it nor who comes
// would have to brake harder than 4 m/s².
TEST(Scripted, WhereThereIsNoRoomItAppearsAsSoonAsThereIs) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value();
  Put(model, 0, "test:-1", 500.0, 0.0);
  model.Brake(0, 3.0);
  Step(model);
  Put(model, 1, "test:-1", 503.0, 0.0);
  Put(model, 2, "test:-1", 300.0, 20.0);
  Step(model);
  EXPECT_TRUE(model.IsAppearing(1));
  EXPECT_FALSE(model.IsAppearing(2));
  EXPECT_FALSE(model.LetAppear(1, "test:-1", 900.0, 3.0).value());
  Step(model, 1500);  // the third one stands behind the first, which then drives on
  EXPECT_TRUE(model.IsAppearing(1));
  EXPECT_EQ(model.on_road(), 2u);
  EXPECT_LT(model.agent(2).speed_mps, 0.05);
  model.Release(0);
  const auto along = [&](std::uint32_t id) { return PoseOf(model, id)->p_WB_W.x() * std::cos(0.3) + PoseOf(model, id)->p_WB_W.y() * std::sin(0.3); };
  const AgentTraits& own = model.traits(1);
  // From bumper to bumper; and whether who comes would have to brake hard.
  const auto gap = [&](std::uint32_t other) { return std::fabs(along(other) - 503.0) - 0.5 * (own.length_m + model.traits(other).length_m); };
  const auto clear = [&] { return gap(0) > own.idm.standing_gap_m && gap(2) > own.idm.standing_gap_m; };
  const auto brakes_mps2 = [&] { return along(2) > 503.0 ? 0.0 : -driver::IdmAcceleration(model.traits(2).idm, model.agent(2).speed_mps, 20.0, gap(2), 0.0); };
  int waited = 0;
  for (; model.IsAppearing(1) && waited < 2000; ++waited) {
    if (waited > 0 && clear()) {
      EXPECT_GT(brakes_mps2(), 4.0 - 0.3) << waited;
    }
    Step(model);
  }
  EXPECT_TRUE(clear());
  EXPECT_LT(brakes_mps2(), 4.0 + 0.3);
  EXPECT_GT(waited, 10);
  EXPECT_EQ(model.on_road(), 3u);
  EXPECT_EQ(model.agent(1).speed_mps, 0.0);
  Step(model, 1500);  // and all drive on
  for (const AgentPose& pose : model.poses()) EXPECT_GT(pose.speed_mps, 10.0) << pose.id;
}

// Not before somebody who could not stop for it within 4 m/s², by the IDM: v = 20 m/s, so near that it takes more.
TEST(Scripted, NobodyHasToBrakeHardForIt) {
  for (const double distance_m : {30.0, 60.0, 100.0, 150.0}) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value();
    Put(model, 0, "test:-1", 300.0, 20.0);
    Step(model);
    Put(model, 1, "test:-1", 300.0 + distance_m, 5.0);
    Step(model);
    const double gap = distance_m - 0.5 * (model.traits(0).length_m + model.traits(1).length_m);
    const double brakes = driver::IdmAcceleration(model.traits(0).idm, 20.0, 20.0, gap, 5.0);
    EXPECT_EQ(model.IsAppearing(1), brakes < -4.0) << distance_m << " m: " << brakes;
  }
}

TEST(Scripted, WhereItCanNeverAppearIsRefused) {
  TrafficSettings settings = OnlyScripted({kCar});
  settings.vehicles = 3;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  const auto refused = [&](std::uint32_t id, const std::string& lane, double s_m) {
    const auto told = model.LetAppear(id, lane, s_m, 5.0);
    if (told) return std::string();
    EXPECT_EQ(told.error().exit_status(), 2);
    return told.error().Text();
  };
  const std::string first = model.graph().network().roads()[model.graph()[0].lane.road].id();
  const std::string lane = first + ":" + std::to_string(model.graph()[0].lane.lane);
  EXPECT_EQ(refused(2, lane, 20.0), "agent 2 cannot appear; one of the traffic's 'scripted' was expected, 3 to 3");
  EXPECT_NE(refused(3, "nowhere:-1", 20.0).find("'nowhere:-1' was found; a drivable lane as ROAD:LANE, or a road, was expected"), std::string::npos);
  EXPECT_NE(refused(3, lane, 1e5).find("the station 100000 m is not on the lane '" + lane + "', which lies from 0.00 to"), std::string::npos);
  EXPECT_NE(refused(3, lane, 1.0).find("would stand across the lane's end; a place on plain lane was expected"), std::string::npos);
  std::set<std::string> why;
  for (std::uint32_t track = 0; track < model.graph().tracks().size(); ++track) {
    const lanes::Track& at = model.graph()[track];
    const std::string name = model.graph().network().roads()[at.lane.road].id() + ":" + std::to_string(at.lane.lane);
    for (double d = 5.0; d < at.length_m(); d += 5.0) {
      TrafficModel fresh = model;
      const auto told = fresh.LetAppear(3, name, at.curve.StationAt(d), 5.0);
      // By hand: clear of zones and lines by a metre, and whole on the lane.
      bool plain = at.junction < 0 && d > 0.5 * model.traits(3).length_m && d < at.length_m() - 0.5 * model.traits(3).length_m;
      for (const lanes::ZoneSide& part : model.zones().Of(track)) {
        if (part.in_m < d + 0.5 * model.traits(3).length_m + 1.0 && part.out_m > d - 0.5 * model.traits(3).length_m - 1.0) plain = false;
      }
      for (const lanes::SignPlace& sign : lanes::SignsOf(model.graph(), track)) {
        if (std::fabs(sign.d_m - d) < 0.5 * model.traits(3).length_m + 1.0 && sign.sign == lanes::Sign::kStop) plain = false;
      }
      EXPECT_EQ(told.ok(), plain) << name << " " << d << (told.ok() ? "" : told.error().Text());
      if (!told) why.insert(told.error().Text().substr(told.error().Text().find("would stand")));
    }
  }
  EXPECT_GE(why.size(), 2u);
  TrafficSettings none = settings;
  none.scripted.clear();
  EXPECT_NE(TrafficModel::Make(none, lanes::MapNetwork("crossing"), {}).value().LetAppear(3, lane, 20.0, 5.0).error().Text().find("have no 'scripted' vehicles, as in 'scripted: [car]'"), std::string::npos);
}

// A scripted vehicle that has not appeared is nothing to the others: to the bit.
TEST(Scripted, WhoDoesNotAppearChangesNothing) {
  TrafficSettings settings;
  settings.vehicles = 25;
  TrafficSettings with = settings;
  with.scripted = {kCar, VehicleKind::kVan};
  const auto network = lanes::MapNetwork("roundabout");
  TrafficModel a = TrafficModel::Make(settings, network, {}).value(), b = TrafficModel::Make(with, network, {}).value();
  for (int i = 0; i < 2000; ++i) {
    Step(a), Step(b);
    ASSERT_EQ(a.poses().size(), b.poses().size());
    for (std::size_t k = 0; k < a.poses().size(); ++k) ASSERT_EQ(a.poses()[k].p_WB_W, b.poses()[k].p_WB_W) << i;
  }
}

// Vehicles appear in a town that is full of others: nobody touches anybody.
TEST(Scripted, AmongOthersNobodyIsTouched) {
  TrafficSettings settings;
  settings.vehicles = 40;
  settings.scripted = std::vector<VehicleKind>(12, kCar);
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  std::size_t appeared = 0, told = 0;
  for (int i = 0; i < 50 * 90; ++i) {
    if (i % 100 == 0) {
      for (std::uint32_t track = static_cast<std::uint32_t>(i / 100) % 7; track < model.graph().tracks().size() && told < 400; track += 7) {
        const std::uint32_t id = 40 + static_cast<std::uint32_t>(told++ % 12);
        const lanes::Track& at = model.graph()[track];
        const auto status = model.LetAppear(id, model.graph().network().roads()[at.lane.road].id() + ":" + std::to_string(at.lane.lane), at.curve.StationAt(0.5 * at.length_m()), 8.0);
        appeared += status && status.value() ? 1 : 0;
      }
    }
    Step(model);
    for (std::size_t a = 0; a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        const AgentPose &one = model.poses()[a], &other = model.poses()[b];
        if ((one.p_WB_W - other.p_WB_W).norm() > 12.0) continue;
        ASSERT_FALSE(driver::Overlap(FootprintOf(one, model.traits(one.id)), FootprintOf(other, model.traits(other.id)))) << one.id << " and " << other.id << " at " << i * kStep_s;
      }
    }
  }
  EXPECT_GT(appeared, 12u);
}

// Cars 0 and 1 follow one another around the ring with 12 and at most 17 m/s; 2 comes against them.
TrafficModel Following(bool left_hand, double comes_m) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), TwoWayRing(Mark("broken"), left_hand), {}).value();
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

// Who is told overtakes, though nobody slow enough holds it up; not before who comes is far enough, and back in time; who is not told does not.
TEST(Scripted, WhoIsToldOvertakesAsSoonAsItIsSafe) {
  for (const bool left_hand : {false, true}) {
    for (const double comes_m : {1800.0, 300.0}) {
      TrafficModel calm = Following(left_hand, comes_m), model = calm;
      RingWatch still(left_hand), watch(left_hand);
      model.TellToPass(1);
      std::optional<int> began;
      for (int i = 0; i < 50 * 90; ++i) {
        Step(calm), still.Look(calm, i * kStep_s);
        Step(model), watch.Look(model, i * kStep_s);
        if (!began && model.agent(1).overtaking.active()) began = i;
      }
      EXPECT_EQ(still.passes, 0);
      EXPECT_TRUE(still.crossings.empty());
      ASSERT_TRUE(began.has_value()) << left_hand << " " << comes_m;
      EXPECT_EQ(*began == 0, comes_m > 1000.0) << *began;  // at once, or when who comes has gone by
      ASSERT_EQ(watch.crossings.size(), 1u);
      EXPECT_EQ(watch.passed_by[0], std::set<std::uint32_t>{1});
      EXPECT_GE(watch.crossings[0].spare_s, 2.0);
      EXPECT_TRUE(watch.touches.empty());
      EXPECT_FALSE(model.agent(1).told_past);
    }
  }
}

TEST(Scripted, ToOvertakeIsForgottenByARelease) {
  TrafficModel model = Following(false, 300.0);
  model.TellToPass(1);
  Step(model);
  EXPECT_TRUE(model.agent(1).told_past);
  model.Release(1);
  RingWatch watch;
  for (int i = 0; i < 50 * 60; ++i) Step(model), watch.Look(model, i * kStep_s);
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
TEST(Scripted, WhoIsToldChangesLanesAtOnceWhereNobodyIs) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 300.0, 15.0);
  Step(model);
  model.TellToChange(0, -1);  // no lane there: it waits for one
  Step(model, 50);
  EXPECT_EQ(model.agent(0).change.side, 0);
  for (const int side : {1, -1, 1}) {
    EXPECT_NEAR(LaneOf(model, 0), side > 0 ? 2.0 : 1.0, 1e-3);
    model.TellToChange(0, side);
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
  model.TellToChange(0, 1);
  Step(model, 1000);
  EXPECT_NEAR(LaneOf(model, 0), 2.0, 1e-3);
  EXPECT_EQ(model.agent(0).told_side, 1);
}

// Somebody comes faster on the lane beside: it begins in the first step in which that one need not brake harder than 2 m/s² by the IDM, worked out from
// the poses, and has gone by where it does not before.
TEST(Scripted, WhoIsToldChangesLanesWhenItIsSafe) {
  for (const double behind_m : {12.0, 35.0, 90.0}) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoLanes("broken"), {}).value();
    Put(model, 0, "1:-2", 400.0, 12.0);
    Put(model, 1, "1:-1", 400.0 - behind_m, 20.0);
    model.CapSpeed(0, 12.0);
    Step(model);
    ASSERT_EQ(model.on_road(), 2u);
    model.TellToChange(0, 1);
    const auto angle = [&](std::uint32_t id) { return std::atan2(PoseOf(model, id)->p_WB_W.x(), 500.0 - PoseOf(model, id)->p_WB_W.y()); };
    const auto safe = [&] {
      const double gap = std::remainder(angle(0) - angle(1), kRound) * 501.75 - 0.5 * (model.traits(0).length_m + model.traits(1).length_m);
      const driver::IdmSettings& idm = model.traits(1).idm;
      if (gap > 0.0) return gap > idm.standing_gap_m && driver::IdmAcceleration(idm, PoseOf(model, 1)->speed_mps, 20.0, gap, PoseOf(model, 0)->speed_mps) > -2.0;
      const double ahead = -gap - model.traits(0).length_m - model.traits(1).length_m;
      const driver::IdmSettings& own = model.traits(0).idm;
      return ahead > own.standing_gap_m && driver::IdmAcceleration(own, PoseOf(model, 0)->speed_mps, 12.0, ahead, PoseOf(model, 1)->speed_mps) > -2.0;
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

// On a road of several lanes who is told to overtake goes over to the lane for it, and by.
TEST(Scripted, OnSeveralLanesWhoIsToldPassesOnTheOther) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 400.0, 12.0);
  Put(model, 1, "1:-2", 360.0, 12.0);
  model.CapSpeed(0, 12.0);
  Step(model, 500);
  EXPECT_NEAR(LaneOf(model, 1), 2.0, 1e-3);
  model.TellToPass(1);
  Step(model);
  EXPECT_EQ(model.agent(1).change.side, 1);
  Step(model, 50 * 30);
  EXPECT_GT(PoseOf(model, 1)->speed_mps, 15.0);
  const auto angle = [&](std::uint32_t id) { return std::atan2(PoseOf(model, id)->p_WB_W.x(), 500.0 - PoseOf(model, id)->p_WB_W.y()); };
  EXPECT_GT(std::remainder(angle(1) - angle(0), kRound), 0.1);
}

// Told at a place: in the step in which its middle passes.
TEST(Scripted, ToldWhenTheyPassAPlace) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar}), TwoLanes("broken"), {}).value();
  Put(model, 0, "1:-2", 300.0, 15.0);
  Step(model);
  PlaceOrders orders;
  PlaceOrder order = PlaceOrders::At(model, "1", 360.0).value();
  order.kind = OrderKind::kChangeLane, order.value = 1.0, order.whom = PlaceOrder::Whom::kNext;
  orders.Add(order);
  const auto station = [&] { return std::atan2(PoseOf(model, 0)->p_WB_W.x(), 500.0 - PoseOf(model, 0)->p_WB_W.y()) * 500.0; };
  bool passed = false;
  for (int i = 0; i < 700; ++i) {
    EXPECT_EQ(model.agent(0).told_side == 1 || model.agent(0).change.side == 1 || LaneOf(model, 0) < 1.5, passed) << station();
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
  model.TellToPass(1);
  model.TellToChange(0, 1);
  PlaceOrders orders;
  PlaceOrder order = PlaceOrders::At(model, "1", 700.0).value();
  order.kind = OrderKind::kOvertake, order.whom = PlaceOrder::Whom::kAll;
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
  TrafficModel full = TrafficModel::Make(OnlyScripted({kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value(), fresh = full;
  Put(full, 0, "test:-1", 500.0, 0.0);
  Step(full);
  Put(full, 1, "test:-1", 501.0, 4.0);
  Step(full);
  ASSERT_TRUE(full.IsAppearing(1));
  base::StateWriter writer;
  full.Save(writer);
  base::StateReader reader(writer.bytes());
  fresh.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  ASSERT_TRUE(fresh.IsAppearing(1));
  for (int i = 0; i < 1500; ++i) {
    Step(full), Step(fresh);
    ASSERT_EQ(DigestOf(full), DigestOf(fresh)) << i;
  }
  EXPECT_EQ(full.on_road(), 2u);
}

}  // namespace
}  // namespace rodeira::traffic
