// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/acceleration.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// v = V + A sin w t: largest deceleration A w; the mean over 1 s at most A w sinc(w / 2); rms jerk A w^2 / sqrt 2.
TEST(Acceleration, OfASine) {
  const double w = 2.0 * std::numbers::pi * 0.2;
  const auto speed = Sampled(50.0, kRate, [&](double t) { return 20.0 + 2.0 * std::sin(w * t); });
  EXPECT_NEAR(*LargestDeceleration(speed, kRate, {}).value, 2.0 * w, 0.001 * 2.0 * w);
  EXPECT_NEAR(*LargestMeanDeceleration(speed, kRate, {}).value, 2.0 * 2.0 * std::sin(0.5 * w), 1e-3);
  EXPECT_NEAR(*RmsJerk(speed, kRate, {}).value, 2.0 * w * w / std::numbers::sqrt2, 0.03);
  EXPECT_NEAR(*LargestNegativeJerk(speed, kRate, {}).value, 2.0 * w * 2.0 * std::sin(0.5 * w), 0.01);
}

TEST(Acceleration, SpeedingUpHasNoDecelerationAndTwoSamplesNone) {
  const auto speed = Sampled(10.0, kRate, [](double t) { return 1.5 * t; });
  EXPECT_NEAR(*LargestDeceleration(speed, kRate, {}).value, 0.0, 1e-9);
  EXPECT_FALSE(LargestDeceleration(Series(speed).first(9), kRate, {}).value);
  EXPECT_FALSE(LargestMeanDeceleration(Series(speed).first(90), kRate, {}).value);
}

}  // namespace
}  // namespace rodeira::measures
