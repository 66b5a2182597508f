// SPDX-License-Identifier: Apache-2.0
// The signals are drawn by hand, so that the times are known: throttle 0.4 falls linearly from 0.8 s to 1.0 s, the
// brake is pressed from 1.3 s on and full at 1.8 s, the wheel is turned by 10 deg/s from 2.0 s on.
#include "common/analysis/measures/responses.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

constexpr double kRate = 100.0;

std::vector<double> Throttle() {
  return Sampled(5.0, kRate, [](double t) { return 0.4 * std::clamp((1.0 - t) / 0.2, 0.0, 1.0); });
}
std::vector<double> Brake() {
  return Sampled(5.0, kRate, [](double t) { return 0.8 * std::clamp((t - 1.3) / 0.5, 0.0, 1.0); });
}
std::vector<double> Wheel() {
  return Sampled(5.0, kRate, [](double t) { return -15.0 - 10.0 * std::max(0.0, t - 2.0); });
}

TEST(Responses, TimesAreThoseOfTheSignals) {
  // 10 % of the value are gone after 0.02 s; below 1 % of the travel it is after 0.195 s.
  EXPECT_NEAR(*AcceleratorRelease(Throttle(), kRate, {}).time_s, 0.82, 0.011);
  EXPECT_NEAR(*AcceleratorReleased(Throttle(), kRate, {}).time_s, 0.995, 0.011);
  EXPECT_NEAR(*BrakeOnset(Brake(), kRate, {}).time_s, 1.30625, 0.011);
  EXPECT_NEAR(*MovementTime(Throttle(), Brake(), kRate, {}).time_s, 1.30625 - 0.995, 0.011);
  EXPECT_NEAR(*TimeToFullBrake(Brake(), kRate, {}).time_s, 0.95 * 0.5 - 0.00625, 0.021);
  EXPECT_NEAR(*SteeringOnset(Wheel(), kRate, {}).time_s, 2.2, 0.011);
  EXPECT_NEAR(*FirstResponse(Throttle(), Brake(), Wheel(), kRate, {}).time_s, 0.82, 0.011);
}

TEST(Responses, WhatIsThereAtTheEventIsNoResponse) {
  const std::vector<double> pressed(500, 0.3), released(500, 0.0);
  EXPECT_EQ(BrakeOnset(pressed, kRate, {}).flag, ResponseFlag::kPre);
  EXPECT_FALSE(BrakeOnset(pressed, kRate, {}).time_s);
  EXPECT_EQ(AcceleratorRelease(released, kRate, {}).flag, ResponseFlag::kPre);
}

TEST(Responses, NoneBeforeTheEndIsMissingAndNotTheWindow) {
  const std::vector<double> still(500, 0.0), held(500, 0.3);
  for (const Response& r : {BrakeOnset(still, kRate, {}), SteeringOnset(still, kRate, {}),
                            AcceleratorRelease(held, kRate, {}), FirstResponse(held, still, still, kRate, {})}) {
    EXPECT_FALSE(r.time_s);
    EXPECT_EQ(r.flag, ResponseFlag::kCensored);
  }
  const Measure m = AsMeasure(BrakeOnset(still, kRate, {}), still, kRate, {});
  EXPECT_FALSE(m.value);
  EXPECT_EQ(m.reason, "censored: no response before the window ends");
}

TEST(Responses, AnticipationIsFlaggedAndATwitchIsNone) {
  auto brake = Brake();
  brake.erase(brake.begin(), brake.begin() + 120);  // the onset is now 0.106 s after the event
  const Response early = BrakeOnset(brake, kRate, {});
  EXPECT_EQ(early.flag, ResponseFlag::kAnticipation);
  EXPECT_NEAR(*early.time_s, 0.10625, 0.011);
  auto wheel = std::vector<double>(500, 0.0);
  for (std::size_t i = 100; i < 105; ++i) wheel[i] = 5.0;  // 50 ms: not sustained
  for (std::size_t i = 300; i < 320; ++i) wheel[i] = 5.0;
  EXPECT_NEAR(*SteeringOnset(wheel, kRate, {}).time_s, 3.0, 1e-12);
  // A throttle that falls and is pressed again is released by the later fall only.
  auto throttle = std::vector<double>(500, 0.4);
  for (std::size_t i = 100; i < 150; ++i) throttle[i] = 0.3;
  for (std::size_t i = 400; i < 500; ++i) throttle[i] = 0.0;
  EXPECT_NEAR(*AcceleratorRelease(throttle, kRate, {}).time_s, 4.0, 1e-12);
  throttle[200] = kMissing;
  EXPECT_EQ(AcceleratorRelease(throttle, kRate, {}).flag, ResponseFlag::kNoSignal);
}

}  // namespace
}  // namespace rodeira::measures
