// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/statistics.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// NumPy's documentation of percentile, method linear (R's type 7): [[10, 7, 4], [3, 2, 1]] has the median 3.5; the
// quarter and the tenth by hand: h = (n - 1) p of the sorted numbers.
TEST(Statistics, QuantilesAreOfTypeSeven) {
  const std::vector<double> x{10.0, 7.0, kMissing, 4.0, 3.0, 2.0, 1.0};
  EXPECT_DOUBLE_EQ(*Quantile(x, 0.5), 3.5);
  EXPECT_DOUBLE_EQ(*Quantile(x, 0.25), 2.25);
  EXPECT_DOUBLE_EQ(*Quantile(x, 0.1), 1.5);
  EXPECT_DOUBLE_EQ(*Quantile(x, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(*Quantile(x, 1.0), 10.0);
  EXPECT_FALSE(Quantile(std::vector<double>{kMissing}, 0.5));
}

// A sine over whole periods has A / sqrt 2 by N; a drift c over T has c T / sqrt 12 (600 s of 2e-4 m/s: 0.034641).
TEST(Statistics, DeviationsOfASineAndADrift) {
  const auto wave = SineWave(0.37, 0.25, 40.0, 50.0);
  EXPECT_NEAR(*Deviation(wave, Denominator::kN), 0.37 / std::numbers::sqrt2, 1e-12);
  const double n = static_cast<double>(wave.size());
  EXPECT_NEAR(*Deviation(wave, Denominator::kNMinus1), 0.37 / std::numbers::sqrt2 * std::sqrt(n / (n - 1.0)), 1e-12);
  const auto drift = Sampled(600.0, 100.0, [](double t) { return 2e-4 * t; });
  EXPECT_NEAR(*Deviation(drift, Denominator::kN), 0.034641, 1e-6);
  EXPECT_FALSE(Deviation(std::vector<double>{1.0}, Denominator::kNMinus1));
  EXPECT_EQ(*Deviation(std::vector<double>{1.0}, Denominator::kN), 0.0);
}

// By hand: parts {1, 3} and {10, 12, 14}: (2 + 8) / (1 + 2).
TEST(Statistics, APooledDeviationIsAboutTheMeanOfEachPart) {
  const std::vector<double> x{1.0, 3.0, 10.0, 12.0, 14.0, 99.0};
  const std::vector<SampleRun> parts{{0, 2}, {2, 5}, {5, 6}};
  EXPECT_NEAR(*PooledDeviation(x, parts, Denominator::kNMinus1), std::sqrt(10.0 / 3.0), 1e-12);
  EXPECT_NEAR(*PooledDeviation(x, parts, Denominator::kN), std::sqrt(10.0 / 6.0), 1e-12);
}

TEST(Statistics, AnglesAreWrappedAsDifferences) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(WrapAngle(3.5), 3.5 - 2.0 * pi, 1e-15);
  EXPECT_DOUBLE_EQ(WrapAngle(-pi), pi);
  EXPECT_DOUBLE_EQ(WrapAngle(pi), pi);
  // Half a degree to both sides of west: the mean is west, and not east.
  const std::vector<double> west{pi - 0.01, -pi + 0.01};
  EXPECT_NEAR(std::abs(*CircularMean(west)), pi, 1e-12);
  EXPECT_FALSE(CircularMean(std::vector<double>{0.0, pi}));
}

TEST(Statistics, NothingIsNeverANumber) {
  const std::vector<double> nothing(5, kMissing);
  for (const Measure& m : {MeanOf(nothing, "m"), DeviationOf(nothing, "m", Denominator::kN), MinimumOf(nothing, "m"),
                           MaximumOf(nothing, "m"), QuantileOf(nothing, "m", 0.15), ShareBelow(nothing, 1.0)}) {
    EXPECT_FALSE(m.value);
    EXPECT_FALSE(m.reason.empty());
    EXPECT_EQ(m.valid_share, 0.0);
  }
  const std::vector<double> half{1.0, kMissing, 3.0, kMissing};
  const Measure share = ShareAbove(half, 2.0);
  EXPECT_EQ(*share.value, 0.5);
  EXPECT_EQ(share.n, 2u);
  EXPECT_EQ(share.valid_share, 0.5);
  EXPECT_EQ(share.options, (UsedOptions{{"threshold", "2"}}));
}

}  // namespace
}  // namespace rodeira::measures
