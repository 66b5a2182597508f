// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/scene_snapshot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"

namespace rodeira::scene {
namespace {

// A car and two agents on circles around the origin, the car's wheels rolling.
SceneSnapshot Circling(double time_s) {
  SceneSnapshot moment;
  moment.time_ns = std::llround(time_s * 1e9);
  const auto on_circle = [&](double radius, double radps) {
    return Eigen::Vector3d(radius * std::cos(radps * time_s), radius * std::sin(radps * time_s), 0.1 * time_s);
  };
  CarPose car;
  car.p_WB_W = on_circle(40.0, 0.75);
  car.q_WB = Attitude(0.75 * time_s + geometry::kPi / 2.0, 0.0, 0.0);
  car.speed_mps = 30.0;
  for (WheelPose& wheel : car.wheels) {
    wheel.spin_radps = 103.0;  // about two radians in 20 ms, and once around in 61 ms
    wheel.spin_rad = geometry::WrapAngle(103.0 * time_s);
  }
  moment.cars.push_back(car);
  for (const std::uint64_t id : {3U, 8U}) {
    AgentPose agent;
    agent.id = id;
    agent.p_WB_W = on_circle(40.0 + static_cast<double>(id), 0.5);
    agent.q_WB = Attitude(0.5 * time_s, 0.0, 0.0);
    moment.agents.push_back(agent);
  }
  return moment;
}

TEST(SceneSnapshot, TheEndsAreExact) {
  const SceneSnapshot a = Circling(1.0), b = Circling(1.02);
  EXPECT_EQ(Interpolate(a, b, 0.0).cars[0].p_WB_W, a.cars[0].p_WB_W);
  EXPECT_EQ(Interpolate(a, b, 1.0).cars[0].p_WB_W, b.cars[0].p_WB_W);
  EXPECT_EQ(Interpolate(a, b, 1.0).agents[1].q_WB.coeffs(), b.agents[1].q_WB.coeffs());
}

TEST(SceneSnapshot, BetweenLiesTheMotion) {
  const SceneSnapshot a = Circling(1.0), b = Circling(1.02);
  for (const double alpha : {0.1, 0.5, 0.83}) {
    const SceneSnapshot between = Interpolate(a, b, alpha), truth = Circling(1.0 + 0.02 * alpha);
    // A chord over 15 mrad of a circle of 40 m leaves it by 40 * 0.015^2 / 8 = 1.1 mm.
    EXPECT_LT((between.cars[0].p_WB_W - truth.cars[0].p_WB_W).norm(), 0.0012);
    EXPECT_LT(between.cars[0].q_WB.angularDistance(truth.cars[0].q_WB), 1e-7);
    EXPECT_LT((between.agents[0].p_WB_W - truth.agents[0].p_WB_W).norm(), 0.0012);
    EXPECT_NEAR(std::fabs(geometry::WrapAngle(between.cars[0].wheels[2].spin_rad - truth.cars[0].wheels[2].spin_rad)),
                0.0, 1e-9);
    EXPECT_EQ(between.time_ns, truth.time_ns);
  }
}

// A wheel that turns by more than half a turn between two samples still turns forward.
TEST(SceneSnapshot, FastWheelsTurnAsFastAsTheyDid) {
  const SceneSnapshot a = Circling(1.0), b = Circling(1.05);  // 5.15 rad
  const SceneSnapshot between = Interpolate(a, b, 0.5), truth = Circling(1.025);
  EXPECT_NEAR(std::fabs(geometry::WrapAngle(between.cars[0].wheels[0].spin_rad - truth.cars[0].wheels[0].spin_rad)),
              0.0, 1e-9);
}

TEST(SceneSnapshot, WhatAppearsOrGoesIsNotDrawnBetween) {
  SceneSnapshot a = Circling(1.0), b = Circling(1.02);
  a.agents[1].id = 5;  // gone afterwards; 8 is new
  const SceneSnapshot between = Interpolate(a, b, 0.4);
  ASSERT_EQ(between.agents.size(), 1U);
  EXPECT_EQ(between.agents[0].id, 3U);
}

TEST(PoseHistory, AnswersWithinWhatItKnows) {
  PoseHistory history;
  EXPECT_TRUE(history.empty());
  for (int k = 0; k <= 20; ++k) history.Add(Circling(0.02 * k));
  EXPECT_EQ(history.newest_ns(), 400'000'000);
  EXPECT_EQ(history.interval_ns(), 20'000'000);
  EXPECT_EQ(history.At(5e8).cars[0].p_WB_W, Circling(0.4).cars[0].p_WB_W);
  EXPECT_EQ(history.At(3.8e8).cars[0].p_WB_W, Circling(0.38).cars[0].p_WB_W);
  EXPECT_LT((history.At(3.71e8).cars[0].p_WB_W - Circling(0.371).cars[0].p_WB_W).norm(), 0.0012);
  EXPECT_EQ(history.At(0.0).time_ns, 260'000'000) << "the oldest of the few that are kept";
}

}  // namespace
}  // namespace rodeira::scene
