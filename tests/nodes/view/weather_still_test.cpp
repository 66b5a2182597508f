// SPDX-License-Identifier: Apache-2.0
// What the weather does to a picture, asked of single pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/n222.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 960, kHeight = 540;

// At one place: N222's first straight.
class WeatherStill : public DriverStill {
 protected:
  WeatherStill() : DriverStill("n222.yaml", kWidth, kHeight) {}
  void SetUp() override {
    DriverStill::SetUp();
    if (IsSkipped()) return;
    Car() = CarOn(N222Road(), 60.0, -1.45);
    camera_ = scene::DriverCamera(Car());
  }
  Image In(const weather::Weather& weather) {
    picture_.moment.weather = weather;
    return Drawn();
  }
  // The road's surface so far ahead of the driver, in the own lane and the other one.
  Probe Road(const Image& image, double ahead_m, double t_m = -1.45) {
    return ProbeAt(image, camera_, N222Road().Position(60.0 + ahead_m, t_m), 2);
  }
  static double Brightness(const Probe& probe) { return (probe.red + probe.green + probe.blue) / 3.0; }

  scene::Camera camera_;
};

TEST_F(WeatherStill, AtNightOnlyTheHeadlightsShowTheRoad) {
  weather::Weather night;
  night.hour = 1.0;
  night.clouds = 0.0;
  const Image day = In({}), dark = In(night);
  EXPECT_LT(Brightness(ProbeAt(dark, 0.5 * kWidth, 10)), 0.15 * Brightness(ProbeAt(day, 0.5 * kWidth, 10)));
  const double near = Brightness(Road(dark, 18.0)), far = Brightness(Road(dark, 110.0));
  EXPECT_GT(near, 40.0);
  EXPECT_LT(far, 0.5 * near);
  picture_.moment.cars[0].p_WB_W += Eigen::Vector3d(0.0, 0.0, 300.0);  // high above: its beam reaches nothing
  const Image without = In(night);
  picture_.moment.cars[0].p_WB_W -= Eigen::Vector3d(0.0, 0.0, 300.0);
  EXPECT_LT(Brightness(ProbeAt(without, 0.5 * kWidth, kHeight - 10)), 0.5 * near);
}

// By the law of the beam, 1 / (1 + (d / reach)^2), 110 m ahead gets 5 times as much light where it reaches 60 m instead
// of 24.
TEST_F(WeatherStill, TheMainBeamReachesFartherThanTheDippedOne) {
  weather::Weather night;
  night.hour = 1.0;
  night.clouds = 0.0;
  picture_.moment.cars[0].lights.dipped = true;
  const Image dipped = In(night);
  picture_.moment.cars[0].lights.main = true;
  const Image main_beam = In(night);
  EXPECT_GT(Brightness(Road(main_beam, 110.0)), 1.5 * Brightness(Road(dipped, 110.0)));
  EXPECT_NEAR(Brightness(Road(main_beam, 8.0)) / Brightness(Road(dipped, 8.0)), 1.0, 0.15) << "nearby it is as bright";
}

// A place d away differs from the fog by exp(-3 d / visibility) of what it would without: asked of two fogs with the
// same light.
TEST_F(WeatherStill, FogTakesTheContrast) {
  weather::Weather thick, thin;
  thick.visibility_m = 60.0;
  thin.visibility_m = 150.0;
  const Image in_thick = In(thick), in_thin = In(thin);
  const double fog = Brightness(ProbeAt(in_thick, 0.5 * kWidth, kHeight * 0.47, 2));
  for (const double ahead_m : {10.0, 25.0, 40.0}) {
    const Eigen::Vector3d place = N222Road().Position(60.0 + ahead_m, -1.45);
    const double distance_m = (place - camera_.eye_W).norm(),
                 expected = std::exp(-3.0 * distance_m / 60.0 + 3.0 * distance_m / 150.0);
    const double much = fog - Brightness(Road(in_thin, ahead_m)), little = fog - Brightness(Road(in_thick, ahead_m));
    EXPECT_GT(much, 20.0) << ahead_m;
    EXPECT_NEAR(little, expected * much, 2.0) << ahead_m << " m: " << much << " of 255";
  }
}

TEST_F(WeatherStill, AWetRoadIsDarkNearbyAndMirrorsTheSkyFarAway) {
  weather::Weather wet;
  wet.wetness = 1.0;
  const Image dry = In({}), drenched = In(wet);
  EXPECT_LT(Brightness(Road(drenched, 7.0)), 0.8 * Brightness(Road(dry, 7.0)));
  EXPECT_GT(Brightness(Road(drenched, 100.0)), Brightness(Road(dry, 100.0)) + 10.0);
}

// A picture is a function of what it shows: the same moment again after other weather is the same picture.
TEST_F(WeatherStill, RainFallsAndLeavesNothingBehind) {
  weather::Weather rain;
  rain.rain_mmph = 40.0;
  const Image before = In({});
  picture_.moment.time_ns = 3'000'000'000;
  const Image first = In(rain);
  picture_.moment.time_ns = 3'020'000'000;
  const Image second = In(rain);
  EXPECT_NE(first.rgb, second.rgb);
  picture_.moment.time_ns = 0;
  EXPECT_EQ(In({}).rgb, before.rgb);
}

}  // namespace
}  // namespace rodeira::nodes
