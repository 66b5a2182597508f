// SPDX-License-Identifier: Apache-2.0
// What a pass needs, told beforehand.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/traffic/overtaking/overtaking.hpp"

namespace rodeira::traffic {
namespace {

// The closed form against the motion itself, in small steps.
TEST(Overtaking, ThePlanIsTheMotion) {
  for (const double v : {8.0, 11.0, 15.0}) {
    for (const double relative : {20.0, 45.0, 120.0}) {
      PassCase at;
      at.speed_mps = v, at.passed_mps = 8.0, at.top_mps = 20.0, at.gains_mps2 = 1.2;
      at.to_clear_m = 25.0, at.relative_m = relative, at.back_s = 4.5, at.back_least_m = 24.0, at.length_m = 4.0;
      const PassPlan plan = PlanPass(at);
      double time = 0.0, way = 0.0, speed = v, gained = 0.0;
      constexpr double kSmall_s = 1e-4;
      for (; way < at.to_clear_m || gained < relative; time += kSmall_s) {
        if (way >= at.to_clear_m) speed = std::min(at.top_mps, speed + at.gains_mps2 * kSmall_s);
        way += speed * kSmall_s, gained += (speed - at.passed_mps) * kSmall_s;
      }
      EXPECT_NEAR(plan.gaining_s, time, 2e-3);
      EXPECT_NEAR(plan.speed_mps, speed, 2e-3);
      EXPECT_NEAR(plan.way_m, way + 4.5 * speed, 0.05);
      EXPECT_NEAR(plan.time_s, time + 0.8 * 4.5 + 4.0 / speed, 5e-3);
    }
  }
}

TEST(Overtaking, ShareOfTheQuintic) {
  for (const double u : {0.1, 0.35, 0.5, 0.8})
    EXPECT_NEAR(QuinticShareAt(u * u * u * (10.0 + u * (-15.0 + 6.0 * u))), u, 1e-9);
}

}  // namespace
}  // namespace rodeira::traffic
