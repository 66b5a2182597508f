// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the measures: series of one length, shares of 0 to 1, rates and cut-offs above 0.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/analysis/measures/acceleration.hpp"
#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/conflict.hpp"
#include "common/analysis/measures/encroachment.hpp"
#include "common/analysis/measures/filters.hpp"
#include "common/analysis/measures/fuel.hpp"
#include "common/analysis/measures/lane_change.hpp"
#include "common/analysis/measures/lane_change_test.hpp"
#include "common/analysis/measures/lane_position.hpp"
#include "common/analysis/measures/mean_deviation.hpp"
#include "common/analysis/measures/spectrum.hpp"
#include "common/analysis/measures/speed.hpp"
#include "common/analysis/measures/statistics.hpp"
#include "common/analysis/measures/stops.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate_hz = 100.0;
const std::vector<double> kThree{1.0, 2.0, 3.0}, kTwo{1.0, 2.0};

TEST(ContractsDeathTest, SeriesOfAMeasureOfTheSpeedHaveOneLength) {
  EXPECT_DEATH((void)DiscomfortShare(kThree, kTwo, kRate_hz, {}), "acceleration.cpp.*speed_mps.size\\(\\)");
  EXPECT_DEATH((void)FuelOverDistance(kThree, kTwo, kRate_hz, {}), "fuel_used_kg.size\\(\\)");
  EXPECT_DEATH((void)ShareAboveLimit(kThree, kTwo, 0.0), "limit_mps.size\\(\\)");
  EXPECT_DEATH((void)StopDistance(kThree, kTwo, {}), "ahead_m.size\\(\\)");
  EXPECT_EQ(ShareAboveLimit(kThree, kThree, 0.0).value, 0.0);
}

TEST(ContractsDeathTest, SeriesOfAMeasureOfTheLaneHaveOneLength) {
  const std::array<std::int8_t, 2> crossing{};
  const std::array<std::int32_t, 2> episode{};
  EXPECT_DEATH((void)LateralSpeed(kThree, crossing, kRate_hz), "crossing.size\\(\\)");
  EXPECT_DEATH((void)LaneRuns({kThree, episode}), "position.episode.size\\(\\)");
  EXPECT_DEATH((void)MeanDeviation(kThree, kTwo, 0.0, 1.0, {}, {}), "mean_deviation.cpp.*t_m.size\\(\\)");
  EXPECT_DEATH((void)FindOwnPath(kThree, kTwo, {}), "lane_change_test.cpp.*t_m.size\\(\\)");
  EXPECT_DEATH((void)ChangeDelay(kThree, kTwo, kRate_hz, {}, 30.0), "lane_change_test.cpp.*t_m.size\\(\\)");
  EXPECT_EQ(LaneRuns({kTwo, episode}).size(), 1U);
}

TEST(ContractsDeathTest, SeriesOfAMeasureOfAnEncounterHaveOneLength) {
  const std::vector<Footprint> three(3), two(2);
  EXPECT_DEATH((void)MeanInverseTtc(kThree, kTwo), "gap_m.size\\(\\)");
  EXPECT_DEATH((void)PostEncroachmentTime(three, two, kRate_hz), "a.size\\(\\) == b.size\\(\\)");
  EXPECT_TRUE(MeanInverseTtc(kThree, kThree).value.has_value());
}

TEST(ContractsDeathTest, ALeaderBrakes) {
  EXPECT_GT(BrakingLeaderDrac_mps2(10.0, 20.0, 20.0, 5.0), 0.0);
  EXPECT_DEATH((void)BrakingLeaderDrac_mps2(10.0, 20.0, 20.0, 0.0), "leader_mps2 > 0.0");
}

TEST(ContractsDeathTest, AQuantileIsAShareAndWeightsAreAsManyAsValues) {
  EXPECT_EQ(Quantile(kThree, 1.0), 3.0);
  for (const double p : {-0.01, 1.01}) EXPECT_DEATH((void)Quantile(kThree, p), "p >= 0.0 && p <= 1.0");
  EXPECT_DEATH((void)WeightedMean(kThree, kTwo), "weights.size\\(\\)");
}

TEST(ContractsDeathTest, ACutoffLiesBetweenZeroAndHalfTheRate) {
  for (const double cutoff_hz : {0.0, 50.0}) {
    EXPECT_DEATH((void)ButterworthLowPass(cutoff_hz, kRate_hz), "IsCutoff");
    EXPECT_DEATH((void)ButterworthHighPass(cutoff_hz, kRate_hz), "IsCutoff");
  }
  EXPECT_GT(ButterworthLowPass(49.9, kRate_hz).b0, 0.0);
}

TEST(ContractsDeathTest, ARateIsAboveZero) {
  EXPECT_DEATH((void)Decimate(kThree, 0), "factor >= 1");
  EXPECT_DEATH((void)Resample(kThree, 0.0, kRate_hz), "from_hz > 0.0");
  EXPECT_DEATH((void)Resample(kThree, kRate_hz, 0.0), "to_hz > 0.0");
  EXPECT_EQ(Resample(kThree, kRate_hz, kRate_hz), kThree);
}

TEST(ContractsDeathTest, ASpectrumIsOfTwoSeriesOfOneLengthInSegmentsOfFourSamples) {
  EXPECT_DEATH((void)WelchSpectrum(kThree, kTwo, kRate_hz, 4, 10.0), "x.size\\(\\) == y.size\\(\\)");
  EXPECT_DEATH((void)WelchSpectrum(kThree, kThree, kRate_hz, 3, 10.0), "segment >= 4");
  EXPECT_EQ(WelchSpectrum(kThree, kThree, kRate_hz, 4, 10.0).segments, 0U);
}

TEST(ContractsDeathTest, AMeasureReadsItsOwnOptions) {
  const std::array<OptionInfo, 1> infos{{{"cutoff_hz", 5.0, 0.1, 50.0, "cut-off"}}};
  const std::map<std::string, double> none;
  const OptionValues values(infos, none);
  EXPECT_EQ(values["cutoff_hz"], 5.0);
  EXPECT_DEATH((void)values["window_s"], "infos_.end\\(\\)");
}

}  // namespace
}  // namespace rodeira::measures
