// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/named_weather.hpp"

#include <gtest/gtest.h>

namespace rodeira::weather {
namespace {

// Whatever the weather was, what is asked for by a word is there at the end, and it comes evenly.
TEST(NamedWeather, EachBecomesTheSameFromWhateverWasBefore) {
  ASSERT_FALSE(NamedWeathers().empty());
  for (const NamedWeather& named : NamedWeathers()) {
    for (const NamedWeather& before : NamedWeathers()) {
      WeatherPlan plan;
      Change first = before.change, then = named.change;
      first.at_s = 1.0;
      then.at_s = 10.0;
      then.over_s = 4.0;
      plan.Add(then);
      plan.Add(first);  // whichever is added first
      const Weather from = plan.At(10.0), middle = plan.At(12.0), now = plan.At(14.0);
      EXPECT_EQ(now.wetness, *named.change.wetness) << named.name << " behind " << before.name;
      EXPECT_EQ(now.rain_mmph, *named.change.rain_mmph);
      EXPECT_EQ(now.visibility_m, *named.change.visibility_m);
      EXPECT_EQ(now.clouds, *named.change.clouds);
      EXPECT_EQ(now.hour, named.change.hour.value_or(from.hour));
      EXPECT_DOUBLE_EQ(middle.wetness, 0.5 * (from.wetness + now.wetness));
      EXPECT_DOUBLE_EQ(middle.clouds, 0.5 * (from.clouds + now.clouds));
    }
  }
}

// A change of what is still changing begins where that is then.
TEST(NamedWeather, AChangeInTheMiddleOfAnotherDoesNotJump) {
  WeatherPlan plan;
  Change rain = FindWeather("rain").value(), fine = FindWeather("fine").value();
  rain.at_s = 2.0, rain.over_s = 10.0;
  fine.at_s = 7.0, fine.over_s = 10.0;
  plan.Add(rain);
  const double half_wet = plan.At(7.0).wetness;
  EXPECT_DOUBLE_EQ(half_wet, 0.4);
  plan.Add(fine);
  EXPECT_EQ(plan.At(7.0).wetness, half_wet);
  EXPECT_EQ(plan.At(17.0).wetness, 0.0);
}

TEST(NamedWeather, AnUnknownWordIsRefusedWithTheNearest) {
  const auto found = FindWeather("rian");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().Text(), "'rian' is no weather; did you mean 'rain'?");
}

}  // namespace
}  // namespace rodeira::weather
