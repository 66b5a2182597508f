// SPDX-License-Identifier: Apache-2.0
// Coming to rest without a jerk.
#include "common/driving/driver/smooth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rodeira::driver {
namespace {

// Braking by it from any speed the deceleration falls by j dt a step at most, to rest, by steps of any length.
TEST(Smooth, AnEasedStopEndsWithoutAJerk) {
  for (const double jerk : {1.0, 3.0, 15.0}) {
    for (const double dt : {0.001, 0.01, 0.1}) {
      for (double from = 1e-6; from < 30.0; from *= 1.7) {
        double v = from, before = EasedStop_mps2(v, jerk, dt);
        EXPECT_NEAR(before, std::sqrt(2.0 * jerk * v), jerk * dt) << from;
        int steps = 0;
        for (; v > 1e-12 && steps < 1000000; ++steps) {
          const double a = EasedStop_mps2(v, jerk, dt);
          ASSERT_LE(std::fabs(before - a), jerk * dt * (1.0 + 1e-9)) << v << " of " << from << " by steps of " << dt;
          ASSERT_GE(v, a * dt * (1.0 - 1e-9));
          v -= a * dt;
          before = a;
        }
        ASSERT_LE(before, jerk * dt * (1.0 + 1e-9));
        EXPECT_NEAR(steps * dt, std::sqrt(2.0 * from / jerk), 2.0 * dt);
      }
    }
  }
}

// Against the motion integrated in small steps: the deceleration grows as long as what it can still let go of is more.
TEST(Smooth, TheWayOfASmoothStopIsThatOfItsMotion) {
  constexpr double kJerk = 3.0, kStep_s = 1e-5;
  for (const double from : {0.4, 2.0, 14.0}) {
    for (const double from_mps2 : {1.4, 0.0, -0.7, -1.5}) {
      double v = from, a = from_mps2, way = 0.0;
      while (v > 1e-7) {
        const double most = std::sqrt(2.0 * kJerk * v);
        a = std::max(a - kJerk * kStep_s, -most);
        const double next = std::max(0.0, v + a * kStep_s);
        way += 0.5 * (v + next) * kStep_s;
        v = next;
      }
      EXPECT_NEAR(SmoothStop_m(from, from_mps2, kJerk), way, 2e-3 * way + 1e-3) << from << " " << from_mps2;
    }
  }
}

// dv/dx v = -a all along the profile; its deceleration rises by the jerk and no more, and is constant before.
TEST(Smooth, AStopsProfileIsAMotion) {
  constexpr double kBraking = 2.0, kJerk = 3.0, kEased_m = 8.0 / 54.0;
  for (double x = 1e-3; x < 40.0; x *= 1.1) {
    const StopProfile at = StopIn(x, kBraking, kJerk), before = StopIn(x * (1.0 + 1e-6), kBraking, kJerk),
                      after = StopIn(x * (1.0 - 1e-6), kBraking, kJerk);
    EXPECT_NEAR((before.speed_mps - after.speed_mps) / (2e-6 * x) * at.speed_mps, at.deceleration_mps2, 1e-4) << x;
    if (x < kEased_m)
      EXPECT_NEAR(at.deceleration_mps2, std::sqrt(2.0 * kJerk * at.speed_mps), 1e-9);
    else
      EXPECT_EQ(at.deceleration_mps2, kBraking);
  }
  EXPECT_EQ(StopIn(0.0, kBraking, kJerk).speed_mps, 0.0);
  EXPECT_EQ(StopIn(-1.0, kBraking, kJerk).speed_mps, 0.0);
}

// From 14 m/s without braking yet: 3 m/s² can be had smoothly, 8 m/s² cannot; and no car hurries for the last of a
// stop.
TEST(Smooth, HasteIsWhereSmoothBrakingComesTooLate) {
  EXPECT_FALSE(NeedsHaste(-3.0, 14.0, 0.0, 3.0));
  EXPECT_TRUE(NeedsHaste(-8.0, 14.0, 0.0, 3.0));
  EXPECT_FALSE(NeedsHaste(-8.0, 0.3, -1.0, 3.0));
  EXPECT_TRUE(NeedsHaste(-8.0, 3.0, 1.4, 3.0));
  EXPECT_FALSE(NeedsHaste(0.5, 3.0, 1.4, 3.0));
}

}  // namespace
}  // namespace rodeira::driver
