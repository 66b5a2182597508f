// SPDX-License-Identifier: Apache-2.0
// What holds whatever the driver does and wherever the car is.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/long_form.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

// Controls that change a few times a second, with everything that is allowed and some that is not.
Controls WildControls(std::uint64_t seed, int step) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what, static_cast<std::uint64_t>(step / 200)}, low, high);
  };
  Controls c;
  c.steering_wheel_rad = draw(0, -12, 12);
  c.throttle = draw(1, -0.5, 1.5);
  c.brake = std::max(0.0, draw(2, -2, 1.2));
  c.clutch = draw(3, -0.5, 1.5);
  c.handbrake = std::max(0.0, draw(4, -5, 1));
  c.gear = static_cast<int>(draw(5, -2, 7.99));
  c.gearbox = draw(6, 0, 1) < 0.5 ? GearboxMode::kAutomatic : GearboxMode::kManual;
  c.starter = draw(7, 0, 1) < 0.2;
  if (draw(8, 0, 1) < 0.02) c.throttle = std::nan("");
  return c;
}

HillGround::Kind WildGround(std::uint64_t seed) {
  const auto draw = [&](std::uint64_t what) { return base::RandomUniform({seed, what, 99}); };
  HillGround::Kind kind;
  kind.amplitude_m = 12.0 * draw(0);
  kind.wave_m = 10.0 + 100.0 * draw(1);
  kind.terrace_m = draw(2) < 0.25 ? 2.0 * draw(3) : 0.0;
  kind.edge_m = draw(4) < 0.3 ? 150.0 : std::numeric_limits<double>::infinity();
  kind.ice = draw(5) < 0.3;
  return kind;
}

bool Sane(const VehicleState& s) {
  const bool finite = s.p_WB_W.allFinite() && s.q_WB.coeffs().allFinite() && s.v_WB_W.allFinite() &&
                      s.w_WB_B.allFinite() && s.a_WB_W.allFinite() && std::isfinite(s.engine_speed_radps) &&
                      std::isfinite(s.fuel_kg);
  if (!finite || std::fabs(s.q_WB.norm() - 1.0) > 1e-9) return false;
  // A car that rolls back in gear turns its stalled engine backward; first gear at 60 m/s would turn it at 3100 rad/s.
  if (s.v_WB_W.norm() > 150.0 || std::fabs(s.engine_speed_radps) > 3500.0) return false;
  if (s.fuel_rate_kgps < 0.0) return false;
  for (const WheelState& wheel : s.wheels) {
    if (!std::isfinite(wheel.load_N) || wheel.load_N < 0.0 || !std::isfinite(wheel.spin_radps)) return false;
    if (std::hypot(wheel.longitudinal_N, wheel.lateral_N) > 2.0 * wheel.load_N + 1e-6) return false;
  }
  return true;
}

RC_GTEST_PROP(BicycleProperty, StaysSaneUnderAnyControlsOnAnyGround, (std::uint32_t seed)) {
  HillGround ground(seed, WildGround(seed));
  BicycleModel car(DefaultSettings());
  const InitialCondition initial{.heading_rad = base::RandomUniform({seed, 7}, -3, 3),
                                 .speed_mps = base::RandomUniform({seed, 8}, -10, 60)};
  RC_ASSERT(car.Initialise(initial, ground).ok());
  RC_ASSERT(Sane(car.state()));
  for (int i = 0; i < BriefOrLong(1300, 5000); ++i) {
    car.Step(WildControls(seed, i), ground, kStep_s);
    RC_ASSERT(Sane(car.state()));
  }
}

RC_GTEST_PROP(BicycleProperty, RestoredAnywhereItGoesOnWithTheSameBits, (std::uint32_t seed)) {
  HillGround ground(seed, {.amplitude_m = 3.0, .ice = true});
  BicycleModel car(DefaultSettings());
  RC_ASSERT(car.Initialise({.speed_mps = 15.0}, ground).ok());
  const int restore_at = static_cast<int>(base::RandomUniform({seed, 5}, 0, BriefOrLong(600, 2000)));
  BicycleModel other(DefaultSettings());
  for (int i = 0; i < BriefOrLong(1000, 3000); ++i) {
    if (i == restore_at) {
      base::StateWriter writer;
      car.Save(writer);
      base::StateReader reader(writer.bytes());
      other.Restore(reader);
      RC_ASSERT(reader.Finish().ok());
    }
    const Controls controls = WildControls(seed, i);
    car.Step(controls, ground, kStep_s);
    if (i >= restore_at) {
      other.Step(controls, ground, kStep_s);
      if (i % 50 == 0 || i == restore_at) RC_ASSERT(DigestOf(car) == DigestOf(other));
    }
  }
  RC_ASSERT(DigestOf(car) == DigestOf(other));
}

TEST(BicycleProperty, TheSameCallsGiveTheSameBits) {
  HillGround ground(3, {});
  BicycleModel a = PlacedCar(DefaultSettings(), ground, {.speed_mps = 10.0});
  BicycleModel b = PlacedCar(DefaultSettings(), ground, {.speed_mps = 10.0});
  for (int i = 0; i < 3000; ++i) {
    a.Step(WildControls(3, i), ground, kStep_s);
    b.Step(WildControls(3, i), ground, kStep_s);
    ASSERT_EQ(DigestOf(a), DigestOf(b)) << i;
  }
}

TEST(BicycleProperty, AsksTheGroundOnceAStep) {
  HillGround ground(1, {});
  BicycleModel car = PlacedCar(DefaultSettings(), ground, {.speed_mps = 10.0});
  for (const double dt : {0.0005, 0.001, 0.01, 0.1}) {
    const int before = ground.batches;
    car.Step({}, ground, dt);
    EXPECT_EQ(ground.batches, before + 1);
  }
}

TEST(BicycleProperty, LongerStepsOnAPlaneAreTheSameMotion) {
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.03, -0.02);
  BicycleModel fine = PlacedCar(DefaultSettings(), ground, {.speed_mps = 20.0});
  BicycleModel coarse = PlacedCar(DefaultSettings(), ground, {.speed_mps = 20.0});
  for (int i = 0; i < 300; ++i) {
    Controls controls;
    controls.steering_wheel_rad = 0.5 * std::sin(i * 0.05);
    controls.throttle = 0.4;
    for (int k = 0; k < 10; ++k) fine.Step(controls, ground, 0.001);
    coarse.Step(controls, ground, 0.01);
  }
  EXPECT_LT((fine.state().p_WB_W - coarse.state().p_WB_W).norm(), 1e-6);
}

// Halving the step changes the path by an amount that halves: first order, and small at 1 ms.
TEST(BicycleProperty, ConvergesWithTheStep) {
  PlaneGround ground;
  const auto end = [&](double dt) {
    BicycleModel car = PlacedCar(DefaultSettings(), ground, {.speed_mps = 20.0});
    for (int i = 0; i * dt < 4.0 - 1e-9; ++i) {
      Controls controls;
      controls.gearbox = GearboxMode::kManual;
      controls.gear = 0;
      controls.steering_wheel_rad = 0.6;
      car.Step(controls, ground, dt);
    }
    return car.state().p_WB_W;
  };
  const Eigen::Vector3d one = end(0.001), half = end(0.0005), quarter = end(0.00025);
  EXPECT_LT((one - half).norm(), 0.02);
  EXPECT_NEAR((one - half).norm() / (half - quarter).norm(), 2.0, 0.3);
}

TEST(BicycleProperty, PlacedOnHillsItIsNearRest) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    HillGround ground(seed, {.amplitude_m = 4.0, .wave_m = 50.0});
    BicycleModel car = PlacedCar(DefaultSettings(), ground,
                                 {.x_m = 5.0 * static_cast<double>(seed), .heading_rad = static_cast<double>(seed)});
    const Eigen::Vector3d placed = car.state().p_WB_W;
    Controls hold;
    hold.brake = 1.0;
    hold.gear = 0;
    double fastest = 0.0;
    Drive(car, ground, hold, 2.0, [&](int) { fastest = std::max(fastest, car.state().v_WB_W.norm()); });
    EXPECT_LT((car.state().p_WB_W - placed).norm(), 2e-3) << seed;
    EXPECT_LT(fastest, 0.02) << seed;
  }
}

TEST(BicycleProperty, OutsideOfTheWorldItIsRefusedAtTheStartAndCarriedOnLater) {
  HillGround ground(2, {.amplitude_m = 1.0, .edge_m = 50.0});
  BicycleModel car(DefaultSettings());
  const base::Status refused = car.Initialise({.x_m = 60.0}, ground);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().Text().find("outside of the world"), std::string::npos);
  EXPECT_FALSE(car.Initialise({.x_m = 49.5}, ground).ok());  // two wheels over the edge
  EXPECT_FALSE(car.Initialise({.speed_mps = std::nan("")}, ground).ok());
  ASSERT_TRUE(car.Initialise({.speed_mps = 20.0}, ground).ok());
  Drive(car, ground, {}, 5.0);
  EXPECT_GT(car.state().p_WB_W.x(), 55.0);
  EXPECT_FALSE(car.state().inside_world);
  EXPECT_TRUE(Sane(car.state()));
}

TEST(BicycleProperty, AMovingCarIsHandedOver) {
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.02, 0.01);
  BicycleModel first = PlacedCar(DefaultSettings(), ground, {.speed_mps = 20.0});
  Controls bend;
  bend.steering_wheel_rad = 0.4;
  bend.throttle = 0.3;
  Drive(first, ground, bend, 3.0);
  BicycleModel second = PlacedCar(DefaultSettings(), ground, FromState(first.state()));
  EXPECT_LT((first.state().p_WB_W - second.state().p_WB_W).norm(), 0.01);
  EXPECT_LT((first.state().v_WB_W - second.state().v_WB_W).norm(), 0.1);
  Drive(first, ground, bend, 1.0);
  Drive(second, ground, bend, 1.0);
  EXPECT_LT((first.state().p_WB_W - second.state().p_WB_W).norm(), 0.5);
  EXPECT_NEAR(first.state().w_WB_B.z(), second.state().w_WB_B.z(), 0.02);
}

}  // namespace
}  // namespace rodeira::dynamics
