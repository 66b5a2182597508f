// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/weather_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/names.hpp"

namespace rodeira::weather {
namespace {

base::Result<WeatherPlan> Read(const std::string& changes) {
  auto file = config::File::Parse("weather:\n" + changes, "story.yaml");
  if (!file) return file.error();
  WeatherPlan plan = ReadWeather(file.value().root().Items("weather"));
  if (const auto status = file.value().Finish(); !status) return status.error();
  return plan;
}

std::string Complaint(const std::string& changes) {
  const auto read = Read(changes);
  if (read.ok()) return {};
  EXPECT_EQ(read.error().exit_status(), 2);
  return read.error().Text();
}

TEST(WeatherPlan, WithoutAWordItStaysFine) {
  for (const double time_s : {0.0, 1.0, 1e5}) EXPECT_EQ(WeatherPlan().At(time_s), Weather{});
}

TEST(WeatherPlan, IsWhatTheFileSays) {
  const auto plan = Read(
      "  - {wetness: 0.2, hour: 8, clouds: 0}\n  - {at_s: 10, over_s: 20, wetness: 0.8, rain_mmph: 30}\n  - {at_s: 60, "
      "wetness: 0.5}\n");
  ASSERT_TRUE(plan.ok()) << plan.error().Text();
  Weather expected;
  expected.wetness = 0.2;
  expected.hour = 8.0;
  expected.clouds = 0.0;
  EXPECT_EQ(plan.value().At(0.0), expected);
  EXPECT_EQ(plan.value().At(10.0), expected);
  EXPECT_DOUBLE_EQ(plan.value().At(15.0).wetness, 0.35);
  EXPECT_DOUBLE_EQ(plan.value().At(15.0).rain_mmph, 7.5);
  EXPECT_EQ(plan.value().At(30.0).wetness, 0.8);
  EXPECT_EQ(plan.value().At(59.999).wetness, 0.8);
  EXPECT_EQ(plan.value().At(60.0).wetness, 0.5);
  EXPECT_EQ(plan.value().At(60.0).rain_mmph, 30.0);
}

// For every query: the same time has the same weather, and a change that comes amid another begins where that one is.
TEST(WeatherPlan, AChangeAmidAnotherGoesOnFromThere) {
  const auto plan = Read("  - {at_s: 0, over_s: 10, wetness: 1}\n  - {at_s: 5, over_s: 5, wetness: 0}\n");
  ASSERT_TRUE(plan.ok()) << plan.error().Text();
  EXPECT_DOUBLE_EQ(plan.value().At(4.0).wetness, 0.4);
  EXPECT_DOUBLE_EQ(plan.value().At(5.0).wetness, 0.5);
  EXPECT_DOUBLE_EQ(plan.value().At(7.5).wetness, 0.25);
  EXPECT_EQ(plan.value().At(10.0).wetness, 0.0);
  EXPECT_DOUBLE_EQ(plan.value().At(4.0).wetness, 0.4);
}

TEST(WeatherPlan, FogComesEvenlyInTheReciprocalOfTheVisibility) {
  const auto plan = Read("  - {visibility_m: 1000}\n  - {at_s: 10, over_s: 10, visibility_m: 100}\n");
  ASSERT_TRUE(plan.ok()) << plan.error().Text();
  EXPECT_NEAR(plan.value().At(15.0).visibility_m, 2.0 / (1.0 / 1000 + 1.0 / 100), 1e-9);
  EXPECT_NEAR(plan.value().At(25.0).visibility_m, 100.0, 1e-9);
}

TEST(WeatherPlan, TheDayGoesForward) {
  const auto plan = Read("  - {hour: 22}\n  - {over_s: 80, hour: 6}\n");
  ASSERT_TRUE(plan.ok()) << plan.error().Text();
  EXPECT_DOUBLE_EQ(plan.value().At(10.0).hour, 23.0);
  EXPECT_NEAR(plan.value().At(20.0).hour, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(plan.value().At(50.0).hour, 3.0);
  EXPECT_DOUBLE_EQ(plan.value().At(1000.0).hour, 6.0);
}

TEST(WeatherPlan, WrongOnesAreRefused) {
  using ::testing::HasSubstr;
  EXPECT_THAT(Complaint("  - {wetness: 1.5}\n"), HasSubstr("story.yaml:2: 'weather[0].wetness' is 1.5"));
  EXPECT_THAT(Complaint("  - {hour: 24}\n"), HasSubstr("hour"));
  EXPECT_THAT(Complaint("  - {wetnes: 1}\n"), HasSubstr("wetness"));
  EXPECT_THAT(Complaint("  - {visibility_m: 5}\n"), HasSubstr("visibility_m"));
  EXPECT_THAT(Complaint("  - {at_s: 5, wetness: 1}\n  - {at_s: 4, wetness: 0}\n"),
              Names("story.yaml:3: 'at_s' is 4 … 5; … not descend"));
}

}  // namespace
}  // namespace rodeira::weather
