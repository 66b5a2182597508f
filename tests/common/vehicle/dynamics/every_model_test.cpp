// SPDX-License-Identifier: Apache-2.0
// What holds whatever the model is: a story from drop to reverse, left and right, slopes, places, and the same bits
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/same_bits.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

constexpr double kStep = 0.001;
constexpr double kG = 9.81;

// What the multibody car promises throughout (others: nothing).
struct Watch {
  double off_m = 0.0, off_mps = 0.0;
  int iterations = 0;
  bool converged = true;

  void operator()(VehicleModel& car) {
    auto* multibody = dynamic_cast<MultibodyModel*>(&car);
    if (multibody == nullptr) return;
    off_m = std::max(off_m, multibody->system().Violation());
    off_mps = std::max(off_mps, multibody->system().RateViolation());
    iterations = std::max(iterations, multibody->report().iterations);
    converged = converged && multibody->report().converged;
  }
  void Expect() const {
    EXPECT_TRUE(converged);
    EXPECT_LE(off_m, 1e-8);
    EXPECT_LE(off_mps, 1e-6);
    EXPECT_LE(iterations, 4);
  }
};

class EveryModel : public ::testing::TestWithParam<ModelCase> {};
class EveryBody : public ::testing::TestWithParam<ModelCase> {};

// Dropped (the ground sinks by 20 cm under it), settles, drives off, shifts, brakes, stops, reverses.
TEST_P(EveryModel, IsDroppedSettlesDrivesOffShiftsBrakesStopsAndReverses) {
  auto car = MakeModel(GetParam());
  PlaneGround high(Eigen::Vector3d(0, 0, 0.2), 0.0, 0.0), ground;
  ASSERT_TRUE(car->Initialise({}, high).ok());
  EXPECT_NEAR(car->state().p_WB_W.z(), 0.2, 1e-6);
  double lowest = 1.0;
  bool flew = false;
  for (int i = 0; i < 4000; ++i) {
    car->Step(Neutral(1.0), ground, kStep);
    lowest = std::min(lowest, car->state().p_WB_W.z());
    flew =
        flew || std::ranges::all_of(car->state().wheels, [](const WheelState& wheel) { return wheel.load_N == 0.0; });
  }
  EXPECT_EQ(flew, !GetParam().is_library);
  if (GetParam().is_body) {
    EXPECT_LT(lowest, -0.02) << "its springs are pressed in";
  }
  EXPECT_NEAR(car->state().p_WB_W.z(), 0.0, GetParam().is_mechanism ? 0.02 : 1e-3);
  EXPECT_LT(car->state().v_WB_W.norm(), 1e-2);
  Controls controls;
  controls.throttle = 0.7;
  int gear = 0;
  Watch watch;
  const double y = car->state().p_WB_W.y();
  for (int i = 0; i < 14000; ++i) {
    car->Step(controls, ground, kStep);
    gear = std::max(gear, static_cast<int>(car->state().gear));
    watch(*car);
  }
  EXPECT_GT(car->state().speed_mps(), 20.0);
  EXPECT_GE(gear, GetParam().is_body ? 3 : 1);
  EXPECT_NEAR(car->state().p_WB_W.y(), y, 1e-3);
  controls.throttle = 0.0;
  controls.brake = 0.8;
  for (int i = 0; i < 8000; ++i) {
    car->Step(controls, ground, kStep);
    watch(*car);
  }
  EXPECT_LT(std::fabs(car->state().speed_mps()), 1e-3);
  controls.brake = 0.0;
  controls.gear = -1;
  controls.throttle = 0.3;
  DriveFor(*car, ground, controls, 4.0);
  EXPECT_LT(car->state().speed_mps(), -1.0);
  EXPECT_EQ(car->state().gear, -1);
  watch.Expect();
}

TEST_P(EveryModel, LeftAndRightAreMirrorImages) {
  auto left = MakeModel(GetParam()), right = MakeModel(GetParam());
  PlaneGround ground;
  ASSERT_TRUE(left->Initialise({.speed_mps = 15.0}, ground).ok());
  ASSERT_TRUE(right->Initialise({.speed_mps = 15.0}, ground).ok());
  for (int i = 0; i < 2000; ++i) {
    Controls controls;
    controls.throttle = 0.2;
    controls.steering_wheel_rad = 0.8 * std::sin(0.003 * i);
    left->Step(controls, ground, kStep);
    controls.steering_wheel_rad = -controls.steering_wheel_rad;
    right->Step(controls, ground, kStep);
  }
  EXPECT_GT(left->state().p_WB_W.y(), 0.5);
  EXPECT_NEAR(left->state().p_WB_W.y(), -right->state().p_WB_W.y(), 1e-6);
  EXPECT_NEAR(left->state().p_WB_W.x(), right->state().p_WB_W.x(), 1e-6);
  EXPECT_NEAR(left->state().wheels[kFrontLeft].load_N, right->state().wheels[kFrontRight].load_N, 1e-3);
}

TEST_P(EveryModel, PlacesOutsideAreRefusedAndItStaysAsItWas) {
  auto car = MakeModel(GetParam());
  HillGround ground(1, {.edge_m = 50.0});
  ASSERT_TRUE(car->Initialise({.x_m = 3.0}, ground).ok());
  base::StateWriter before, after;
  car->Save(before);
  for (const InitialCondition& place : {InitialCondition{.x_m = 1000.0}, InitialCondition{.x_m = 49.3}}) {
    const auto refused = car->Initialise(place, ground);
    ASSERT_FALSE(refused.ok()) << place.x_m;
    EXPECT_EQ(refused.error().exit_status(), 2);
    EXPECT_NE(refused.error().message.find("outside of the world"), std::string::npos) << refused.error().Text();
  }
  EXPECT_FALSE(car->Initialise({.x_m = std::nan("")}, ground).ok());
  EXPECT_FALSE(car->Initialise({.speed_mps = std::nan("")}, ground).ok());
  car->Save(after);
  EXPECT_EQ(before.bytes(), after.bytes());
}

// Placed at a speed it rolls on at that speed, whatever the heading.
TEST_P(EveryModel, BeginsInMotion) {
  auto car = MakeModel(GetParam());
  PlaneGround ground(Eigen::Vector3d(0, 0, 3.0), 0.0, 0.0);
  ASSERT_TRUE(car->Initialise({.x_m = -20.0, .y_m = 5.0, .heading_rad = 2.0, .speed_mps = 20.0}, ground).ok());
  EXPECT_NEAR(car->state().speed_mps(), 20.0, 1e-6);
  EXPECT_NEAR(car->state().heading_rad(), 2.0, 1e-9);
  DriveFor(*car, ground, Neutral(), 0.5);
  EXPECT_NEAR(car->state().p_WB_W.x(), -20.0 + 10.0 * std::cos(2.0), 0.2);
  EXPECT_NEAR(car->state().p_WB_W.y(), 5.0 + 10.0 * std::sin(2.0), 0.2);
  EXPECT_NEAR(car->state().p_WB_W.z(), 3.0, 5e-3);
}

// A snapshot, restored into another car of the file, and 1000 steps; a third car does other things meanwhile.
TEST_P(EveryModel, RestoredItGoesOnWithTheSameBits) {
  auto first = MakeModel(GetParam()), second = MakeModel(GetParam()), other = MakeModel(GetParam());
  HillGround ground(3, {});
  ASSERT_TRUE(first->can_save());
  ASSERT_TRUE(first->Initialise({.speed_mps = 10.0}, ground).ok());
  ASSERT_TRUE(second->Initialise({.x_m = 7.0, .speed_mps = 3.0}, ground).ok());
  ASSERT_TRUE(other->Initialise({.x_m = -5.0}, ground).ok());
  Controls controls;
  controls.throttle = 0.5;
  for (int i = 0; i < 700; ++i) {
    controls.steering_wheel_rad = 0.01 * (i % 90);
    first->Step(controls, ground, kStep);
    if (i < 50) second->Step(controls, ground, kStep);
  }
  ExpectTheSameBitsFromASnapshot(*first, *second, 1000, [&](VehicleModel& car, int i) {
    controls.steering_wheel_rad = 0.01 * (i % 70);
    car.Step(controls, ground, kStep);
    if (&car == first.get()) other->Step(controls, ground, kStep);
  });
}

// Two of them from the same place under the same controls, compared after every step.
TEST_P(EveryModel, TwoInstancesAreTheSameToTheBit) {
  auto a = MakeModel(GetParam()), b = MakeModel(GetParam());
  HillGround ground(4, {.amplitude_m = 3.0});
  ASSERT_TRUE(a->Initialise({.speed_mps = 12.0}, ground).ok());
  ASSERT_TRUE(b->Initialise({.x_m = 30.0}, ground).ok());  // another past
  DriveFor(*b, ground, Neutral(0.3), 0.1);
  ASSERT_TRUE(b->Initialise({.speed_mps = 12.0}, ground).ok());
  for (int i = 0; i < 1500; ++i) {
    Controls controls;
    controls.throttle = i < 700 ? 0.6 : 0.0;
    controls.brake = i < 1000 ? 0.0 : 0.5;
    controls.steering_wheel_rad = 1.5 * std::sin(0.004 * i);
    a->Step(controls, ground, kStep);
    b->Step(controls, ground, kStep);
    base::StateWriter of_a(base::StateWriter::Names::kWithout), of_b(base::StateWriter::Names::kWithout);
    a->Save(of_a);
    b->Save(of_b);
    ASSERT_EQ(of_a.digest(), of_b.digest()) << "step " << i;
  }
}

// Whatever the driver does on whatever hills: finite numbers, loads at least 0, one batch a step.
TEST_P(EveryModel, AnythingAnywhereStaysFinite) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto draw = [&](std::uint64_t what, int i, double low, double high) {
      return base::RandomUniform({seed, what, static_cast<std::uint64_t>(i / 200)}, low, high);
    };
    HillGround::Kind kind;
    kind.amplitude_m = 2.0 * static_cast<double>(seed);
    kind.terrace_m = seed == 5 ? 1.0 : 0.0;
    kind.ice = seed == 2;
    HillGround ground(seed, kind);
    auto car = MakeModel(GetParam());
    if (!car->Initialise({.speed_mps = 5.0 * static_cast<double>(seed)}, ground).ok()) continue;
    for (int i = 0; i < 4000; ++i) {
      Controls c;
      c.steering_wheel_rad = draw(0, i, -9.0, 9.0);
      c.throttle = draw(1, i, 0.0, 1.0);
      c.brake = std::max(0.0, draw(2, i, -2.0, 1.0));
      c.handbrake = std::max(0.0, draw(3, i, -4.0, 1.0));
      c.gear = draw(4, i, 0.0, 1.0) < 0.2 ? -1 : 1;
      if (draw(5, i, 0.0, 1.0) < 0.1)
        car->SetPush(
            {{draw(6, i, -2e4, 2e4), draw(7, i, -2e4, 2e4), draw(8, i, 0.0, 2e4)}, {draw(9, i, -1e4, 1e4), 0.0, 0.0}});
      const int before = ground.batches;
      car->Step(c, ground, kStep);
      ASSERT_EQ(ground.batches, before + 1);
      const VehicleState& s = car->state();
      ASSERT_TRUE(s.p_WB_W.allFinite() && s.q_WB.coeffs().allFinite() && s.v_WB_W.allFinite() && s.w_WB_B.allFinite())
          << seed << " " << i;
      ASSERT_LT(s.v_WB_W.norm(), 150.0) << seed << " " << i;
      for (const WheelState& wheel : s.wheels)
        ASSERT_TRUE(std::isfinite(wheel.load_N) && wheel.load_N >= 0.0) << seed << " " << i;
    }
  }
}

// Handbrake on a 20 % slope: at most 1 mm a minute.
TEST_P(EveryBody, TheHandbrakeHoldsOnASlope) {
  auto car = MakeModel(GetParam());
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.2, 0.0);
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  Controls controls = Neutral();
  controls.handbrake = 1.0;
  DriveFor(*car, ground, controls, 10.0, 0.002);
  const Eigen::Vector3d settled = car->state().p_WB_W;
  DriveFor(*car, ground, controls, 60.0, 0.002);
  EXPECT_LT((car->state().p_WB_W - settled).norm(), 1e-3);
}

// In neutral it rolls down: never faster than a sliding block without friction, and not much slower.
TEST_P(EveryBody, RollsDownASlope) {
  auto car = MakeModel(GetParam());
  for (const double slope : {-0.1, 0.1}) {
    PlaneGround ground(Eigen::Vector3d::Zero(), slope, 0.0);
    ASSERT_TRUE(car->Initialise({}, ground).ok());
    DriveFor(*car, ground, Neutral(), 3.0);
    const double free = -kG * std::sin(std::atan(slope)) * 3.0;
    EXPECT_LT(car->state().speed_mps() / free, 1.0);
    EXPECT_GT(car->state().speed_mps() / free, 0.75);
  }
}

// ΣFz = m g where it stands level, and nothing begins to move.
TEST_P(EveryBody, StandsInEquilibrium) {
  auto car = MakeModel(GetParam());
  for (const auto& [slope_x, slope_y] : {std::pair(0.0, 0.0), std::pair(0.1, 0.0), std::pair(-0.05, 0.08)}) {
    PlaneGround ground(Eigen::Vector3d(0, 0, 12.5), slope_x, slope_y);
    ASSERT_TRUE(car->Initialise({.x_m = 100.0, .y_m = -7.0, .heading_rad = 0.7}, ground).ok());
    const VehicleState s = car->state();
    EXPECT_NEAR(s.p_WB_W.x(), 100.0, 1e-9);
    EXPECT_NEAR(s.p_WB_W.y(), -7.0, 1e-9);
    EXPECT_NEAR(s.heading_rad(), 0.7, 1e-9);
    double loads_N = 0.0;
    for (const WheelState& wheel : s.wheels) loads_N += wheel.load_N;
    if (slope_x == 0.0) {
      EXPECT_NEAR(loads_N, car->dimensions().mass_kg * kG, 1e-9 * car->dimensions().mass_kg * kG);
    }
    car->Step(Neutral(1.0), ground, kStep);
    const double solved = GetParam().is_mechanism ? 1e-3 : 1e-6;
    EXPECT_LE(car->state().a_WB_W.norm(), solved) << slope_x;
    EXPECT_LE(car->state().alpha_WB_B.norm(), 2.0 * solved) << slope_x;
    if (auto* mechanism = dynamic_cast<MultibodyModel*>(car.get())) {
      ASSERT_TRUE(car->Initialise({.x_m = 100.0, .y_m = -7.0, .heading_rad = 0.7}, ground).ok());
      EXPECT_FALSE(mechanism->system().qdd().empty());
      for (const double each : mechanism->system().qdd()) EXPECT_LE(std::fabs(each), 1e-6) << slope_x;
    }
  }
}

// At a speed: nothing accelerates either, and with the throttle that INI found it goes on as it began.
TEST_P(EveryBody, AtASpeedItBeginsSteadily) {
  auto car = MakeModel(GetParam());
  for (const auto& [speed_mps, slope_x, slope_y] :
       {std::tuple(15.0, 0.0, 0.0), std::tuple(30.0, 0.0, 0.0), std::tuple(12.0, 0.05, 0.0),
        std::tuple(20.0, -0.01, 0.0), std::tuple(15.0, 0.02, 0.03)}) {
    SCOPED_TRACE(speed_mps);
    PlaneGround ground(Eigen::Vector3d(0, 0, 12.5), slope_x, slope_y);
    ASSERT_TRUE(car->Initialise({.x_m = 100.0, .y_m = -7.0, .speed_mps = speed_mps}, ground).ok());
    const VehicleState s = car->state();
    EXPECT_NEAR(s.p_WB_W.x(), 100.0, 1e-9);
    EXPECT_NEAR(s.p_WB_W.y(), -7.0, 1e-9);
    EXPECT_NEAR(s.speed_mps(), speed_mps, 1e-9);
    if (auto* mechanism = dynamic_cast<MultibodyModel*>(car.get())) {
      for (const double each : mechanism->system().qdd()) EXPECT_LE(std::fabs(each), 1e-6);
    }
    double loads_N = 0.0;
    for (const WheelState& wheel : s.wheels) loads_N += wheel.load_N;
    EXPECT_NEAR(loads_N, car->dimensions().mass_kg * kG / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y),
                1e-6 * loads_N);
    Controls controls;
    controls.gearbox = GearboxMode::kManual;
    controls.gear = s.gear;
    controls.throttle = s.throttle;
    EXPECT_GT(s.throttle, 0.01);
    EXPECT_LT(s.throttle, 0.99);
    // On a slope across the slip that holds the car begins to relax within the step; the mechanism goes by its end.
    if (GetParam().is_mechanism && slope_y != 0.0) continue;
    car->Step(controls, ground, kStep);
    const double solved = GetParam().is_mechanism ? 1e-3 : 1e-6;
    EXPECT_LE(car->state().a_WB_W.norm(), solved);
    EXPECT_LE(car->state().alpha_WB_B.norm(), 2.0 * solved);
    if (slope_y != 0.0) continue;  // from here on the car must be steered
    DriveFor(*car, ground, controls, 2.0);
    EXPECT_NEAR(car->state().speed_mps(), speed_mps, 1e-3);
    EXPECT_NEAR(car->state().p_WB_W.y(), -7.0, 1e-3);
    EXPECT_NEAR(car->state().pitch_rad(), s.pitch_rad(), 1e-5);
    EXPECT_NEAR(car->state().engine_speed_radps, s.engine_speed_radps, 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         ::testing::Values(kBicycle, kOde, kMultibody, kSecondMultibody, kFmu, kLibrary), NameOf);
INSTANTIATE_TEST_SUITE_P(Models, EveryBody, ::testing::Values(kBicycle, kOde, kMultibody, kSecondMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
