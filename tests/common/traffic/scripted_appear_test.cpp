// SPDX-License-Identifier: Apache-2.0
// Where, when and beside which others vehicles of an experiment appear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "common/world/lanes/signs.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/traffic/scripted.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/names.hpp"

namespace rodeira::traffic {
namespace {

// On a straight road at 0.3 rad its middle lies at the station, 1.5 m beside the axis, and goes on with the speed that
// was told.
TEST(Scripted, AVehicleAppearsWhereAndAsFastAsIsTold) {
  TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, VehicleKind::kLorry, VehicleKind::kBus}),
                                          driver::StraightWorld(2000.0, 20.0), {})
                           .value();
  EXPECT_EQ(model.vehicles(), 3u);
  Step(model, 10);
  EXPECT_EQ(model.on_road(), 0u);
  Put(model, 0, "test:-1", 300.0, 13.0);
  Put(model, 1, "test:-1", 400.0, 0.0);
  Put(model, 2, "test:1", 400.0, 17.5);
  EXPECT_EQ(model.on_road(), 0u);
  Step(model);
  ASSERT_EQ(model.on_road(), 3u);
  const auto expect = [&](std::uint32_t id, double s_m, double t_m, double heading_rad, double speed_mps,
                          VehicleKind kind) {
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
  EXPECT_NEAR((PoseOf(model, 0)->p_WB_W - before.p_WB_W).norm(), 0.5 * (13.0 + PoseOf(model, 0)->speed_mps) * kStep_s,
              1e-6);
  EXPECT_FALSE(model.Spawn(0, "test:-1", 900.0, 3.0).value());  // it is there
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
    EXPECT_NEAR((PoseOf(model, 0)->p_WB_W - Eigen::Vector3d(300.0 * std::cos(0.3), 300.0 * std::sin(0.3), 0.0)).norm(),
                5.0 * 14.5, 12.0);
  }
}

// A vehicle stands there: it waits, and appears in the first step in which no rectangle is within its minimum
// gap, and neither it nor its follower would have to brake harder than 4 m/s².
TEST(Scripted, WhereThereIsNoRoomItAppearsAsSoonAsThereIs) {
  TrafficModel model =
      TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value();
  Put(model, 0, "test:-1", 500.0, 0.0);
  model.Brake(0, 3.0);
  Step(model);
  Put(model, 1, "test:-1", 503.0, 0.0);
  Put(model, 2, "test:-1", 300.0, 20.0);
  Step(model);
  EXPECT_TRUE(model.IsSpawning(1));
  EXPECT_FALSE(model.IsSpawning(2));
  EXPECT_FALSE(model.Spawn(1, "test:-1", 900.0, 3.0).value());
  Step(model, 1500);  // the third one stands behind the first, which then drives on
  EXPECT_TRUE(model.IsSpawning(1));
  EXPECT_EQ(model.on_road(), 2u);
  EXPECT_LT(model.agent(2).speed_mps, 0.05);
  model.Release(0);
  const auto along = [&](std::uint32_t id) {
    return PoseOf(model, id)->p_WB_W.x() * std::cos(0.3) + PoseOf(model, id)->p_WB_W.y() * std::sin(0.3);
  };
  const AgentTraits& own = model.traits(1);
  // From bumper to bumper; and whether the follower would have to brake hard.
  const auto gap = [&](std::uint32_t other) {
    return std::fabs(along(other) - 503.0) - 0.5 * (own.length_m + model.traits(other).length_m);
  };
  const auto clear = [&] { return gap(0) > own.idm.min_gap_m && gap(2) > own.idm.min_gap_m; };
  const auto brakes_mps2 = [&] {
    return along(2) > 503.0
               ? 0.0
               : -driver::IdmAcceleration(model.traits(2).idm, model.agent(2).speed_mps, 20.0, gap(2), 0.0);
  };
  int waited = 0;
  for (; model.IsSpawning(1) && waited < 2000; ++waited) {
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
  EXPECT_EQ(model.poses().size(), 3U);
  for (const AgentPose& pose : model.poses()) EXPECT_GT(pose.speed_mps, 10.0) << pose.id;
}

// Not before a vehicle that could not stop for it within 4 m/s², by the IDM: v = 20 m/s, so near that it takes more.
TEST(Scripted, NoVehicleHasToBrakeHardForIt) {
  for (const double distance_m : {30.0, 60.0, 100.0, 150.0}) {
    TrafficModel model =
        TrafficModel::Make(OnlyScripted({kCar, kCar}), driver::StraightWorld(2000.0, 20.0), {}).value();
    Put(model, 0, "test:-1", 300.0, 20.0);
    Step(model);
    Put(model, 1, "test:-1", 300.0 + distance_m, 5.0);
    Step(model);
    const double gap = distance_m - 0.5 * (model.traits(0).length_m + model.traits(1).length_m);
    const double brakes = driver::IdmAcceleration(model.traits(0).idm, 20.0, 20.0, gap, 5.0);
    EXPECT_EQ(model.IsSpawning(1), brakes < -4.0) << distance_m << " m: " << brakes;
  }
}

TEST(Scripted, WhereItCanNeverAppearIsRefused) {
  TrafficSettings settings = OnlyScripted({kCar});
  settings.vehicles = 3;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  const auto refused = [&](std::uint32_t id, const std::string& lane, double s_m) {
    const auto told = model.Spawn(id, lane, s_m, 5.0);
    if (told) return std::string();
    EXPECT_EQ(told.error().exit_status(), 2);
    return told.error().Text();
  };
  const std::string first = model.graph().network().roads()[model.graph()[0].lane.road].id();
  const std::string lane = first + ":" + std::to_string(model.graph()[0].lane.lane);
  EXPECT_EQ(refused(2, lane, 20.0), "agent 2 cannot appear; one of the traffic's 'scripted' was expected, 3 to 3");
  EXPECT_NE(refused(3, "nowhere:-1", 20.0)
                .find("'nowhere:-1' was found; a drivable lane as ROAD:LANE, or a road, was expected"),
            std::string::npos);
  EXPECT_NE(
      refused(3, lane, 1e5).find("the station 100000 m is not on the lane '" + lane + "', which lies from 0.00 to"),
      std::string::npos);
  EXPECT_NE(refused(3, lane, 1.0).find("would stand across the lane's end; a place on plain lane was expected"),
            std::string::npos);
  // By hand: clear of zones and lines by a metre, whole on the lane, and not within a junction.
  std::set<std::string> why;
  for (const char* map : {"crossing", "town", "overpass"}) {
    TrafficModel whole = TrafficModel::Make(settings, lanes::MapNetwork(map), {}).value();
    const double half = 0.5 * whole.traits(3).length_m;
    for (std::uint32_t track = 0; track < whole.graph().tracks().size(); ++track) {
      const lanes::Track& at = whole.graph()[track];
      const std::string name = whole.graph().network().roads()[at.lane.road].id() + ":" + std::to_string(at.lane.lane);
      for (double d = 5.0; d < at.length_m(); d += 5.0) {
        TrafficModel fresh = whole;
        const auto told = fresh.Spawn(3, name, at.curve.StationAt(d), 5.0);
        bool plain = at.junction < 0 && d > half && d < at.length_m() - half;
        for (const lanes::ZoneSide& part : whole.zones().Of(track)) {
          if (part.in_m < d + half + 1.0 && part.out_m > d - half - 1.0) plain = false;
        }
        for (const lanes::SignPlace& sign : lanes::SignsOf(whole.graph(), track)) {
          if (std::fabs(sign.d_m - d) < half + 1.0 && sign.sign == lanes::Sign::kStop) plain = false;
        }
        EXPECT_EQ(told.ok(), plain) << map << " " << name << " " << d << (told.ok() ? "" : told.error().Text());
        if (!told) why.insert(told.error().Text().substr(told.error().Text().find("would stand")));
      }
    }
  }
  EXPECT_GE(why.size(), 2u);
  TrafficSettings none = settings;
  none.scripted.clear();
  EXPECT_NE(TrafficModel::Make(none, lanes::MapNetwork("crossing"), {})
                .value()
                .Spawn(3, lane, 20.0, 5.0)
                .error()
                .Text()
                .find("have no 'scripted' vehicles, as in 'scripted: [car]'"),
            std::string::npos);
}

// Where lanes of a junction are roads of their own it is said that they are.
TEST(Scripted, NoVehicleAppearsWithinAJunction) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/lights.yaml");
  ASSERT_TRUE(world.ok());
  TrafficSettings settings = OnlyScripted({kCar});
  settings.vehicles = 1;
  TrafficModel model = TrafficModel::Make(settings, world.value(), {}).value();
  int within = 0;
  for (const lanes::Track& track : model.graph().tracks()) {
    if (track.junction < 0 || track.length_m() < model.traits(1).length_m + 1.0) continue;
    const std::string lane =
        model.graph().network().roads()[track.lane.road].id() + ":" + std::to_string(track.lane.lane);
    const auto told = model.Spawn(1, lane, track.curve.StationAt(0.5 * track.length_m()), 5.0);
    ASSERT_FALSE(told.ok()) << lane;
    EXPECT_EQ(told.error().exit_status(), 2);
    EXPECT_THAT(told.error().Text(), Names("of lane '" + lane + "' … within a junction"));
    ++within;
  }
  EXPECT_GE(within, 4);
}

// A scripted vehicle that has not appeared is nothing to the others: to the bit.
TEST(Scripted, AVehicleThatDoesNotAppearChangesNothing) {
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

// Behind zones that a vehicle has reserved none appears before that one has come to where it wants to stand, though
// there were room for both.
TEST(Scripted, NoVehicleTakesAReservedPlace) {
  TrafficSettings settings = OnlyScripted({kCar});
  settings.vehicles = 10;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  int tried = 0, waited = 0;
  for (int i = 0; i < 50 * 120; ++i) {
    Step(model);
    for (std::uint32_t id = 0; id < 10; ++id) {
      const Agent& agent = model.agent(id);
      if (!agent.on_road || agent.grants.empty()) continue;
      const lanes::Track& turn = model.graph()[agent.path.back().track];
      if (turn.next.size() != 1) continue;
      const lanes::Track& out = model.graph()[turn.next[0].to];
      const double ends = agent.path.back().zero_m + turn.length_m();
      TrafficModel fresh = model;
      const std::string lane =
          fresh.graph().network().roads()[out.lane.road].id() + ":" + std::to_string(out.lane.lane);
      double d = 5.0;
      while (d < 30.0 && !fresh.Spawn(10, lane, out.curve.StationAt(d), 8.0)) d += 1.0;
      if (!fresh.IsSpawning(10) || agent.granted_m + 20.0 < ends + d) continue;
      Step(fresh);
      ++tried;
      waited += fresh.IsSpawning(10) ? 1 : 0;
    }
  }
  EXPECT_GT(tried, 100);
  EXPECT_EQ(waited, tried);
}

// Vehicles appear in a town that is full of others: no vehicle touches another.
TEST(Scripted, AmongOthersNoVehicleIsTouched) {
  TrafficSettings settings;
  settings.vehicles = 40;
  settings.scripted = std::vector<VehicleKind>(12, kCar);
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("town"), {}).value();
  std::size_t appeared = 0, told = 0;
  for (int i = 0; i < 50 * 90; ++i) {
    if (i % 100 == 0) {
      for (std::uint32_t track = static_cast<std::uint32_t>(i / 100) % 7;
           track < model.graph().tracks().size() && told < 400; track += 7) {
        const std::uint32_t id = 40 + static_cast<std::uint32_t>(told++ % 12);
        const lanes::Track& at = model.graph()[track];
        const auto status =
            model.Spawn(id, model.graph().network().roads()[at.lane.road].id() + ":" + std::to_string(at.lane.lane),
                        at.curve.StationAt(0.5 * at.length_m()), 8.0);
        appeared += status && status.value() ? 1 : 0;
      }
    }
    Step(model);
    for (std::size_t a = 0; a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        const AgentPose &one = model.poses()[a], &other = model.poses()[b];
        if ((one.p_WB_W - other.p_WB_W).norm() > 12.0) continue;
        ASSERT_FALSE(
            driver::Overlap(FootprintOf(one, model.traits(one.id)), FootprintOf(other, model.traits(other.id))))
            << one.id << " and " << other.id << " at " << i * kStep_s;
      }
    }
  }
  EXPECT_GT(appeared, 12u);
}

}  // namespace
}  // namespace rodeira::traffic
