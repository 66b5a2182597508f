// SPDX-License-Identifier: Apache-2.0
// Published details of a driver model follow from the car's geometry and the model's laws: on a circle all are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/common/traffic/ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLength_m = 400.0, kRadius_m = kLength_m / (2.0 * std::numbers::pi),
                 kLane_m = kRadius_m + 1.75;  // the lane lies outside

// About the circle's centre, from where the lane begins, counter-clockwise.
double TurnOf(const Eigen::Vector2d& at_W) {
  return std::atan2(at_W.y() - kRadius_m, at_W.x()) + 0.5 * std::numbers::pi;
}
// From one place on the lane to another one, ahead.
double Arc_m(double from, double to) {
  return kLane_m * std::fmod(to - from + 4.0 * std::numbers::pi, 2.0 * std::numbers::pi);
}

class AgentDetails : public testing::TestWithParam<Physics> {};

// The target: as far ahead of the rear axle as hands make good what is missing, 0.7 s, on the lane's middle. The path
// leads along the circle where that axle is. It looks so far beyond its front as it brakes in comfort at 1.5 m/s2 and
// drives in 3 s, and 60 m more, at most 200.
TEST_P(AgentDetails, LieOnTheCircleAsFarAheadAsItsDriverSteersAndLooks) {
  TrafficSettings settings;
  settings.vehicles = 1;
  settings.seed = 3;
  settings.physics = GetParam();
  TrafficModel model = TrafficModel::Make(settings, Ring(kLength_m), {}).value();
  int compared = 0;
  for (int i = 0; i < 6000; ++i) {
    model.Step(0.01, {});
    if (i % 10 != 0 || model.poses().empty()) continue;
    const AgentPose& pose = model.poses()[0];
    const AgentDetail detail = model.Details()[0];
    const AgentTraits& traits = model.traits(pose.id);
    const double v = pose.speed_mps;
    if (v < 1.0) continue;
    const Eigen::Vector2d ahead = (pose.q_WB * Eigen::Vector3d::UnitX()).head<2>(),
                          rear_W = pose.p_WB_W.head<2>() - 0.5 * traits.wheelbase_m * ahead;
    const Eigen::Vector2d centre_W(0.0, kRadius_m);
    ASSERT_NEAR((detail.target_W - centre_W).norm(), kLane_m, 0.02);
    ASSERT_NEAR(Arc_m(TurnOf(rear_W), TurnOf(detail.target_W)), std::max({3.0, traits.wheelbase_m, 0.7 * v}), 0.1) << i;
    ASSERT_NEAR(std::remainder(detail.path_heading_rad - TurnOf(rear_W), 2.0 * std::numbers::pi), 0.0, 0.003) << i;
    const double sight_m = std::min(200.0, v * v / 3.0 + 3.0 * v + 60.0);
    ASSERT_NEAR((detail.look_ahead_W - centre_W).norm(), kLane_m, 0.02);
    ASSERT_NEAR(Arc_m(TurnOf(pose.p_WB_W.head<2>()), TurnOf(detail.look_ahead_W)), 0.5 * traits.length_m + sight_m, 0.1)
        << i;
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

INSTANTIATE_TEST_SUITE_P(Physics, AgentDetails, testing::Values(Physics::kPlanar, Physics::kFull),
                         [](const auto& which) { return which.param == Physics::kPlanar ? "Planar" : "Full"; });

}  // namespace
}  // namespace rodeira::traffic
