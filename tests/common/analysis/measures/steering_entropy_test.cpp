// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/steering_entropy.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/analysis/measures/statistics.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// Of normal errors of deviation sigma alpha is 1.644854 sigma, the shares are 0.589166, twice 0.155417, twice 0.049980,
// twice 1.96e-5 (the normal distribution between the cuts), H = 0.541719. Errors 1.5 times as large have 0.690002.
TEST(SteeringEntropy, NormalErrorsBy1999) {
  const auto errors = NormalNumbers(200'000, 0.4);
  const auto alpha = EntropyAlpha(errors);
  EXPECT_NEAR(*alpha, 1.644854 * 0.4, 2e-5);
  EXPECT_NEAR(*Entropy1999(errors, *alpha).value, 0.541719, 2e-5);
  EXPECT_NEAR(*Entropy1999(NormalNumbers(200'000, 0.6), *alpha).value, 0.690002, 2e-5);
}

// Of normal errors pe is 0.841621 sigma; the baseline has 2.388203 bit, a task with the same errors as much, with
// errors 1.5 times as large 3.136552 bit.
TEST(SteeringEntropy, NormalErrorsBy2005) {
  const auto errors = NormalNumbers(200'000, 0.25);
  const auto pe = EntropyPe(errors);
  EXPECT_NEAR(*pe, 0.841621 * 0.25, 1e-5);
  const auto baseline = SharesOf(errors, *pe);
  EXPECT_NEAR(CrossEntropy_bit(baseline, baseline), 2.388203, 1e-4);
  EXPECT_NEAR(CrossEntropy_bit(SharesOf(NormalNumbers(200'000, 0.375), *pe), baseline), 3.136552, 1e-4);
}

// An angle that the predictor itself makes from errors gives them back.
TEST(SteeringEntropy, ThePredictorGivesItsErrorsBack) {
  std::mt19937 draw(7);
  std::normal_distribution<double> normal(0.0, 0.01);
  std::vector<double> angle{0.0, 0.1, 0.15}, errors;
  for (int n = 0; n < 400; ++n) {
    const std::size_t k = angle.size();
    errors.push_back(normal(draw));
    // Damped, so that the angle stays small: the predictor alone is not stable.
    const double predicted = 2.5 * angle[k - 1] - 2.0 * angle[k - 2] + 0.5 * angle[k - 3];
    errors.back() -= 0.3 * predicted;
    angle.push_back(predicted + errors.back());
  }
  const auto back = TaylorErrors(angle);
  ASSERT_EQ(back.size(), errors.size());
  for (std::size_t i = 0; i < back.size(); ++i) EXPECT_NEAR(back[i], errors[i], 1e-12);
}

// Burg's method finds the coefficients of the process that made the numbers, to 1 / sqrt n.
TEST(SteeringEntropy, BurgFindsTheProcess) {
  std::mt19937 draw(3);
  std::normal_distribution<double> normal;
  std::vector<double> x{0.0, 0.0, 0.0};
  for (int n = 0; n < 100'000; ++n) {
    const std::size_t k = x.size();
    x.push_back(1.2 * x[k - 1] - 0.7 * x[k - 2] + 0.2 * x[k - 3] + normal(draw));
  }
  const auto a = BurgAr3(x);
  ASSERT_TRUE(a);
  EXPECT_NEAR((*a)[0], 1.2, 0.01);
  EXPECT_NEAR((*a)[1], -0.7, 0.015);
  EXPECT_NEAR((*a)[2], 0.2, 0.01);
  EXPECT_NEAR(*Deviation(ArErrors(x, *a), Denominator::kN), 1.0, 0.01);
}

// The mean of the samples of each 150 ms of a straight line is the line at the middle of the sampling times.
TEST(SteeringEntropy, AnglesEvery150ms) {
  const auto angle = At150ms(Sampled(3.0, 100.0, [](double t) { return 4.0 * t; }), 100.0);
  ASSERT_EQ(angle.size(), 20u);
  for (std::size_t k = 0; k < angle.size(); ++k)
    EXPECT_NEAR(angle[k], 4.0 * (0.15 * static_cast<double>(k) + 0.07), 1e-12);
}

TEST(SteeringEntropy, WholeSignalsByBothMethods) {
  std::mt19937 draw(11);
  std::normal_distribution<double> normal;
  const auto drive = [&](double seconds, double size) {
    double rate = 0.0, angle = 0.0;
    return Sampled(seconds, 100.0, [&](double) {
      rate += 0.05 * (size * 30.0 * normal(draw) - rate);
      angle += 0.01 * rate - 0.005 * angle;
      return angle;
    });
  };
  const auto baseline = drive(130.0, 1.0), same = drive(120.0, 1.0), wild = drive(120.0, 2.0);
  const auto of = [&](const std::vector<double>& wheel) { return SteeringEntropy2005(wheel, baseline, 100.0); };
  ASSERT_TRUE(of(same).value);
  EXPECT_LT(*of(same).value + 0.5, *of(wild).value);
  EXPECT_LT(*SteeringEntropy1999(same, baseline, 100.0).value + 0.05,
            *SteeringEntropy1999(wild, baseline, 100.0).value);
  EXPECT_EQ(SteeringEntropy2005(same, Series(baseline).first(8900), 100.0).reason, "the baseline is shorter than 90 s");
  EXPECT_FALSE(SteeringEntropy1999(same, std::vector<double>(9000, 0.0), 100.0).value) << "alpha is 0";
}

}  // namespace
}  // namespace rodeira::measures
