// SPDX-License-Identifier: Apache-2.0
// A vehicle model of a laboratory's own, as a shared object: it drives as it says, and what is wrong with it is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/own_vehicle.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;
using ::testing::AllOf;
using ::testing::HasSubstr;

class OwnVehicle : public ::testing::Test {
 protected:
  std::string ProblemAfter(const std::string& from, const std::string& to) const {
    const auto car = LoadVehicle(folder_.Write(from, to));
    if (car.ok()) return "";
    EXPECT_EQ(car.error().exit_status(), 2);
    return car.error().Text();
  }
  std::string OddText(const std::string& fault) const {
    return "rodeira: vehicle/1\nmodel: library\nlibrary: odd_vehicle.so\nfault: " + fault + "\n";
  }
  std::string OddFile(const std::string& fault) const { return ProblemAfter(whole_, OddText(fault)); }
  std::unique_ptr<VehicleModel> Odd(const std::string& fault) const {
    auto car = LoadVehicle(folder_.Write(whole_, OddText(fault)));
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return car.ok() ? std::move(car).value() : nullptr;
  }
  const OwnVehicleFolder folder_;
  const std::string whole_ = base::ReadText(folder_.Write()).value();  // the example's vehicle file
};

// Closed form: the middle of the rear axle stays on a circle of radius L / tan(steer), whatever the speed.
TEST_F(OwnVehicle, TheExampleDrivesCirclesOfItsWheelbaseAndSteering) {
  const auto car = LoadVehicle(folder_.Write());
  ASSERT_TRUE(car.ok()) << car.error().Text();
  VehicleModel& model = *car.value();
  PlaneGround ground(Eigen::Vector3d(0, 0, 4.0), 0.0, 0.0);
  ASSERT_TRUE(model.Initialise({.x_m = 30.0, .y_m = -10.0, .speed_mps = 5.0}, ground).ok());
  const Controls controls{.steering_wheel_rad = 3.0, .throttle = 0.4};
  const double radius_m = 2.5 / std::tan(3.0 / 15.0);
  const Eigen::Vector2d centre(30.0 - 1.25, -10.0 + radius_m);
  double way_m = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    model.Step(controls, ground, 0.001);
    const VehicleState& s = model.state();
    const Eigen::Vector3d rear = s.p_WB_W - 1.25 * (s.q_WB * Eigen::Vector3d::UnitX());
    ASSERT_NEAR((rear.head<2>() - centre).norm(), radius_m, 1e-9) << i;
    way_m = s.odometer_m;
  }
  EXPECT_GT(way_m, 4.0 * M_PI * radius_m) << "twice around";
  // Its final speed is that of a = c v², by throttle and drag.
  DriveFor(model, ground, {.throttle = 0.4}, 300.0, 0.01);
  EXPECT_NEAR(model.state().speed_mps(), std::sqrt(0.4 * 3.0 / 0.0005), 1e-3);
  EXPECT_NEAR(model.state().p_WB_W.z(), 4.0, 1e-9);
}

// On a slope of 10 % it loses what gravity takes: energy is kept without drive, drag and brake.
TEST_F(OwnVehicle, TheExampleKeepsItsEnergyOnASlope) {
  auto car = LoadVehicle(folder_.Write("drag_per_m: 0.0005", "drag_per_m: 0"));
  ASSERT_TRUE(car.ok()) << car.error().Text();
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.1, 0.0);
  ASSERT_TRUE(car.value()->Initialise({.speed_mps = 10.0}, ground).ok());
  const auto energy = [&] {
    const VehicleState& s = car.value()->state();
    return 0.5 * s.v_WB_W.squaredNorm() + 9.81 * s.p_WB_W.z();
  };
  const double before = energy();
  DriveFor(*car.value(), ground, {.gear = 0}, 15.0);
  EXPECT_NEAR(energy(), before, 1e-6 * before);
  EXPECT_LT(car.value()->state().speed_mps(), -4.0) << "it rolls back";
}

TEST_F(OwnVehicle, WhatIsWrongWithTheFileIsToldWithItsLine) {
  EXPECT_THAT(ProblemAfter("library: kinematic_car.so\n", ""), HasSubstr("key 'library' is missing"));
  EXPECT_THAT(ProblemAfter("kinematic_car.so", "kinematic_cart.so"),
              AllOf(HasSubstr("car.yaml:4: "), HasSubstr("cannot load the shared object"), HasSubstr("No such file")));
  EXPECT_THAT(ProblemAfter("kinematic_car.so", "car.yaml"), HasSubstr("cannot load the shared object"));
  EXPECT_THAT(ProblemAfter("kinematic_car.so", "no_vehicle.so"),
              AllOf(HasSubstr("no entry point 'rodeira_vehicle_build'"), HasSubstr("RODEIRA_VEHICLE")));
  EXPECT_THAT(ProblemAfter("kinematic_car.so", "vehicle_of_another_build.so"),
              AllOf(HasSubstr("was built with an earlier Rodeira"), HasSubstr("build it again")));
  EXPECT_THAT(ProblemAfter("wheelbase_m: 2.5", "wheelbase_m: 99"), HasSubstr("car.yaml:7: 'wheelbase_m' is 99"));
  EXPECT_THAT(ProblemAfter("wheelbase_m: 2.5", "wheelbas_m: 2.5"), HasSubstr("wheelbase_m"));
  EXPECT_THAT(ProblemAfter("model: library", "model: libary"), HasSubstr("did you mean 'library'?"));
  EXPECT_THAT(OddFile("no_dimensions"), AllOf(HasSubstr("car.yaml:3: "), HasSubstr("dimension height_m is 0")));
  EXPECT_THAT(OddFile("none"), AllOf(HasSubstr("car.yaml:3: "), HasSubstr("made no model")));
}

TEST_F(OwnVehicle, AStateThatIsNotFiniteEndsTheDrive) {
  PlaneGround ground;
  const auto start = Odd("nan_at_start");
  ASSERT_NE(start, nullptr);
  EXPECT_FALSE(start->Initialise({}, ground).ok());
  const auto car = Odd("nan_after_step");
  ASSERT_NE(car, nullptr);
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  DriveFor(*car, ground, {}, 0.05, 0.01);
  EXPECT_TRUE(car->problem().ok());
  DriveFor(*car, ground, {}, 0.2, 0.01);
  ASSERT_FALSE(car->problem().ok());
  EXPECT_EQ(car->problem().error().exit_status(), 1);
  EXPECT_THAT(car->problem().error().Text(), HasSubstr("state is not finite"));
  EXPECT_TRUE(car->state().v_WB_W.allFinite()) << "what is published stays finite";
}

}  // namespace
}  // namespace rodeira::dynamics
