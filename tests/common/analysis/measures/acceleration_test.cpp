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

// On a circle the acceleration is v r: beyond the threshold or not. a = 2 A w cos w t of a sine lies beyond half of its
// largest value for two thirds of the time.
TEST(Acceleration, DiscomfortOfACircleAndOfASine) {
  const auto speed = Sampled(30.0, kRate, [](double) { return 10.0; });
  EXPECT_EQ(*DiscomfortShare(speed, std::vector<double>(speed.size(), 0.16), kRate, {}).value, 1.0);
  EXPECT_EQ(*DiscomfortShare(speed, std::vector<double>(speed.size(), -0.14), kRate, {}).value, 0.0);
  const double w = 2.0 * std::numbers::pi * 0.2;
  const auto sine = Sampled(50.0, kRate, [&](double t) { return 20.0 + 2.0 * std::sin(w * t); });
  const std::vector<double> straight(sine.size(), 0.0);
  EXPECT_NEAR(*DiscomfortShare(sine, straight, kRate, {.threshold_mps2 = w}).value, 2.0 / 3.0, 0.002);
  EXPECT_FALSE(DiscomfortShare(sine, std::vector<double>(sine.size(), kMissing), kRate, {}).value);
}

}  // namespace
}  // namespace rodeira::measures
