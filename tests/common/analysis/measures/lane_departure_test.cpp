// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_departure.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/given_drive.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// A parabola over the line: inside = a (t - t0)^2 - h is beyond it for 2 sqrt(h / a), at most h, with the area
// 4 h / 3 sqrt(h / a).
TEST(LaneDeparture, DurationGreatestAndAreaOfAParabola) {
  constexpr double kHeight = 0.3, kA = 0.12;
  const auto inside = Sampled(10.0, kRate, [](double t) { return kA * (t - 5.0) * (t - 5.0) - kHeight; });
  const auto departures = Departures(inside, kRate, {});
  ASSERT_EQ(departures.size(), 1u);
  const double half_s = std::sqrt(kHeight / kA);
  EXPECT_NEAR(static_cast<double>(departures[0].to - departures[0].from) / kRate, 2.0 * half_s, 0.011);
  EXPECT_NEAR(departures[0].greatest_m, kHeight, 1e-9);
  EXPECT_NEAR(departures[0].area_ms, 4.0 / 3.0 * kHeight * half_s, 1e-3);
  EXPECT_FALSE(departures[0].open);
  EXPECT_EQ(*DepartureArea(departures, inside, {}).value, departures[0].area_ms);
}

// One drive along the line that trembles by 5 cm is one departure; without hysteresis it is many.
TEST(LaneDeparture, HysteresisMakesOneOfTen) {
  const auto inside = Sampled(10.0, kRate, [](double t) {
    return (t < 2.0 || t > 8.0 ? 0.5 : 0.0) + 0.05 * std::cos(2.0 * std::numbers::pi * 2.0 * t);
  });
  EXPECT_EQ(Departures(inside, kRate, {}).size(), 1u);
  EXPECT_GE(Departures(inside, kRate, {.hysteresis_m = 0.0}).size(), 10u);
}

TEST(LaneDeparture, ShortOnesAndGapsEndOne) {
  std::vector<double> inside(1000, 0.4);
  for (std::size_t i = 100; i < 115; ++i) inside[i] = -0.2;  // 0.15 s: too short
  for (std::size_t i = 300; i < 340; ++i) inside[i] = -0.2;
  inside[330] = kMissing;  // 0.3 s before it, and 0.09 s behind it
  for (std::size_t i = 900; i < 1000; ++i) inside[i] = -0.1;
  std::vector<std::uint8_t> indicator(1000, 0);
  indicator[900] = 1;
  const auto departures = Departures(inside, kRate, {}, indicator);
  ASSERT_EQ(departures.size(), 2u);
  EXPECT_EQ(departures[0].to, 330u);
  EXPECT_FALSE(departures[0].intended);
  EXPECT_TRUE(departures[1].intended);
  EXPECT_TRUE(departures[1].open);
  EXPECT_EQ(*DepartureCount(departures, inside, {}).value, 2.0);
  EXPECT_NEAR(*DepartureShare(departures, inside, {}).value, 130.0 / 999.0, 1e-12);
  EXPECT_NEAR(*DepartureGreatest(departures, inside, {}).value, 0.2, 1e-12);
}

// As measures: a parabola over the left line, at most 0.3 m, and one over the right one, at most 0.1 m. A part 0.15 m
// inside the body goes over the left one alone, the outer edge of a paint of 0.12 m makes both smaller by 0.06 m.
TEST(LaneDeparture, MeasuresSayWhichSidePartAndEdgeCount) {
  constexpr double kA = 0.12;
  GivenDrive given;
  given.rate_hz = kRate;
  given.columns["left_line_m"] = Sampled(20.0, kRate, [](double t) { return kA * (t - 5.0) * (t - 5.0) - 0.3; });
  given.columns["right_line_m"] = Sampled(20.0, kRate, [](double t) { return kA * (t - 15.0) * (t - 15.0) - 0.1; });
  given.columns["lane_position_m"] = std::vector<double>(2000, 0.0);
  const Drive drive = DriveOf(given).value();
  const auto measure = [&](const char* name, const std::map<std::string, double>& options) {
    const MeasureInfo& info = *FindMeasure(name).value();
    return info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, options));
  };
  const auto area_ms = [](double beyond_m) { return 4.0 / 3.0 * beyond_m * std::sqrt(beyond_m / kA); };
  EXPECT_EQ(*measure("lane_departures_n", {}).value, 2.0);
  EXPECT_EQ(*measure("lane_departures_n", {{"side", 1.0}}).value, 1.0);
  EXPECT_EQ(*measure("lane_departures_n", {{"inset_m", 0.15}}).value, 1.0);
  EXPECT_EQ(*measure("lane_departures_n", {{"side", 2.0}, {"inset_m", 0.15}}).value, 0.0);
  EXPECT_NEAR(*measure("lane_departure_greatest_m", {{"side", 2.0}}).value, 0.1, 1e-12);
  EXPECT_NEAR(*measure("lane_departure_greatest_m", {{"inset_m", 0.15}}).value, 0.15, 1e-12);
  EXPECT_NEAR(*measure("lane_departure_area_ms", {}).value, area_ms(0.3) + area_ms(0.1), 1e-3);
  EXPECT_NEAR(*measure("lane_departure_area_ms", {{"paint_m", 0.06}}).value, area_ms(0.24) + area_ms(0.04), 1e-3);
  EXPECT_NEAR(*measure("lane_departure_area_ms", {{"paint_m", -0.06}}).value, area_ms(0.36) + area_ms(0.16), 1e-3);
  const Measure right = measure("lane_departures_share", {{"side", 2.0}});
  EXPECT_NEAR(*right.value, 2.0 * std::sqrt(0.1 / kA) / 20.0, 2e-3);
  EXPECT_EQ(right.options[2], (UsedOption{"side", "right"}));
}

TEST(LaneDeparture, NoLineIsMissingAndNoDepartureIsZero) {
  const std::vector<double> inside(10, 0.5), nothing(10, kMissing);
  EXPECT_EQ(*DepartureCount({}, inside, {}).value, 0.0);
  EXPECT_FALSE(DepartureCount({}, nothing, {}).value);
  EXPECT_EQ(*DepartureArea({}, inside, {}).value, 0.0);
  EXPECT_FALSE(DepartureArea({}, nothing, {}).value);
  EXPECT_FALSE(DepartureGreatest({}, inside, {}).value);
}

}  // namespace
}  // namespace rodeira::measures
