// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/lighting/air.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rodeira::scene {
namespace {

using weather::Weather;

Air At(double hour, double clouds = 0.0) {
  Weather weather;
  weather.hour = hour;
  weather.clouds = clouds;
  return MakeAir(weather);
}
double Brightness(const Eigen::Vector3f& colour) { return static_cast<double>(colour.sum()); }

// At an equinox the sun rises due east at six, stands 90 - 42 degrees high in the south at noon, and sets due west at
// six.
TEST(Air, TheSunGoesAsAtAnEquinox) {
  EXPECT_NEAR((At(6.0).sun_W - Eigen::Vector3f(1.0F, 0.0F, 0.0F)).norm(), 0.0F, 1e-6F);
  EXPECT_NEAR((At(18.0).sun_W - Eigen::Vector3f(-1.0F, 0.0F, 0.0F)).norm(), 0.0F, 1e-6F);
  const double degree = std::numbers::pi / 180.0;
  const Eigen::Vector3f noon(0.0F, static_cast<float>(-std::cos(48.0 * degree)),
                             static_cast<float>(std::sin(48.0 * degree)));
  EXPECT_NEAR((At(12.0).sun_W - noon).norm(), 0.0F, 1e-6F);
  EXPECT_NEAR(SunHeight_rad(0.0), -48.0 * degree, 1e-9);
  for (double hour = 0.0; hour < 24.0; hour += 0.37) {
    EXPECT_NEAR(At(hour).sun_W.norm(), 1.0F, 1e-6F);
    EXPECT_NEAR(std::asin(static_cast<double>(At(hour).sun_W.z())), SunHeight_rad(hour), 1e-6);
  }
}

TEST(Air, TheLowerTheSunTheDarkerAndNothingJumps) {
  for (double hour = 12.0; hour < 23.98; hour += 0.01) {
    const Air now = At(hour), later = At(hour + 0.01);
    const auto light = [](const Air& air) { return Brightness(air.base_light + air.sky_light + air.sun_light); };
    EXPECT_LE(light(later), light(now) + 1e-6) << hour;
    EXPECT_LT(light(now) - light(later), 0.05) << hour;
    EXPECT_LT((later.horizon - now.horizon).norm(), 0.05F) << hour;
  }
  EXPECT_EQ(At(0.0).sun_light, Eigen::Vector3f::Zero());
  EXPECT_EQ(At(0.0).disc, 0.0F);
}

TEST(Air, CloudsTakeTheSun) {
  EXPECT_EQ(At(12.0, 0.5).sun_light, At(12.0, 0.0).sun_light);
  EXPECT_LT(Brightness(At(12.0, 0.8).sun_light), 0.6 * Brightness(At(12.0, 0.0).sun_light));
  EXPECT_EQ(At(12.0, 1.0).sun_light, Eigen::Vector3f::Zero());
  EXPECT_GT(Brightness(At(12.0, 1.0).base_light), Brightness(At(12.0, 0.0).base_light))
      << "its light is spread, not lost";
}

// Koschmieder's law with a threshold of a twentieth (the meteorological optical range): exp(-3) = 0.0498.
TEST(Air, AtTheVisibilityATwentiethIsLeft) {
  for (const double visibility_m : {50.0, 200.0, 1000.0}) {
    Weather weather;
    weather.visibility_m = visibility_m;
    EXPECT_NEAR(std::exp(-static_cast<double>(MakeAir(weather).fog_per_m) * visibility_m), 0.05, 0.002) << visibility_m;
  }
  EXPECT_EQ(MakeAir({}).fog_per_m, 0.0F);
}

TEST(Air, HeadlightsAreOnWhereADriverPutsThemOn) {
  EXPECT_EQ(At(13.0).headlights, 0.0F);
  EXPECT_GT(At(18.0).headlights, 0.5F);
  EXPECT_EQ(At(2.0).headlights, 1.0F);
  Weather fog, rain;
  fog.visibility_m = 250.0;
  rain.rain_mmph = 2.0;
  for (const Weather& weather : {fog, rain}) {
    EXPECT_GT(MakeAir(weather).headlights, 0.0F);
    EXPECT_LT(MakeAir(weather).headlights, 0.3F) << "by day they light little";
  }
}

}  // namespace
}  // namespace rodeira::scene
