// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/speed.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/pedals.hpp"
#include "common/analysis/measures/stops.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

// 100 s at 10 m/s and 100 s at 30 m/s, and a wait of 50 s: 20 m/s over time; over distance (10 * 1000 + 30 * 3000) /
// 4000 = 25 m/s.
TEST(Speed, MeansOverTimeAndDistance) {
  const auto speed = Sampled(250.0, kRate, [](double t) { return t < 100.0 ? 10.0 : t < 150.0 ? 0.0 : 30.0; });
  EXPECT_NEAR(*MeanSpeed(speed, 0.1).value, 20.0, 1e-9);
  EXPECT_NEAR(*MeanSpeedByDistance(speed, 0.1).value, 25.0, 1e-9);
  EXPECT_NEAR(MeanSpeed(speed, 0.1).valid_share, 0.8, 1e-12);
  EXPECT_NEAR(*Distance(speed, kRate).value, 4000.0, 0.5);
  const std::vector<double> waits(100, 0.0);
  EXPECT_FALSE(MeanSpeed(waits, 0.1).value);
}

// 10 + t m/s for 20 s, limit 20 m/s in the second half and none in the first: above it for half of that, above it by
// 5 m/s for a quarter of the 20 s, half of the second half.
TEST(Speed, TimeAboveTheLimit) {
  const auto speed = Sampled(20.0, kRate, [](double t) { return 12.5 + t; });
  const auto limit = Sampled(20.0, kRate, [](double t) { return t < 10.0 ? kMissing : 22.5; });
  EXPECT_NEAR(*ShareAboveLimit(speed, limit, 0.0).value, 1.0, 0.002);
  EXPECT_NEAR(*ShareAboveLimit(speed, limit, 5.0).value, 0.5, 0.002);
  EXPECT_FALSE(ShareAboveLimit(speed, std::vector<double>(2000, kMissing), 0.0).value);
}

TEST(Stops, TheFirstSlowSampleCounts) {
  // 10 m/s, braking by 2 m/s^2 from 5 s on, at rest from 10 s to 16 s, then off by 1 m/s^2.
  const auto speed = Sampled(20.0, kRate, [](double t) {
    return t < 5.0 ? 10.0 : t < 10.0 ? 10.0 - 2.0 * (t - 5.0) : t < 16.0 ? 0.0 : t - 16.0;
  });
  // The line is 1.5 m ahead at rest; 0.1 m/s are reached 0.0025 m before that.
  const auto ahead = Sampled(20.0, kRate, [](double t) { return t < 10.0 ? 1.5 + (10.0 - t) * (10.0 - t) : 1.5; });
  const auto stops = Stops(speed, {});
  ASSERT_EQ(stops.size(), 1u);
  EXPECT_NEAR(*StopTime(speed, kRate, {}).value, 6.0 + 0.05 + 0.5, 0.021);
  EXPECT_NEAR(*StopDistance(speed, ahead, {}).value, 1.5025, 1e-3);
  EXPECT_EQ(*StopCount(Series(speed).first(500), {}).value, 0.0);
  EXPECT_FALSE(StopDistance(Series(speed).first(500), Series(ahead).first(500), {}).value);
}

TEST(Pedals, AFootThatRestsIsNoPress) {
  std::vector<double> pedal(1000, 0.015);                    // rests
  for (std::size_t i = 200; i < 300; ++i) pedal[i] = 0.5;    // pressed
  for (std::size_t i = 300; i < 350; ++i) pedal[i] = 0.012;  // not below `off`: still the same press
  for (std::size_t i = 350; i < 400; ++i) pedal[i] = 0.3;
  for (std::size_t i = 400; i < 1000; ++i) pedal[i] = 0.0;
  const auto presses = PedalPresses(pedal, kRate, {});
  ASSERT_EQ(presses.size(), 1u);
  EXPECT_EQ(presses[0].from, 200u);
  EXPECT_EQ(presses[0].to, 400u);
  EXPECT_EQ(presses[0].largest, 0.5);
  EXPECT_NEAR(presses[0].integral_s, 0.5 + 0.006 + 0.15, 1e-9);
  EXPECT_EQ(*FirstPedalPress(pedal, kRate, {}).value, 2.0);
  EXPECT_FALSE(FirstPedalPress(Series(pedal).first(100), kRate, {}).value);
  std::vector<double> other(1000, 0.0);
  for (std::size_t i = 250; i < 500; ++i) other[i] = 0.2;
  EXPECT_NEAR(*BothPedalsShare(pedal, other, kRate, {}).value, 0.15, 1e-12);
}

}  // namespace
}  // namespace rodeira::measures
