// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_position.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/lane_change.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

Measure ModifiedOf(const std::vector<double>& y, bool both_ways) {
  const std::vector<std::int32_t> lane(y.size(), 0);
  ModifiedSdlpOptions options;
  options.both_ways = both_ways;
  options.denominator = Denominator::kN;
  return ModifiedSdlp({y, lane}, kRate, options);
}

// Closed form of the high-pass on a sine of 0.3 m (600 s at 100 Hz): 0.106066 at 0.1 Hz and 0.199654 at 0.2 Hz with two
// passes, 0.3 / sqrt 2 / sqrt(1 + k^4) with one. The ends cost 0.4 % at 0.1 Hz.
TEST(LanePosition, TheModifiedDeviationIsTheHighPass) {
  EXPECT_NEAR(*ModifiedOf(SineWave(0.3, 0.1, 600.0, kRate), true).value, 0.106066, 0.005 * 0.106066);
  EXPECT_NEAR(*ModifiedOf(SineWave(0.3, 0.2, 600.0, kRate), true).value, 0.199654, 0.002 * 0.199654);
  const double k = std::tan(std::numbers::pi * 0.1 / kRate) / std::tan(std::numbers::pi * 0.2 / kRate);
  EXPECT_NEAR(*ModifiedOf(SineWave(0.3, 0.2, 600.0, kRate), false).value,
              0.3 / std::numbers::sqrt2 / std::sqrt(1.0 + std::pow(k, 4)), 0.002);
  // In the middle 400 s nothing depends on the ends.
  const auto section = ButterworthHighPass(0.1, kRate);
  for (const auto& [hz, expected] : {std::pair{0.1, 0.106066}, {0.2, 0.199654}}) {
    const auto high = FilterBothWays(section, SineWave(0.3, hz, 600.0, kRate), PaddingSamples(kPadding_s, kRate));
    EXPECT_NEAR(*Deviation(Series(high).subspan(10'000, 40'000), Denominator::kN), expected, 4e-6) << hz;
  }
  // A drift alone leaves nothing in the middle, and little at the ends.
  EXPECT_LT(*ModifiedOf(Sampled(600.0, kRate, [](double t) { return 2e-4 * t; }), true).value, 1e-4);
}

TEST(LanePosition, ATimeThatIsTooShortIsMissing) {
  const Measure m = ModifiedOf(SineWave(0.3, 0.2, 29.0, kRate), true);
  EXPECT_FALSE(m.value);
  EXPECT_EQ(m.reason, "no time of 30 s in one lane");
}

// Two lanes of 3.5 m: a lane change turns a deviation of some 0.07 m into 1.75 m, unless it is cut and both lanes are
// pooled.
TEST(LanePosition, ALaneChangeIsCutAndLanesArePooled) {
  const auto weave = [](double t) { return 0.1 * std::sin(2.0 * std::numbers::pi * 0.2 * t); };
  // From the middle of one lane (60 s) within 5 s, as half a cosine, to the middle of the next one.
  const auto across = Sampled(120.0, kRate, [&](double t) {
    const double done = std::clamp((t - 60.0) / 5.0, 0.0, 1.0);
    return weave(t) + 3.5 * 0.5 * (1.0 - std::cos(std::numbers::pi * done));
  });
  std::vector<double> y(across.size());
  std::vector<std::int32_t> lane(across.size());
  std::vector<std::int8_t> crossing(across.size(), 0);
  for (std::size_t i = 0; i < across.size(); ++i) {
    lane[i] = across[i] > 1.75 ? 1 : 0;
    y[i] = across[i] - 3.5 * lane[i];
    if (i > 0 && lane[i] != lane[i - 1]) crossing[i] = lane[i] > lane[i - 1] ? 1 : -1;
  }
  EXPECT_NEAR(*Deviation(across, Denominator::kNMinus1), 1.75, 0.03);
  LaneChangeOptions options;
  options.onset_mps = 0.13;  // above the weaving, 0.1 * 2 pi * 0.2 = 0.126 m/s
  const auto changes = LaneChanges(y, crossing, kRate, options);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].direction, 1);
  EXPECT_NEAR(static_cast<double>(changes[0].begin) / kRate, 60.1, 0.4);
  EXPECT_NEAR(static_cast<double>(changes[0].crossing) / kRate, 62.5, 0.1);
  EXPECT_NEAR(static_cast<double>(changes[0].end) / kRate, 64.9, 0.4);
  const auto cut = WithoutLaneChanges(y, changes);
  const Measure sdlp = Sdlp({cut, lane}, {});
  ASSERT_TRUE(sdlp.value);
  EXPECT_NEAR(*sdlp.value, 0.1 / std::numbers::sqrt2, 0.002);
  EXPECT_NEAR(sdlp.valid_share, 115.2 / 120.0, 0.01);
}

TEST(LanePosition, FewValidSamplesAreMissing) {
  auto y = SineWave(0.2, 0.2, 10.0, kRate);
  const std::vector<std::int32_t> lane(y.size(), 4);
  for (std::size_t i = 0; i < 160; ++i) y[i] = kMissing;
  const Measure sdlp = Sdlp({y, lane}, {});
  EXPECT_FALSE(sdlp.value);
  EXPECT_EQ(sdlp.reason, "840 of 1000 samples have a lane position");
  EXPECT_TRUE(Sdlp({y, lane}, {.min_valid_share = 0.84}).value);
}

}  // namespace
}  // namespace rodeira::measures
