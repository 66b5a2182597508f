// SPDX-License-Identifier: Apache-2.0
// Wind across a car.
#include "nodes/vehicle/gust.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/ground/ground.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::nodes {
namespace {

dynamics::VehicleDimensions Box() {
  dynamics::VehicleDimensions box;
  box.front_m = 2.0, box.rear_m = 2.0, box.height_m = 1.5;
  return box;
}

// rho / 2 × 0.8 × 4 m × 1.5 m × w², from the side that it comes from, at half the height and 0.4 m before the middle.
TEST(SideWind, OnACarThatStandsIsThePressureOnItsSide) {
  dynamics::VehicleState car;
  const double force_N = 0.6 * 0.8 * 4.0 * 1.5 * 20.0 * 20.0;
  const dynamics::Wrench wrench = SideWind(car, Box(), {0.0, -20.0});
  EXPECT_NEAR(wrench.force_W.y(), -force_N, 1e-9);
  EXPECT_NEAR(wrench.force_W.x(), 0.0, 1e-12);
  EXPECT_NEAR(wrench.moment_WB_W.x(), 0.75 * force_N, 1e-9);
  EXPECT_NEAR(wrench.moment_WB_W.z(), -0.4 * force_N, 1e-9);
  EXPECT_EQ(SideWind(car, Box(), {30.0, 0.0}).force_W.norm(), 0.0) << "along the car";
}

// At 30 m/s the air comes at an angle: speed through the air × the part of it across.
TEST(SideWind, AtASpeedGrowsWithTheSpeedThroughTheAir) {
  dynamics::VehicleState car;
  car.v_WB_W = {30.0, 0.0, 0.0};
  EXPECT_NEAR(SideWind(car, Box(), {0.0, 10.0}).force_W.y(), 0.6 * 4.8 * std::hypot(30.0, 10.0) * 10.0, 1e-9);
  EXPECT_EQ(SideWind(car, Box(), {0.0, 0.0}).force_W.norm(), 0.0);
  car.v_WB_W = {30.0, -2.0, 0.0};
  EXPECT_EQ(SideWind(car, Box(), {0.0, 0.0}).force_W.norm(), 0.0) << "still air is in the models' drag";
}

// The same seen from a car that heads elsewhere; mirrored for wind from the other side.
TEST(SideWind, TurnsWithTheCarAndMirrors) {
  dynamics::VehicleState east, north;
  east.v_WB_W = {25.0, 0.0, 0.0};
  north.v_WB_W = {0.0, 25.0, 0.0};
  north.q_WB = Eigen::AngleAxisd(0.5 * base::kPi, Eigen::Vector3d::UnitZ());
  const dynamics::Wrench one = SideWind(east, Box(), {3.0, 12.0}), other = SideWind(north, Box(), {-12.0, 3.0}),
                         mirror = SideWind(east, Box(), {3.0, -12.0});
  EXPECT_GT(one.force_W.y(), 100.0);
  EXPECT_NEAR(other.force_W.x(), -one.force_W.y(), 1e-9);
  EXPECT_NEAR(other.moment_WB_W.z(), one.moment_WB_W.z(), 1e-9);
  EXPECT_NEAR(mirror.force_W.y(), -one.force_W.y(), 1e-12);
  EXPECT_NEAR(mirror.moment_WB_W.x(), -one.moment_WB_W.x(), 1e-12);
}

// The mean of (1 - cos) / 2 is a half, its highest value one; a saved gust goes on with the same bits.
TEST(Gust, RisesAndFallsWithinItsTime) {
  Gust gust;
  EXPECT_FALSE(gust.blows());
  gust.Begin({"ego", 90.0, 2.0}, 16.0);
  double sum_mps = 0.0, highest_mps = 0.0;
  int steps = 0;
  Gust other;
  for (; gust.blows(); ++steps) {
    if (steps == 700) {
      base::StateWriter writer;
      gust.Save(writer);
      base::StateReader reader(writer.bytes());
      other.Restore(reader);
    }
    const Eigen::Vector2d wind = gust.Step(0.001);
    if (steps >= 700) {
      EXPECT_EQ(other.Step(0.001), wind);
    }
    EXPECT_NEAR(wind.x(), 0.0, 1e-12);
    EXPECT_LE(wind.y(), 0.0) << "from the north";
    sum_mps -= wind.y();
    highest_mps = std::max(highest_mps, -wind.y());
  }
  EXPECT_NEAR(steps, 2000, 1);
  EXPECT_NEAR(sum_mps / steps, 8.0, 0.01);
  EXPECT_NEAR(highest_mps, 16.0, 1e-4);
  EXPECT_EQ(gust.Step(0.001), Eigen::Vector2d::Zero());
}

class WindOn : public ::testing::TestWithParam<dynamics::ModelCase> {};

// At 30 m/s, with the steering wheel held, a gust from the left carries the car to the right, and it turns away from
// the wind, as its force acts before the middle.
TEST_P(WindOn, ACarAtASpeedIsCarriedAwayFromIt) {
  auto car = dynamics::MakeModel(GetParam());
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0);
  ASSERT_TRUE(car->Initialise({.speed_mps = 30.0}, ground).ok());
  ASSERT_TRUE(car->can_be_pushed());
  Gust gust;
  gust.Begin({"ego", 90.0, 1.0}, 20.0);
  dynamics::Controls controls;
  controls.gearbox = dynamics::GearboxMode::kManual;
  controls.gear = car->state().gear;
  controls.throttle = car->state().throttle;
  double yaw_radps = 0.0;
  for (int i = 0; i < 1000; ++i) {
    car->SetPush(SideWind(car->state(), car->dimensions(), gust.Step(0.001)));
    car->Step(controls, ground, 0.001);
    yaw_radps = std::min(yaw_radps, car->state().w_WB_B.z());
  }
  EXPECT_LT(yaw_radps, -0.005);
  EXPECT_LT(car->state().p_WB_W.y(), -0.05);
  EXPECT_GT(car->state().p_WB_W.y(), -1.5);
}

INSTANTIATE_TEST_SUITE_P(Models, WindOn, ::testing::Values(dynamics::kBicycle, dynamics::kOde, dynamics::kMultibody),
                         dynamics::NameOf);

}  // namespace
}  // namespace rodeira::nodes
