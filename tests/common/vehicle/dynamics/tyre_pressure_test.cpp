// SPDX-License-Identifier: Apache-2.0
// Tyres that lose pressure while the car drives.
#include "common/vehicle/dynamics/tyre_pressure.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/core/ground/ground.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"

namespace rodeira::dynamics {
namespace {

using Shares = std::array<double, kWheels>;
constexpr Shares kFull{1.0, 1.0, 1.0, 1.0}, kFlatFrontLeft{0.0, 1.0, 1.0, 1.0};

TEST(TyrePressure, OfOneIsTheTyreOfTheFile) {
  TyreSettings tyre;
  SetPressure(tyre, 1.0);
  EXPECT_EQ(tyre.vertical_share, 1.0);
  EXPECT_EQ(tyre.resistance_share, 1.0);
  EXPECT_EQ(tyre.slip_share, 1.0);
}

TEST(TyrePressure, LessMakesItSofterAndHarderToRoll) {
  TyreSettings half, flat, more;
  SetPressure(half, 0.5);
  SetPressure(flat, 0.0);
  SetPressure(more, 1.5);
  EXPECT_NEAR(half.vertical_share, 0.6, 1e-12);
  EXPECT_NEAR(half.resistance_share, std::pow(2.0, 0.4), 1e-12);
  EXPECT_NEAR(half.slip_share, 0.675, 1e-12);
  EXPECT_NEAR(flat.vertical_share, 0.2, 1e-12);
  EXPECT_NEAR(flat.resistance_share, 10.0, 1e-12);
  EXPECT_NEAR(more.vertical_share, 1.4, 1e-12);
  EXPECT_LT(more.resistance_share, 1.0);
  EXPECT_EQ(more.slip_share, 1.0);
}

// The slope of the forces at no slip is the stiffness times the share, the greatest force stays.
TEST(TyrePressure, ScalesTheStiffnessAndKeepsThePeak) {
  TyreSettings tyre = DefaultSettings().tyre[0], flat = tyre;
  SetPressure(flat, 0.0);
  const double load_N = 3000.0, slip = 1e-6;
  const double side_N = SteadyForces(tyre, {0.0, slip, 0.0}, load_N, 1.0).lateral_N -
                        SteadyForces(tyre, {0.0, 0.0, 0.0}, load_N, 1.0).lateral_N;
  const double flat_N = SteadyForces(flat, {0.0, slip, 0.0}, load_N, 1.0).lateral_N -
                        SteadyForces(flat, {0.0, 0.0, 0.0}, load_N, 1.0).lateral_N;
  EXPECT_GT(std::fabs(side_N), 0.01);
  EXPECT_NEAR(flat_N / side_N, 0.35, 1e-4);
  EXPECT_NEAR(CorneringStiffness(flat, load_N) / CorneringStiffness(tyre, load_N), 0.35, 1e-12);
  const auto greatest = [&](const TyreSettings& of) {
    double most_N = 0.0;
    for (double tan = 0.0; tan < 2.0; tan += 0.001)
      most_N = std::max(most_N, std::fabs(SteadyForces(of, {0.0, tan, 0.0}, load_N, 1.0).lateral_N));
    return most_N;
  };
  EXPECT_NEAR(greatest(flat), greatest(tyre), 1e-3 * greatest(tyre));
}

class FlatTyre : public ::testing::TestWithParam<ModelCase> {};

Controls Rolling() {
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = 0;
  return controls;
}

// Full pressures that are set have the bits of a car of which nothing was said.
TEST_P(FlatTyre, FullPressuresChangeNoBit) {
  auto one = MakeModel(GetParam()), other = MakeModel(GetParam());
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.01, 0.0);
  ASSERT_TRUE(one->Initialise({.speed_mps = 15.0}, ground).ok());
  ASSERT_TRUE(other->Initialise({.speed_mps = 15.0}, ground).ok());
  for (int i = 0; i < 300; ++i) {
    Controls controls = Rolling();
    controls.steering_wheel_rad = 0.004 * i;
    other->SetTyrePressures(kFull);
    one->Step(controls, ground, kStep_s);
    other->Step(controls, ground, kStep_s);
  }
  EXPECT_EQ(DigestOf(*one), DigestOf(*other));
}

// A car that stands comes to rest on its softer tyre, with weight and moments as before: the tyre's vertical force is
// its stiffness times its deflection, so the corner sinks, and the car leans to it.
TEST_P(FlatTyre, TheCornerOfAStandingCarSinks) {
  auto car = MakeModel(GetParam());
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0);
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  const VehicleState before = car->state();
  car->SetTyrePressures(kFlatFrontLeft);
  DriveFor(*car, ground, Neutral(1.0), 8.0);
  const VehicleState after = car->state();
  double loads_N = 0.0, loads_before_N = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    loads_N += after.wheels[i].load_N;
    loads_before_N += before.wheels[i].load_N;
  }
  EXPECT_NEAR(loads_N, loads_before_N, 2e-3 * loads_before_N);
  EXPECT_LT(after.wheels[kFrontLeft].load_N, before.wheels[kFrontLeft].load_N);
  EXPECT_LT(after.roll_rad(), before.roll_rad() - 0.005) << "to the left";
  EXPECT_GT(after.pitch_rad(), before.pitch_rad() + 0.003) << "nose down";
  EXPECT_LT(after.v_WB_W.norm(), 1e-3);
}

// Rolling resistance by the loads: what a car in neutral loses more in two seconds than one with full tyres.
TEST_P(FlatTyre, RollsHarderByItsLoad) {
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0);
  constexpr Shares kFlat{0.0, 0.0, 0.0, 0.0};
  std::array<double, 2> lost_mps{};
  double mass_kg = 0.0;
  for (const bool flat : {false, true}) {
    auto car = MakeModel(GetParam());
    ASSERT_TRUE(car->Initialise({.speed_mps = 10.0}, ground).ok());
    car->SetTyrePressures(flat ? kFlat : kFull);
    DriveFor(*car, ground, Rolling(), 3.0);  // it settles on its tyres
    const double began_mps = car->state().speed_mps();
    DriveFor(*car, ground, Rolling(), 2.0);
    lost_mps[flat ? 1 : 0] = began_mps - car->state().speed_mps();
    mass_kg = car->dimensions().mass_kg;
  }
  // Nine times 0.012 of the weight more (both cars), less what the wheels' inertia takes: some five per cent.
  const double more_mps = 9.0 * 0.012 * 9.81 * 2.0;
  EXPECT_NEAR(lost_mps[1] - lost_mps[0], more_mps, 0.1 * more_mps) << mass_kg;
}

// At a speed the car is pulled to the side of its flat front tyre.
TEST_P(FlatTyre, PullsToItsSide) {
  auto car = MakeModel(GetParam());
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0);
  ASSERT_TRUE(car->Initialise({.speed_mps = 25.0}, ground).ok());
  car->SetTyrePressures(kFlatFrontLeft);
  DriveFor(*car, ground, Rolling(), 3.0);
  EXPECT_GT(car->state().p_WB_W.y(), 0.3);
  EXPECT_LT(car->state().p_WB_W.y(), 30.0);
  EXPECT_GT(car->state().speed_mps(), 15.0);
}

INSTANTIATE_TEST_SUITE_P(Models, FlatTyre, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
