// SPDX-License-Identifier: Apache-2.0
// Where MOTORS' driver steers for and to which vehicles it gives way: against points and rules worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/ring.hpp"

namespace rodeira::traffic {
namespace {

using Eigen::Vector2d;

constexpr double kStep_s = 0.01, kRadius_m = 120.0, kWide_m = 3.5, kApart_m = 0.3;

TrafficSettings AsMotors(std::vector<VehicleKind> scripted) {
  TrafficSettings settings;
  settings.vehicles = 0;
  settings.scripted = std::move(scripted);
  settings.driver = DriverKind::kMotors;
  settings.physics = Physics::kFull;
  return settings;
}

// The trajectory of a lap on the outer lane of a circle to the left: points 0.3 m of the lane's middle apart, each as
// far to the left as the weight of the left border says; the first control point of the lane's cubic curve, which
// counts (1 - u)³, is moved.
struct Lap {
  double weight = 0.5;
  Vector2d moved = Vector2d::Zero();

  static constexpr double kMiddle_m = kRadius_m + 0.5 * kWide_m, kLength_m = 2.0 * std::numbers::pi * kMiddle_m;
  static std::uint32_t points() { return static_cast<std::uint32_t>(std::ceil(kLength_m / kApart_m)) + 1; }
  Vector2d At(std::uint32_t index) const {
    const double d = std::min(index * kApart_m, kLength_m), angle = d / kMiddle_m,
                 r = kMiddle_m - (weight - 0.5) * kWide_m;
    return Vector2d(r * std::sin(angle), kRadius_m - r * std::cos(angle)) + std::pow(1.0 - d / kLength_m, 3) * moved;
  }
};

// Two laps: where it looks to is the point that lies two seconds of way beyond the one that it comes to, and those two
// are passed when the next is nearer, or is reached within 10 cm. At the second lap's beginning the first point lies
// halfway between where it would, and where the first lap's last one was.
TEST(MotorsTrajectory, PointsAreThoseOfTheBordersMean) {
  opendrive::RoadText road = CircleRoad(2.0 * std::numbers::pi * kRadius_m);
  road.left = "";
  road.right = CircleLane(-1, 25.0);
  TrafficModel model =
      TrafficModel::Make(AsMotors({VehicleKind::kCar}), opendrive::MustRead(opendrive::Document(road.Text())), {})
          .value();
  ASSERT_TRUE(model.Spawn(0, "1:-1", 5.0, 8.0).value());
  model.Step(kStep_s, {});
  ASSERT_EQ(model.on_road(), 1u);
  Lap lap;
  std::uint32_t laps = 0, checkpoint = 0;
  int compared = 0, nearer = 0;
  double farthest = 0.0;
  for (int i = 0; i < 20000 && laps < 3; ++i) {
    const Vector2d at = model.full()->cars().p_WB_W(0).head<2>();
    model.Step(kStep_s, {});
    const MotorsDriver& driver = *model.motors(0);
    if (driver.lanes != laps) {
      const double before = lap.weight;
      lap.weight = driver.weight;
      lap.moved =
          laps == 0
              ? Vector2d::Zero()
              : Vector2d(0.0, 0.5 * (before - lap.weight) * kWide_m);  // to the left of the lane's beginning: along y
      if (laps > 0) {
        EXPECT_GT((lap.moved).norm(), 0.01) << "the weights of two laps are too like to say anything";
      }
      laps = driver.lanes, checkpoint = driver.checkpoint;
      EXPECT_GE(lap.weight, 0.35);
      EXPECT_LE(lap.weight, 0.65);
      continue;
    }
    // It has passed every point up to the one that it comes to, and not that one.
    for (std::uint32_t k = checkpoint; k < driver.checkpoint; ++k) {
      const double here = (lap.At(k) - at).norm(), next = (lap.At(k + 1) - at).norm();
      EXPECT_TRUE(next <= here || next < 0.1) << k << " of lap " << laps;
      ++nearer;
    }
    if (driver.checkpoint + 2 < Lap::points()) {
      const double here = (lap.At(driver.checkpoint) - at).norm(), next = (lap.At(driver.checkpoint + 1) - at).norm();
      EXPECT_TRUE(here < next && next >= 0.1) << driver.checkpoint << " of lap " << laps;
    }
    checkpoint = driver.checkpoint;
    const std::uint32_t looks =
        std::min(checkpoint + static_cast<std::uint32_t>(2.0 * model.agent(0).speed_mps / kApart_m), Lap::points() - 2);
    ASSERT_LT((model.Details()[0].look_ahead_W - lap.At(looks)).norm(), 1e-4) << "lap " << laps << ", point " << looks;
    farthest = std::max(farthest, (lap.At(checkpoint) - at).norm());
    ++compared;
  }
  EXPECT_EQ(laps, 3u);
  EXPECT_GT(compared, 5000);
  EXPECT_GT(nearer, 4000);
  EXPECT_LT(farthest, 0.5) << "the car drives along it";
}

// A.71: a tenth more of throttle below the speed at which the engine would stall, also while it stops; the clutch comes
// down as it falls further.
TEST(MotorsPedals, AreForAnEngineThatWouldStall) {
  MotorsCar car;
  MotorsDriver driver;
  driver.Begin(1);
  MotorsView view;
  view.engine_radps = car.stall_radps + 1.0;
  EXPECT_NEAR(driver.Step(view, car, 0.01).throttle, 0.5, 1e-12);
  view.engine_radps = car.stall_radps - 1.0;
  EXPECT_NEAR(driver.Step(view, car, 0.01).throttle, 0.6, 1e-12);
  view.stops = true;
  view.speed_mps = 1.0;
  EXPECT_NEAR(driver.Step(view, car, 0.01).throttle, 0.1, 1e-12);
  EXPECT_NEAR(driver.Step(view, car, 0.01).brake, 0.6, 1e-12);
  for (const auto& [radps, clutch] :
       {std::pair{200.0, 0.0}, {150.0, 0.0}, {135.0, 0.25}, {120.0, 0.5}, {90.0, 1.0}, {40.0, 1.0}}) {
    view.engine_radps = radps;
    MotorsDriver fresh;
    fresh.Begin(1);
    EXPECT_NEAR(fresh.Step(view, car, 0.01).clutch, clutch, 1e-12) << radps;
  }
  view.engine_runs = false;
  EXPECT_TRUE(driver.Step(view, car, 0.01).starter);
}

// Two roads that cross, one to the east, one to the north, and perhaps above it; one lane each.
std::shared_ptr<const network::Network> Crossing(bool left_hand, double above_m, bool both_ways = false) {
  const std::string lane =
      "<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" "
      "max=\"14\" unit=\"m/s\"/></lane>";
  std::string text;
  for (const bool north : {false, true}) {
    opendrive::RoadText road;
    road.id = north ? "2" : "1";
    road.length = 400.0;
    if (left_hand) road.attributes += " rule=\"LHT\"";
    road.geometry = fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{:.17g}\" length=\"400\"><line/></geometry>",
                                north ? 0 : -200, north ? -200 : 0, north ? 0.5 * std::numbers::pi : 0.0);
    if (north) road.elevation = fmt::format("<elevation s=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", above_m);
    road.left = left_hand || (north && both_ways) ? fmt::format(fmt::runtime(lane), 1) : "";
    road.right = left_hand && !(north && both_ways) ? "" : fmt::format(fmt::runtime(lane), -1);
    text += road.Text();
  }
  return opendrive::MustRead(opendrive::Document(text));
}

// Both come to the crossing together: the one to the east has the other one on its right. It stops, and that one drives
// on; in left-hand traffic it is the other way about. Where one drives above the other none stops.
TEST(MotorsYielding, AVehicleStopsForOneOnItsRight) {
  for (const bool left_hand : {false, true}) {
    for (const double above_m : {0.0, 6.0}) {
      TrafficModel model =
          TrafficModel::Make(AsMotors({VehicleKind::kCar, VehicleKind::kCar}), Crossing(left_hand, above_m), {})
              .value();
      const double meets_m = left_hand ? 200.0 - 1.75 : 200.0 + 1.75, other_m = left_hand ? 200.0 + 1.75 : 200.0 - 1.75;
      const std::string lane = left_hand ? ":1" : ":-1";
      ASSERT_TRUE(model.Spawn(0, "1" + lane, meets_m - 40.0, 11.0).value());
      ASSERT_TRUE(model.Spawn(1, "2" + lane, other_m - 40.0, 11.0).value());
      model.Step(kStep_s, {});
      ASSERT_EQ(model.on_road(), 2u);
      int stops[2] = {0, 0};
      double slowest[2] = {1e9, 1e9};
      for (int i = 0; i < 250; ++i) {
        model.Step(kStep_s, {});
        for (std::uint32_t id = 0; id < 2; ++id) {
          stops[id] += model.motors(id)->stops ? 1 : 0;
          slowest[id] = std::min(slowest[id], model.agent(id).speed_mps);
        }
      }
      const int yields = left_hand ? 1 : 0;
      EXPECT_EQ(stops[yields] > 20, above_m == 0.0) << left_hand << " " << above_m << ": " << stops[yields];
      EXPECT_EQ(stops[1 - yields], 0) << left_hand << " " << above_m;
      EXPECT_EQ(slowest[yields] < 9.0, above_m == 0.0) << left_hand << " " << above_m << ": " << slowest[yields];
      EXPECT_GT(slowest[1 - yields], 9.0) << left_hand << " " << above_m;
    }
  }
}

// A third one comes from the left of the one that yields, later (in left-hand traffic all is mirrored): it has that one
// on its right, and stops for it; without it for none, since the two on the crossing road see past one another.
// They pass in this order: the one with none on its right, the one that yields to it, the third.
TEST(MotorsYielding, AThirdThatComesLaterLetsBothGo) {
  for (const bool left_hand : {false, true}) {
    for (const bool is_there : {true, false}) {  // the one that yields first
      TrafficModel model = TrafficModel::Make(AsMotors({VehicleKind::kCar, VehicleKind::kCar, VehicleKind::kCar}),
                                              Crossing(left_hand, 0.0, true), {})
                               .value();
      const double side = left_hand ? -1.0 : 1.0, meets_m = 200.0 - 1.75 * side;
      if (is_there) {
        ASSERT_TRUE(model.Spawn(0, left_hand ? "1:1" : "1:-1", 201.75 - 40.0, 11.0).value());
      }
      ASSERT_TRUE(model.Spawn(1, "2:-1", meets_m - 40.0 * side, 11.0).value());
      ASSERT_TRUE(model.Spawn(2, "2:1", meets_m + 75.0 * side, 11.0).value());
      model.Step(kStep_s, {});
      ASSERT_EQ(model.on_road(), is_there ? 3u : 2u);
      int stops[3] = {0, 0, 0};
      double passed_s[3] = {-1.0, -1.0, -1.0};
      for (int i = 0; i < 1200; ++i) {
        model.Step(kStep_s, {});
        for (const AgentPose& pose : model.poses()) {
          if (passed_s[pose.id] >= 0.0) continue;
          stops[pose.id] += model.motors(pose.id)->stops ? 1 : 0;
          const double along = (pose.q_WB * Eigen::Vector3d::UnitX()).head<2>().dot(pose.p_WB_W.head<2>());
          if (along > 4.0) passed_s[pose.id] = kStep_s * i;
        }
      }
      EXPECT_EQ(stops[1], 0) << left_hand;
      EXPECT_EQ(stops[0] > 20, is_there) << left_hand << ": " << stops[0];
      EXPECT_EQ(stops[2] > 10, is_there) << left_hand << ": " << stops[2];
      EXPECT_GT(passed_s[1], 0.0) << left_hand;
      EXPECT_GT(passed_s[2], passed_s[1]) << left_hand;
      if (!is_there) {
        EXPECT_EQ(stops[2], 0) << left_hand;
        continue;
      }
      EXPECT_GT(passed_s[0], passed_s[1]) << left_hand;
      EXPECT_GT(passed_s[2], passed_s[0]) << left_hand;
    }
  }
}

}  // namespace
}  // namespace rodeira::traffic
