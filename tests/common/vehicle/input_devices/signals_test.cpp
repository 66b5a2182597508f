// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/signals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::input_devices {
namespace {

SignalRequests Left(std::uint32_t presses = 1) {
  SignalRequests requests;
  requests.left = presses;
  return requests;
}
SignalRequests Right() {
  SignalRequests requests;
  requests.right = 1;
  return requests;
}

TEST(Signals, APressBeginsAndAnotherOneEnds) {
  SignalSwitch lever;
  EXPECT_EQ(lever.Step(Left(), 0.0).indicators, Indicators::kLeft);
  EXPECT_EQ(lever.Step({}, 0.0).indicators, Indicators::kLeft) << "it stays";
  EXPECT_EQ(lever.Step(Right(), 0.0).indicators, Indicators::kRight);
  EXPECT_EQ(lever.Step(Right(), 0.0).indicators, Indicators::kOff);
  EXPECT_EQ(lever.Step(Left(2), 0.0).indicators, Indicators::kOff) << "there and back within one step";
  EXPECT_EQ(lever.Step(Left(3), 0.0).indicators, Indicators::kLeft);
}

// The wheel goes a way and comes back; the indicator goes out where it is straight again, and only behind a bend to its
// own side.
TEST(Signals, ItGoesOutBehindItsOwnBend) {
  const auto out_at = [](const SignalRequests& side, double most_rad) -> double {
    SignalSwitch lever;
    (void)lever.Step(side, 0.0);
    constexpr int kSteps = 1000;
    for (int i = 0; i <= kSteps; ++i) {
      const double wheel_rad = most_rad * std::sin(3.14159265358979 * i / kSteps);
      if (lever.Step({}, wheel_rad).indicators == Indicators::kOff) return i > kSteps / 2 ? wheel_rad : 99.0;
    }
    return NAN;
  };
  EXPECT_NEAR(out_at(Left(), 2.0), SignalSwitch::kBack_rad, 0.01);
  EXPECT_NEAR(out_at(Right(), -2.0), -SignalSwitch::kBack_rad, 0.01);
  EXPECT_TRUE(std::isnan(out_at(Left(), -2.0))) << "a bend to the other side";
  EXPECT_TRUE(std::isnan(out_at(Right(), 2.0)));
  EXPECT_TRUE(std::isnan(out_at(Left(), 0.6))) << "a change of lanes";
}

TEST(Signals, HazardLightsStandAboveTheLever) {
  SignalSwitch lever;
  (void)lever.Step(Left(), 0.0);
  SignalRequests hazard;
  hazard.hazard = 1;
  EXPECT_EQ(lever.Step(hazard, 0.0).indicators, Indicators::kHazard);
  EXPECT_EQ(lever.Step({}, 0.0).indicators, Indicators::kHazard);
  EXPECT_EQ(lever.Step(hazard, 0.0).indicators, Indicators::kLeft);
}

TEST(Signals, HeadlightsGoRoundAndTheHornSoundsWhileItIsHeld) {
  SignalSwitch lever;
  SignalRequests requests;
  requests.headlights = 1;
  requests.horn = true;
  EXPECT_EQ(lever.Step(requests, 0.0), (Signals{Indicators::kOff, Headlights::kDipped, true}));
  EXPECT_EQ(lever.Step(requests, 0.0), (Signals{Indicators::kOff, Headlights::kFull, true}));
  EXPECT_EQ(lever.Step(requests, 0.0), (Signals{Indicators::kOff, Headlights::kOff, true}));
  requests.headlights = 3'000'000'001;
  EXPECT_EQ(lever.Step(requests, 0.0).headlights, static_cast<Headlights>(3'000'000'001 % 3));
  EXPECT_FALSE(lever.Step({}, 0.0).horn);
}

// Saved in the middle of a bend it goes on as if nothing had been.
TEST(Signals, TheStateIsAllThereIs) {
  SignalSwitch lever, other;
  (void)lever.Step(Left(), 0.0);
  (void)lever.Step({}, 1.0);
  base::StateWriter out;
  lever.Save(out);
  base::StateReader in(out.bytes());
  other.Restore(in);
  ASSERT_TRUE(in.Finish().ok());
  EXPECT_EQ(other.Step({}, 0.1).indicators, Indicators::kOff);
  SignalSwitch taken;
  taken.InitialiseFrom({Indicators::kRight, Headlights::kFull, true});
  EXPECT_EQ(taken.signals(), (Signals{Indicators::kRight, Headlights::kFull, false})) << "nobody's hand is on the horn";
}

}  // namespace
}  // namespace rodeira::input_devices
