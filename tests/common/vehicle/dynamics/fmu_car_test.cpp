// SPDX-License-Identifier: Apache-2.0
// A laboratory's own car as an FMU: it drives by its own equations, is saved and restored where it offers that, and
// fails in a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/vehicle/dynamics/fmu_model.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;
using ::testing::HasSubstr;

constexpr double kStep = 0.001;

class FmuCar : public ::testing::Test {
 protected:
  std::unique_ptr<VehicleModel> Car(const std::string& more = "") const {
    folder_.Pack(changes_);
    auto car = LoadVehicle(folder_.WriteCar(more));
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return std::move(car).value();
  }
  std::string Refusal(const std::vector<std::pair<std::string, std::string>>& changes,
                      const std::string& more = "") const {
    folder_.Pack(changes);
    const auto car = LoadVehicle(folder_.WriteCar(more));
    EXPECT_FALSE(car.ok());
    if (car.ok()) return "";
    EXPECT_EQ(car.error().exit_status(), 2);
    return car.error().Text();
  }

  fmi::FmuFolder folder_;
  std::vector<std::pair<std::string, std::string>> changes_;
};

// Placed, accelerated, turned, braked: against the closed forms of its own equations.
TEST_F(FmuCar, DrivesByItsOwnEquations) {
  auto car = Car();
  PlaneGround ground(Eigen::Vector3d(0, 0, 5.0), 0.0, 0.0);
  ASSERT_TRUE(car->Initialise({.x_m = 10.0, .y_m = -3.0, .heading_rad = 0.5}, ground).ok());
  EXPECT_EQ(car->state().p_WB_W, Eigen::Vector3d(10.0, -3.0, 5.0));
  EXPECT_NEAR(car->state().heading_rad(), 0.5, 1e-12);
  Controls controls;
  controls.throttle = 0.5;
  for (int i = 0; i < 10000; ++i) car->Step(controls, ground, kStep);
  ASSERT_TRUE(car->problem().ok());
  const double v = 30.0 * (1.0 - std::exp(-0.5)), way = 30.0 * (10.0 - 20.0 * (1.0 - std::exp(-0.5)));
  EXPECT_NEAR(car->state().speed_mps(), v, 0.01);
  EXPECT_NEAR(car->state().p_WB_W.x(), 10.0 + way * std::cos(0.5), 0.02);
  EXPECT_NEAR(car->state().odometer_m, way, 0.02);
  controls.steering_wheel_rad = 1.6;
  for (int i = 0; i < 100; ++i) car->Step(controls, ground, kStep);
  EXPECT_NEAR(car->state().w_WB_B.z(), car->state().speed_mps() * std::tan(0.1) / 2.5, 0.01);
  EXPECT_NEAR(car->state().wheels[kFrontLeft].steer_rad, 0.1, 1e-12);
  EXPECT_NEAR(car->state().a_WB_B().y(), car->state().w_WB_B.z() * car->state().speed_mps(), 0.2);
  controls.throttle = 0.0;
  controls.brake = 1.0;
  for (int i = 0; i < 4000; ++i) car->Step(controls, ground, kStep);
  EXPECT_EQ(car->state().speed_mps(), 0.0);
}

// What pushes the car reaches the FMU's inputs in the step for which it was said; an FMU without them takes no notice.
TEST_F(FmuCar, IsPushedWhereItHasTheInputs) {
  PlaneGround ground;
  auto car = Car();
  EXPECT_TRUE(car->can_be_pushed());
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  for (int i = 0; i < 1000; ++i) {
    car->SetPush({{2000.0, 0.0, 0.0}, Eigen::Vector3d::Zero()});
    car->Step({}, ground, kStep);
  }
  const double v = 2.0 / 0.05 * (1.0 - std::exp(-0.05));  // dv/dt = F/m - 0.05 v
  EXPECT_NEAR(car->state().speed_mps(), v, 1e-3);
  for (int i = 0; i < 1000; ++i) car->Step({}, ground, kStep);
  EXPECT_NEAR(car->state().speed_mps(), v * std::exp(-0.05), 1e-3);
  changes_ = {{"name=\"push_moment_y_Nm\"", "name=\"pitching_moment\""}};
  auto deaf = Car();
  EXPECT_FALSE(deaf->can_be_pushed());
}

TEST_F(FmuCar, KnowsTheGroundUnderItsWheelsAndTheEdgeOfTheWorld) {
  auto car = Car();
  HillGround hills(1, {.edge_m = 50.0});
  ASSERT_TRUE(car->Initialise({.speed_mps = 8.0}, hills).ok());
  for (int i = 0; i < 4000; ++i) {
    const int before = hills.batches;
    car->Step({}, hills, kStep);
    ASSERT_EQ(hills.batches, before + 1);
  }
  const Eigen::Vector3d p = car->state().p_WB_W;
  EXPECT_NEAR(p.z(), hills.At(p.x(), p.y()).z_m, 0.1);
  EXPECT_THAT(car->Initialise({.x_m = 100.0}, hills).error().Text(), HasSubstr("outside of the world"));
  EXPECT_EQ(car->state().p_WB_W, p);
  car->Step({}, hills, kStep);
  EXPECT_TRUE(car->problem().ok()) << "it goes on";
}

TEST_F(FmuCar, WithoutStatesItCannotBeSavedAndSaysSo) {
  changes_ = {{"canSerializeFMUstate=\"true\"", "canSerializeFMUstate=\"false\""}};
  auto car = Car();
  EXPECT_FALSE(car->can_save());
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  base::StateWriter before, after;
  car->Save(before);
  Controls controls;
  controls.throttle = 1.0;
  car->Step(controls, ground, kStep);
  car->Step(controls, ground, kStep);
  car->Save(after);
  EXPECT_NE(before.bytes(), after.bytes()) << "what is known of it is in the digests";
}

TEST_F(FmuCar, AFailureIsToldAndTheCarStays) {
  PlaneGround ground;
  Controls controls;
  controls.throttle = 1.0;
  for (const auto& [parameter, what] : {std::pair("fail_at_s", "fmi2DoStep: error: the tank is empty at 0.5 s"),
                                        std::pair("nonsense_at_s", "its output 'y_m' is not a finite number")}) {
    auto car = Car(std::string("parameters: {") + parameter + ": 0.5}\n");
    ASSERT_TRUE(car->Initialise({}, ground).ok());
    for (int i = 0; i < 500; ++i) car->Step(controls, ground, kStep);
    ASSERT_TRUE(car->problem().ok());
    const Eigen::Vector3d p = car->state().p_WB_W;
    for (int i = 0; i < 10; ++i) car->Step(controls, ground, kStep);
    ASSERT_FALSE(car->problem().ok()) << parameter;
    EXPECT_THAT(car->problem().error().Text(), HasSubstr(what));
    EXPECT_EQ(car->problem().error().exit_status(), 1);
    EXPECT_EQ(car->state().p_WB_W, p);
    EXPECT_TRUE(car->Initialise({}, ground).ok()) << "a new instance";
    car->Step(controls, ground, kStep);
    EXPECT_TRUE(car->problem().ok());
  }
}

TEST_F(FmuCar, WrongFilesAreRefused) {
  EXPECT_THAT(Refusal({{"name=\"velocity_x_mps\"", "name=\"velocity_x\""}}),
              HasSubstr("no variable 'velocity_x_mps' (an output); did you mean 'velocity_x'?"));
  EXPECT_THAT(Refusal({{"name=\"start_x_m\"", "name=\"begin_x_m\""}}), HasSubstr("no variable 'start_x_m'"));
  EXPECT_THAT(Refusal({{"valueReference=\"0\" causality=\"output\"><Real unit=\"m\"",
                        "valueReference=\"0\" causality=\"output\"><Real unit=\"kg\""}}),
              HasSubstr("modelDescription.xml:6: 'x_m' of the FMU is declared in 'kg'; 'm' was expected"));
  EXPECT_THAT(Refusal({{"valueReference=\"13\" causality=\"input\"", "valueReference=\"13\" causality=\"output\""}}),
              HasSubstr("'throttle' of the FMU is declared 'output'; 'input' was expected"));
  EXPECT_THAT(Refusal({{"<Real unit=\"rad\"/>", "<String/>"}}), HasSubstr("is no number"));
  EXPECT_THAT(Refusal({}, "parameters: {fail_at: 3}\n"),
              HasSubstr("no parameter 'fail_at'; did you mean 'fail_at_s'?"));
  folder_.Pack();
  const auto file = folder_.WriteCar();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = base::ReadText(file).value();
    text.replace(text.find(from), from.size(), to);
    const auto other = folder_.path() / "other.yaml";
    EXPECT_TRUE(base::WriteWhole(other, text).ok());
    const auto car = LoadVehicle(other);
    EXPECT_FALSE(car.ok());
    return car.ok() ? "" : car.error().Text();
  };
  EXPECT_THAT(with("heading_rad: body.yaw", "heading_rad: body.jaw"), HasSubstr("no variable 'body.jaw'"));
  EXPECT_THAT(with("{heading_rad: body.yaw", "{throtle: throttle, heading_rad: body.yaw"),
              HasSubstr("'names.throtle' is no variable of a vehicle; did you mean 'throttle'?"));
  EXPECT_THAT(with("fmu: car.fmu", "fmu: none.fmu"), HasSubstr("no such file"));
  EXPECT_THAT(with("fmu: car.fmu", "fmu: car.yaml"), HasSubstr("a ZIP archive was expected"));
  EXPECT_THAT(with("mass_kg: 1000", "mass_kg: -1"), HasSubstr("other.yaml:"));
}

TEST_F(FmuCar, OneThatCannotBeginInMotionRefusesTo) {
  changes_ = {{"name=\"start_speed_mps\"", "name=\"initial_speed\""}};
  auto car = Car();
  PlaneGround ground;
  EXPECT_THAT(car->Initialise({.speed_mps = 5.0}, ground).error().Text(),
              HasSubstr("cannot begin in motion: it has no variable 'start_speed_mps'"));
  EXPECT_TRUE(car->Initialise({}, ground).ok());
}

}  // namespace
}  // namespace rodeira::dynamics
