// SPDX-License-Identifier: Apache-2.0
// The car's box among obstacles: what touches, the force of it, momentum and rebound against closed forms, and the same
// bits.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/vehicle/dynamics/collision_space.hpp"
#include "common/vehicle/dynamics/rigid_body.hpp"

namespace rodeira::dynamics {
namespace {

const VehicleDimensions kCar{.front_m = 2.0, .rear_m = 1.8, .width_m = 1.6, .height_m = 1.4};

VehicleState CarAt(double x, double y, double heading, double speed) {
  VehicleState car;
  car.p_WB_W = {x, y, 0.0};
  car.q_WB = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ());
  car.v_WB_W = speed * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0);
  return car;
}

// A wall across the way: its near face stands at x = 10.
const Obstacle kWall{.id = 7, .centre_W = {10.5, 0.0, 0.7}, .half_m = {0.5, 20.0, 0.7}};

TEST(CollisionSpace, TouchesWhatItsOutlineReaches) {
  const CollisionSpace space(kCar, {});
  EXPECT_TRUE(space.Touch(CarAt(7.99, 0.0, 0.0, 0.0), std::vector{kWall}).empty());
  const auto touched = space.Touch(CarAt(8.02, 0.0, 0.0, 0.0), std::vector{kWall});
  ASSERT_EQ(touched.size(), 1u);
  EXPECT_EQ(touched[0].id, 7u);
  EXPECT_NEAR(touched[0].depth_m, 0.02, 1e-9);
  EXPECT_NEAR(touched[0].normal_W.x(), -1.0, 1e-9);
  EXPECT_NEAR(touched[0].force_W.x(), -1e6 * 0.02, 1e-3);
  EXPECT_NEAR(touched[0].point_W.y(), 0.0, 1e-6);
  // Backwards with the rear, sideways with a side, turned by 90 degrees with the front.
  EXPECT_TRUE(space.Touch(CarAt(8.19, 0.0, M_PI, 0.0), std::vector{kWall}).empty());
  EXPECT_FALSE(space.Touch(CarAt(8.21, 0.0, M_PI, 0.0), std::vector{kWall}).empty());
  EXPECT_TRUE(space.Touch(CarAt(9.19, 0.0, M_PI / 2, 0.0), std::vector{kWall}).empty());
  EXPECT_FALSE(space.Touch(CarAt(9.21, 0.0, M_PI / 2, 0.0), std::vector{kWall}).empty());
  // What lies lower than its underside it drives over.
  Obstacle kerb = kWall;
  kerb.centre_W.z() = 0.05;
  kerb.half_m.z() = 0.05;
  EXPECT_TRUE(space.Touch(CarAt(9.0, 0.0, 0.0, 0.0), std::vector{kerb}).empty());
}

TEST(CollisionSpace, ThePartnerFeelsTheOppositeForce) {
  const CollisionSpace space(kCar, {});
  // Two equal cars, one turned, one moving: each seen as the other's obstacle.
  const VehicleState a = CarAt(0.0, 0.0, 0.0, 9.0), b = CarAt(2.6, 0.3, 2.0, 4.0);
  const auto obstacle = [](const VehicleState& car) {
    Obstacle out;
    out.q_WO = car.q_WB;
    out.centre_W = car.p_WB_W + car.q_WB * Eigen::Vector3d(0.1, 0.0, 0.775);
    out.half_m = {1.9, 0.8, 0.625};
    out.v_WO_W = car.v_WB_W;
    return out;
  };
  const auto on_a = space.Touch(a, std::vector{obstacle(b)}), on_b = space.Touch(b, std::vector{obstacle(a)});
  ASSERT_EQ(on_a.size(), 1u);
  ASSERT_EQ(on_b.size(), 1u);
  EXPECT_GT(on_a[0].force_W.norm(), 1e4);
  EXPECT_LT((on_a[0].force_W + on_b[0].force_W).norm(), 0.05 * on_a[0].force_W.norm());
}

// A linear spring and damper stop the car: depth and rebound are the oscillator's. With zeta = c / (2 sqrt(k m)) the
// force ends, and with it the touch, where k x + c x' = 0; the car leaves with the speed of that moment, exp(-zeta w
// t1) of what it came with.
TEST(CollisionSpace, AWallThrowsTheCarBackAsTheOscillatorSays) {
  CollisionSettings settings;
  settings.friction = 0.0;
  const double mass = 1000.0, speed = 10.0, step = 1e-5;
  const CollisionSpace space(kCar, settings);
  VehicleState car = CarAt(7.9, 0.0, 0.0, speed);
  double deepest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const auto touched = space.Touch(car, std::vector{kWall});
    for (const Impact& impact : touched) {
      car.v_WB_W += step / mass * impact.force_W;
      deepest = std::max(deepest, impact.depth_m);
    }
    car.p_WB_W += step * car.v_WB_W;
  }
  const double w = std::sqrt(settings.stiffness_Npm / mass),
               zeta = settings.damping_Nspm / (2.0 * std::sqrt(settings.stiffness_Npm * mass));
  const double s = std::sqrt(1.0 - zeta * zeta), wd = w * s;
  const double peak = std::atan2(s, zeta) / wd;                                          // x' = 0
  const double end = (M_PI - std::atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta)) / wd;  // k x + c x' = 0
  const double depth = speed / wd * std::exp(-zeta * w * peak) * std::sin(wd * peak);
  const double leaves = speed * std::exp(-zeta * w * end) * (std::cos(wd * end) - zeta / s * std::sin(wd * end));
  EXPECT_NEAR(deepest, depth, 1e-3 * depth);
  EXPECT_NEAR(car.v_WB_W.x(), leaves, 2e-3 * speed);
  EXPECT_LT(leaves, -0.4 * speed);
  EXPECT_NEAR(car.v_WB_W.y(), 0.0, 1e-9);
}

// Friction works against sliding, by at most mu times the normal force.
TEST(CollisionSpace, ABarrierAlongTheWayBrakesAndPushesAway) {
  const CollisionSpace space(kCar, {});
  Obstacle barrier{.id = 1, .centre_W = {0.0, -1.2, 0.5}, .half_m = {50.0, 0.42, 0.5}};  // its face at y = -0.78
  const auto touched = space.Touch(CarAt(0.0, 0.0, 0.0, 20.0), std::vector{barrier});
  ASSERT_EQ(touched.size(), 1u);
  const double bears = 1e6 * 0.02;
  EXPECT_NEAR(touched[0].force_W.y(), bears, 1e-3);
  EXPECT_NEAR(touched[0].force_W.x(), -0.4 * bears, 1e-3);
}

TEST(CollisionSpace, TheSameQuestionHasTheSameBits) {
  const CollisionSpace first(kCar, {}), second(kCar, {});
  Obstacle other = kWall;
  other.id = 9;
  other.q_WO = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 200; ++i) {
    const VehicleState car = CarAt(7.5 + 0.01 * i, 0.003 * i, 0.01 * i, 5.0);
    (void)second.Touch(CarAt(8.0 + 0.02 * i, 1.0, 0.5, 1.0), std::vector{other});
    const auto a = first.Touch(car, std::vector{kWall, other});
    const auto b = second.Touch(car, std::vector{other}), c = second.Touch(car, std::vector{kWall});
    for (const Impact& impact : a) {
      const auto& alone = impact.id == 9 ? b : c;
      ASSERT_EQ(alone.size(), 1u);
      EXPECT_EQ(impact.force_W, alone[0].force_W);
      EXPECT_EQ(impact.point_W, alone[0].point_W);
    }
    EXPECT_EQ(a.size(), b.size() + c.size());
  }
}

}  // namespace
}  // namespace rodeira::dynamics
