// SPDX-License-Identifier: Apache-2.0
// Cars that hit something: momentum, energy and rebound against closed forms, whatever the model; and the same bits
// from a snapshot taken while they touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/vehicle/dynamics/collision_space.hpp"
#include "common/vehicle/dynamics/rigid_body.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/same_bits.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

constexpr double kStep = 0.001;

// Nothing but air and what they hit acts along the ground.
PlaneGround Slippery() { return PlaneGround(Eigen::Vector3d::Zero(), 0.0, 0.0, 1e-9); }

class Collided : public ::testing::TestWithParam<ModelCase> {};

// A push through a quarter of a second, and gone after it: m dv = F t, less what the air took.
TEST_P(Collided, APushGivesItsImpulse) {
  auto car = MakeModel(GetParam());
  auto ground = Slippery();
  ASSERT_TRUE(car->can_be_pushed());
  ASSERT_TRUE(car->Initialise({.speed_mps = 2.0}, ground).ok());
  const Eigen::Vector3d force(3000.0, 0.0, 0.0);
  double air_Ns = 0.0;
  for (int i = 0; i < 4000; ++i) {
    if (i < 250) car->SetPush({force, Eigen::Vector3d(0.0, 0.0, 0.5).cross(force)});
    car->Step(Neutral(), ground, kStep);
    air_Ns += kStep * car->state().drag_N;
  }
  EXPECT_NEAR(car->dimensions().mass_kg * (car->state().speed_mps() - 2.0), 750.0 - air_Ns, 0.5);
}

// Against a wall: the impulses of the touch are the momentum that the car loses and gets back.
TEST_P(Collided, AWallTakesItsMomentumAndGivesSomeBack) {
  auto car = MakeModel(GetParam());
  auto ground = Slippery();
  const CollisionSpace space(car->dimensions(), {});
  const std::vector<Obstacle> wall{{.id = 3, .centre_W = {10.5, 0.0, 1.0}, .half_m = {0.5, 20.0, 2.0}}};
  ASSERT_TRUE(car->Initialise({.speed_mps = 8.0}, ground).ok());
  double impulse_Ns = 0.0, air_Ns = 0.0, deepest = 0.0, most_mps = 0.0;
  int touches = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto touched = space.Touch(car->state(), wall);
    car->SetPush(WrenchOf(touched));
    for (const Impact& impact : touched) {
      ++touches;
      impulse_Ns += kStep * impact.force_W.x();
      deepest = std::max(deepest, impact.depth_m);
    }
    car->Step(Neutral(), ground, kStep);
    air_Ns -= kStep * car->state().drag_N * std::copysign(1.0, car->state().v_WB_W.x());
    most_mps = std::max(most_mps, -car->state().v_WB_W.x());
  }
  const double mass = car->dimensions().mass_kg;
  EXPECT_GT(touches, 20);
  EXPECT_NEAR(mass * (car->state().v_WB_W.x() - 8.0), impulse_Ns + air_Ns, 2e-3 * mass * 8.0);
  EXPECT_LT(car->state().v_WB_W.x(), -0.5);
  EXPECT_GT(car->state().v_WB_W.x(), -8.0);
  // No deeper than a spring alone would let it: v sqrt(m / k).
  EXPECT_LT(deepest, 8.0 * std::sqrt(mass / CollisionSettings{}.stiffness_Npm));
  EXPECT_GT(deepest, 0.5 * 8.0 * std::sqrt(mass / CollisionSettings{}.stiffness_Npm));
  EXPECT_NEAR(car->state().p_WB_W.y(), 0.0, 1e-6);
}

// Against a standing box of known mass on the same ground: momentum stays, energy falls, and what they part with is the
// oscillator's share of what they met with (its mass is m1 m2 / (m1 + m2)).
TEST_P(Collided, AStandingBoxIsPushedAwayAndMomentumStays) {
  auto car = MakeModel(GetParam());
  auto ground = Slippery();
  CollisionSettings settings;
  settings.friction = 0.0;
  const CollisionSpace space(car->dimensions(), settings);
  const double box_kg = 800.0, speed = 8.0, mass = car->dimensions().mass_kg;
  std::vector<Obstacle> box{{.id = 1, .centre_W = {10.0, 0.0, 0.775}, .half_m = {2.0, 0.8, 0.625}}};
  ASSERT_TRUE(car->Initialise({.speed_mps = speed}, ground).ok());
  double air_Ns = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const auto touched = space.Touch(car->state(), box);
    car->SetPush(WrenchOf(touched));
    for (const Impact& impact : touched) box[0].v_WO_W.x() -= kStep / box_kg * impact.force_W.x();
    box[0].centre_W.x() += kStep * box[0].v_WO_W.x();
    car->Step(Neutral(), ground, kStep);
    air_Ns -= kStep * car->state().drag_N;
  }
  const double car_mps = car->state().v_WB_W.x(), box_mps = box[0].v_WO_W.x();
  EXPECT_NEAR(mass * car_mps + box_kg * box_mps, mass * speed + air_Ns, 2e-3 * mass * speed);
  EXPECT_LT(mass * car_mps * car_mps + box_kg * box_mps * box_mps, mass * speed * speed);
  const double reduced = mass * box_kg / (mass + box_kg);
  const double w = std::sqrt(settings.stiffness_Npm / reduced),
               zeta = settings.damping_Nspm / (2.0 * std::sqrt(settings.stiffness_Npm * reduced));
  const double s = std::sqrt(1.0 - zeta * zeta),
               end = (M_PI - std::atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta)) / (w * s);
  const double parts = std::exp(-zeta * w * end) * std::fabs(std::cos(w * s * end) - zeta / s * std::sin(w * s * end));
  EXPECT_NEAR((box_mps - car_mps) / speed, parts, 0.05);
}

// What a snapshot in the middle of a touch does not hold would show here.
TEST_P(Collided, RestoredWhileTouchingItGoesOnWithTheSameBits) {
  auto first = MakeModel(GetParam()), second = MakeModel(GetParam());
  PlaneGround ground;
  const CollisionSpace space(first->dimensions(), {});
  Obstacle barrier{.id = 1,
                   .centre_W = {10.0, 3.0, 0.5},
                   .q_WO = Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())),
                   .half_m = {8.0, 0.15, 1.5}};
  const std::vector<Obstacle> obstacles{barrier};
  ASSERT_TRUE(first->Initialise({.speed_mps = 15.0}, ground).ok());
  Controls controls;
  controls.throttle = 0.5;
  const auto step = [&](VehicleModel& car) {
    const auto touched = space.Touch(car.state(), obstacles);
    car.SetPush(WrenchOf(touched));
    car.Step(controls, ground, kStep);
    return !touched.empty();
  };
  int touching = 0, steps = 0;
  while (touching < 15 && ++steps < 3000) touching += step(*first) ? 1 : 0;
  ASSERT_EQ(touching, 15);
  ExpectTheSameBitsFromASnapshot(*first, *second, 1000, [&](VehicleModel& car, int) { (void)step(car); });
}

INSTANTIATE_TEST_SUITE_P(Models, Collided, ::testing::Values(kBicycle, kOde, kMultibody, kSecondMultibody), NameOf);

// Turned over slowly by a moment about its long axis, the car comes to rest on its side or roof, above the ground.
class Overturned : public ::testing::TestWithParam<ModelCase> {};

TEST_P(Overturned, LiesAboveTheGround) {
  auto car = MakeModel(GetParam());
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.05);
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  bool over = false;
  for (int i = 0; i < 10000; ++i) {
    const VehicleState& s = car->state();
    over = over || (s.q_WB * Eigen::Vector3d::UnitZ()).z() < 0.0;
    if (!over)
      car->SetPush({Eigen::Vector3d::Zero(),
                    s.q_WB * Eigen::Vector3d(std::clamp(3e4 * (2.0 - s.w_WB_B.x()), -3e4, 3e4), 0.0, 0.0)});
    car->Step(Neutral(1.0), ground, kStep);
    ASSERT_TRUE(s.p_WB_W.allFinite()) << i;
  }
  ASSERT_TRUE(over);
  const VehicleState& s = car->state();
  EXPECT_LT((s.q_WB * Eigen::Vector3d::UnitZ()).z(), 0.5) << "it lies on its side or its roof";
  EXPECT_LT(s.v_WB_W.norm(), 0.1);
  const VehicleDimensions& d = car->dimensions();
  const Eigen::Vector3d normal = Eigen::Vector3d(0.0, -0.05, 1.0).normalized();
  double lowest = 1.0;
  for (const double x : {d.front_m, -d.rear_m}) {
    for (const double y : {-0.5 * d.width_m, 0.5 * d.width_m}) {
      for (const double z : {0.16, d.height_m})
        lowest = std::min(lowest, (s.p_WB_W + s.q_WB * Eigen::Vector3d(x, y, z)).dot(normal));
    }
  }
  EXPECT_GT(lowest, -0.03);
  EXPECT_LT(lowest, 0.1) << "it floats";
}

INSTANTIATE_TEST_SUITE_P(Models, Overturned, ::testing::Values(kOde, kMultibody, kSecondMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
