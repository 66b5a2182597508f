// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the vehicle models: a step's length, arrays of one length, kinds and places that exist.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "common/vehicle/dynamics/car_array.hpp"
#include "common/vehicle/dynamics/powertrain_array.hpp"
#include "common/vehicle/dynamics/tyre_pressure.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

// Lengths of a step that no model takes.
const std::vector<double> kNoSteps_s{0.0, -0.001, 0.1001, std::numeric_limits<double>::quiet_NaN()};

// A model on the ground.
struct OnGround {
  explicit OnGround(const ModelCase& model) : car(MakeModel(model)) { EXPECT_TRUE(car->Initialise({}, ground).ok()); }
  void Step(double dt_s) { car->Step({}, ground, dt_s); }

  PlaneGround ground;
  std::unique_ptr<VehicleModel> car;
};

TEST(ContractsDeathTest, AModelsStepIsLongerThanNothingAndAtMostATenthOfASecond) {
  OnGround bicycle(kBicycle), ode(kOde), multibody(kMultibody), fmu(kFmu);
  for (const double dt_s : kNoSteps_s) {
    EXPECT_DEATH(bicycle.Step(dt_s), "bicycle_model.cpp.*dt_s <= kMaxStep_s") << dt_s;
    EXPECT_DEATH(ode.Step(dt_s), "ode_model.cpp.*dt_s <= kMaxStep_s") << dt_s;
    EXPECT_DEATH(multibody.Step(dt_s), "multibody_model.cpp.*dt_s <= kMaxStep_s") << dt_s;
    EXPECT_DEATH(fmu.Step(dt_s), "fmu_model.cpp.*dt_s <= kMaxStep_s") << dt_s;
  }
  for (OnGround* one : {&bicycle, &ode, &multibody, &fmu}) one->Step(0.1);
}

TEST(ContractsDeathTest, AnArrayTakesControlsForEachOfItsCars) {
  PlaneGround ground;
  CarArray cars;
  const auto kind = cars.AddKind(DefaultSettings());
  ASSERT_TRUE(kind.ok());
  ASSERT_TRUE(cars.Add(kind.value(), {}, ground).ok());
  cars.Step(std::vector<Controls>(1), ground, 0.01);
  EXPECT_DEATH(cars.Step(std::vector<Controls>(2), ground, 0.01), "controls.size\\(\\) == cars_.size\\(\\)");
  for (const double dt_s : kNoSteps_s) {
    EXPECT_DEATH(cars.Step(std::vector<Controls>(1), ground, dt_s), "car_array.cpp.*dt_s > 0.0") << dt_s;
  }
}

TEST(ContractsDeathTest, ACarIsOfAKindAndAtAPlaceOfTheArray) {
  PlaneGround ground;
  CarArray cars;
  const auto kind = cars.AddKind(DefaultSettings());
  ASSERT_TRUE(kind.ok());
  cars.Resize(1);
  EXPECT_TRUE(cars.Place(0, kind.value(), {}, ground).ok());
  EXPECT_DEATH((void)cars.Place(0, kind.value() + 1, {}, ground), "kind < chassis_.size\\(\\)");
  EXPECT_DEATH((void)cars.Place(1, kind.value(), {}, ground), "i < size\\(\\)");
}

TEST(ContractsDeathTest, PowertrainsHaveArraysOfOneLength) {
  const PowertrainSettings settings = DefaultSettings().powertrain;
  const std::vector<const PowertrainSettings*> all(2, &settings);
  const std::vector<Controls> controls(2);
  const std::vector<PowertrainInput> inputs(2);
  std::vector<Powertrain> cars(2);
  for (Powertrain& car : cars) car.Start(settings, 0.0);
  const auto step = [&](std::size_t settings_of, std::size_t controls_of, std::size_t inputs_of) {
    StepPowertrains(std::span(all).first(settings_of), std::span(controls).first(controls_of),
                    std::span(inputs).first(inputs_of), 0.001, cars);
  };
  step(2, 2, 2);
  EXPECT_DEATH(step(1, 2, 2), "settings.size\\(\\) == cars.size\\(\\)");
  EXPECT_DEATH(step(2, 1, 2), "settings.size\\(\\) == cars.size\\(\\)");
  EXPECT_DEATH(step(2, 2, 1), "settings.size\\(\\) == cars.size\\(\\)");
}

TEST(ContractsDeathTest, APressureIsAShareOfTheTyresOwn) {
  TyreSettings tyre = DefaultSettings().tyre[0];
  for (const double share : {-0.01, 1.51}) EXPECT_DEATH(SetPressure(tyre, share), "share <= kMaxPressureShare");
  SetPressure(tyre, 1.5);
  EXPECT_GT(tyre.vertical_share, 1.0);
}

}  // namespace
}  // namespace rodeira::dynamics
