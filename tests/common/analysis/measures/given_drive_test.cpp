// SPDX-License-Identifier: Apache-2.0
// Tables of other programs: what follows from their columns, and what is refused.
#include "common/analysis/measures/given_drive.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/spec.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate_hz = 50.0;

double ValueOf(const char* name, const Drive& drive) {
  const auto info = FindMeasure(name);
  EXPECT_TRUE(info.ok());
  const Measure m = info.value()->compute({drive, 0, drive.size(), {}}, {info.value()->options, {}});
  return m.value.value_or(kMissing);
}

// y = A sin(2 pi f t) over whole periods: SD A / sqrt(2).
TEST(GivenDrive, SdlpOfASine) {
  GivenDrive given;
  given.rate_hz = kRate_hz;
  constexpr int kSamples = 3000;
  constexpr double kAmplitude_m = 0.3;
  for (int k = 0; k < kSamples; ++k) {
    given.columns["lane_position_m"].push_back(kAmplitude_m * std::sin(2.0 * std::numbers::pi * 0.1 * k / kRate_hz));
    given.columns["lane_width_m"].push_back(3.5);
    given.columns["speed_mps"].push_back(20.0);
  }
  const auto drive = DriveOf(given);
  ASSERT_TRUE(drive.ok()) << drive.error().Text();
  const double n = kSamples;
  EXPECT_NEAR(ValueOf("sdlp_m", drive.value()), kAmplitude_m / std::numbers::sqrt2 * std::sqrt(n / (n - 1.0)), 1e-12);
  EXPECT_NEAR(ValueOf("speed_mean_mps", drive.value()), 20.0, 1e-12);
  EXPECT_TRUE(std::isnan(ValueOf("gap_mean_m", drive.value()))) << "a column that is not given is missing";
}

// Approach at a constant closing speed: TTC = gap / closing speed.
TEST(GivenDrive, TimeToCollisionOfAnApproach) {
  GivenDrive given;
  given.rate_hz = kRate_hz;
  for (int k = 0; k < 200; ++k) {
    given.columns["speed_mps"].push_back(25.0);
    given.columns["leader_speed_mps"].push_back(15.0);
    given.columns["leader_gap_m"].push_back(100.0 - 10.0 * k / kRate_hz);
    given.columns["leader_id"].push_back(1.0);
  }
  const auto drive = DriveOf(given);
  ASSERT_TRUE(drive.ok());
  EXPECT_NEAR(ValueOf("ttc_min_s", drive.value()), 10.0 - 199.0 / kRate_hz, 1e-9);
}

// From the lane's left line the position jumps to the right line of the next lane, and back.
TEST(GivenDrive, AJumpOfTheLanePositionIsALaneChange) {
  for (const bool with_lane : {false, true}) {
    GivenDrive given;
    given.rate_hz = kRate_hz;
    for (int k = 0; k < 600; ++k) {
      // A slow way to the left over one lane of 3.5 m, and back to the right.
      const double across = 3.5 * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * k / 600.0));
      const bool left = across > 1.75;
      given.columns["lane_position_m"].push_back(left ? across - 3.5 : across);
      given.columns["lane_width_m"].push_back(3.5);
      if (with_lane) given.columns["lane"].push_back(left ? -1.0 : -2.0);
    }
    const auto drive = DriveOf(given);
    ASSERT_TRUE(drive.ok());
    std::vector<int> crossings;
    for (const std::int8_t crossing : drive.value().crossing) {
      if (crossing != 0) crossings.push_back(crossing);
    }
    EXPECT_THAT(crossings, ::testing::ElementsAre(1, -1)) << "to the left, then to the right";
    EXPECT_EQ(drive.value().episode.back(), 2);
    EXPECT_EQ(ValueOf("lane_changes_n", drive.value()), 2.0);
  }
}

TEST(GivenDrive, LinesFollowFromTheFootprint) {
  GivenDrive given;
  given.rate_hz = kRate_hz;
  given.columns["lane_position_m"] = {0.5};
  given.columns["lane_width_m"] = {3.5};
  given.length_m = 4.5;
  given.front_m = 3.5;
  given.width_m = 1.8;
  const auto drive = DriveOf(given);
  ASSERT_TRUE(drive.ok());
  EXPECT_NEAR(drive.value().left_line_m[0], 1.75 - 0.5 - 0.9, 1e-12);
  EXPECT_NEAR(drive.value().right_line_m[0], 1.75 + 0.5 - 0.9, 1e-12);
}

TEST(GivenDrive, WrongTablesAreRefused) {
  GivenDrive given;
  given.rate_hz = kRate_hz;
  given.columns["speed_mph"] = {1.0};
  const auto unknown = DriveOf(given);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().id.text(), "measure.unknown_column");
  EXPECT_THAT(unknown.error().message, ::testing::HasSubstr("'speed_mps'"));
  given.columns = {{"speed_mps", {1.0, 2.0}}, {"throttle", {0.0}}};
  EXPECT_EQ(DriveOf(given).error().id.text(), "config.wrong_length");
  given.columns.erase("throttle");
  given.rate_hz = 0.0;
  EXPECT_EQ(DriveOf(given).error().id.text(), "config.out_of_range");
}

TEST(SetOption, RefusesUnknownOptionsAndValuesOutOfRange) {
  MeasuresSpec spec = DefaultSpec();
  const MeasureInfo& tet = *FindMeasure("tet_s").value();
  EXPECT_TRUE(SetOption(tet, "threshold_s", 2.0, spec).ok());
  EXPECT_EQ(spec.options.at("tet_s").at("threshold_s"), 2.0);
  const auto unknown = SetOption(tet, "treshold_s", 2.0, spec);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().id.text(), "config.unknown_key");
  EXPECT_THAT(unknown.error().message, ::testing::HasSubstr("'threshold_s'"));
  EXPECT_EQ(SetOption(tet, "threshold_s", -1.0, spec).error().id.text(), "config.out_of_range");
}

}  // namespace
}  // namespace rodeira::measures
