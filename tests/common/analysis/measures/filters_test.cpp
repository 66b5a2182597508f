// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/filters.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/statistics.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// The table that Markkula & Engstroem publish for 0.6 Hz at 30 Hz.
TEST(Filters, CoefficientsAreThePublishedOnes) {
  const auto low = ButterworthLowPass(0.6, 30.0);
  EXPECT_NEAR(low.b0, 0.00362168151493, 1e-14);
  EXPECT_NEAR(low.b1, 2.0 * 0.00362168151493, 2e-14);
  EXPECT_NEAR(low.b2, 0.00362168151493, 1e-14);
  EXPECT_NEAR(low.a1, -1.82269492519631, 1e-14);
  EXPECT_NEAR(low.a2, 0.83718165125602, 1e-14);
}

// The bilinear transform's closed form: |H|^2 = 1 / (1 + k^4), k = tan(pi fc / fs) / tan(pi f / fs) of a high-pass; its
// inverse of a low-pass. Two passes have the square. Of the middle third nothing depends on the ends.
TEST(Filters, GainIsTheClosedForm) {
  constexpr double kRate = 50.0, kCutoff = 0.7;
  for (const double f : {0.2, 0.5, 0.7, 1.3}) {
    const double k = std::tan(std::numbers::pi * kCutoff / kRate) / std::tan(std::numbers::pi * f / kRate);
    const auto wave = SineWave(2.0, f, 300.0, kRate);
    for (const bool high : {false, true}) {
      const auto section = high ? ButterworthHighPass(kCutoff, kRate) : ButterworthLowPass(kCutoff, kRate);
      const double power = high ? 1.0 / (1.0 + std::pow(k, 4)) : 1.0 / (1.0 + std::pow(k, -4));
      const auto once = FilterForward(section, wave), twice = FilterBothWays(section, wave, kPaddingOfSciPy);
      const Series middle_once = Series(once).subspan(5000, 5000), middle_twice = Series(twice).subspan(5000, 5000);
      const double rms = 2.0 / std::numbers::sqrt2;
      EXPECT_NEAR(*Deviation(middle_once, Denominator::kN), rms * std::sqrt(power), 1e-9) << f << high;
      EXPECT_NEAR(*Deviation(middle_twice, Denominator::kN), rms * power, 1e-9) << f << high;
    }
  }
}

// A straight line has no phase and no curvature: forward and backward it is itself, and a high-pass leaves nothing of a
// constant.
TEST(Filters, AStraightLineStaysAndAConstantIsCut) {
  const auto line = Sampled(20.0, 100.0, [](double t) { return 3.0 - 0.4 * t; });
  const auto low = FilterBothWays(ButterworthLowPass(2.0, 100.0), line, 600);
  ASSERT_EQ(low.size(), line.size());
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(low[i], line[i], 1e-9);
  const std::vector<double> constant(100, 7.0);
  const auto high = FilterForward(ButterworthHighPass(1.0, 100.0), constant);
  ASSERT_EQ(high.size(), constant.size());
  for (const double y : high) EXPECT_NEAR(y, 0.0, 1e-12);
  EXPECT_TRUE(FilterBothWays(ButterworthLowPass(2.0, 100.0), Series(line).first(9), 9).empty());
}

// What is above half the new rate must not come back as something else: 47 Hz at 100 Hz taken every tenth sample would
// be 3 Hz with its whole amplitude. 1 Hz stays but for the gain of four passes at 4 Hz.
TEST(Filters, DecimationKeepsSlowWavesAndNoAliases) {
  const double k = std::tan(std::numbers::pi * 0.01) / std::tan(std::numbers::pi * 0.04);
  const auto slow = Decimate(SineWave(1.0, 1.0, 60.0, 100.0), 10);
  EXPECT_EQ(slow.size(), 600u);
  EXPECT_NEAR(*Deviation(Series(slow).subspan(50, 500), Denominator::kN),
              std::pow(1.0 + std::pow(k, 4), -2.0) / std::numbers::sqrt2, 1e-6);
  const auto fast = Decimate(SineWave(1.0, 47.0, 60.0, 100.0), 10);
  EXPECT_LT(*Deviation(Series(fast).subspan(50, 500), Denominator::kN), 1e-4);
}

TEST(Filters, ResamplingIsLinearAndKeepsGaps) {
  const auto line = Sampled(3.0, 30.0, [](double t) { return 5.0 * t; });
  const auto other = Resample(line, 30.0, 100.0);
  EXPECT_EQ(other.size(), 297u);  // the last sample lies at 89/30 s
  for (std::size_t k = 0; k < other.size(); ++k) EXPECT_NEAR(other[k], 0.05 * static_cast<double>(k), 1e-12);
  const std::vector<double> gap{0.0, 1.0, kMissing, 3.0, 4.0};
  const auto between = Resample(gap, 1.0, 2.0);
  ASSERT_EQ(between.size(), 9u);
  EXPECT_EQ(between[2], 1.0);
  for (const std::size_t i : {3u, 4u, 5u}) EXPECT_TRUE(std::isnan(between[i])) << i;
  EXPECT_EQ(between[7], 3.5);
}

TEST(Filters, ASlopeIsFoundUpToAGap) {
  const std::vector<double> x{0.0, 2.0, 4.0, kMissing, 1.0, kMissing, 5.0, 4.0};
  const auto slope = Derivative(x, 10.0);
  for (const std::size_t i : {0u, 1u, 2u}) EXPECT_NEAR(slope[i], 20.0, 1e-12);
  for (const std::size_t i : {3u, 4u, 5u}) EXPECT_TRUE(std::isnan(slope[i]));
  EXPECT_NEAR(slope[7], -10.0, 1e-12);
  const auto runs = ValidRuns(x);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1].from, 4u);
  EXPECT_EQ(runs[2].to, 8u);
}

}  // namespace
}  // namespace rodeira::measures
