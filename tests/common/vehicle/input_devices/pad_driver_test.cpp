// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/pad_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/vehicle/input_devices/plain_wheel.hpp"

namespace rodeira::input_devices {
namespace {

constexpr double kDt_s = 0.01;

PadReading Stick(double stick) {
  PadReading pad;
  pad.connected = true;
  pad.stick = stick;
  return pad;
}

PadReading Held(PadButton button) {
  PadReading pad = Stick(0.0);
  pad.down[static_cast<std::size_t>(button)] = true;
  return pad;
}

TEST(PadDriver, TheWheelGoesToTheStickNoFasterThanItMayAndComesBackByItself) {
  const PadSettings settings;
  PadDriver driver(settings);
  double before = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double wheel = driver.Step(Stick(-1.0), 1, 0.0, kDt_s).steering_wheel_rad;
    ASSERT_LE(wheel - before, settings.lock_rad / settings.turn_s * kDt_s + 1e-12) << i;
    before = wheel;
  }
  EXPECT_NEAR(before, settings.lock_rad, 1e-12) << "left on the stick is positive steering, to the lock at rest";
  for (int i = 0; i < 100; ++i) {
    const double wheel = driver.Step(Stick(0.0), 1, 0.0, kDt_s).steering_wheel_rad;
    ASSERT_LE(before - wheel, settings.lock_rad / settings.centre_s * kDt_s + 1e-12) << i;
    before = wheel;
  }
  EXPECT_EQ(before, 0.0) << "let go, exactly";
  EXPECT_FALSE(std::signbit(before));
}

TEST(PadDriver, TheStickSaysWhereBetweenTheLocksOfThisSpeed) {
  const PadSettings settings;
  for (const double speed_mps : {0.0, 6.5, 30.0}) {
    for (const double stick : {-0.7, 0.4, 1.0}) {
      PadDriver driver(settings);
      double wheel = 0.0;
      for (int i = 0; i < 200; ++i) wheel = driver.Step(Stick(stick), 1, speed_mps, kDt_s).steering_wheel_rad;
      const double lock = settings.lock_rad / (1.0 + speed_mps * speed_mps / (6.5 * 6.5));
      EXPECT_NEAR(wheel, -std::copysign(lock * std::pow((std::fabs(stick) - 0.12) / 0.88, 1.6), stick), 1e-9)
          << speed_mps << " " << stick;
    }
  }
  PadDriver driver(settings);
  EXPECT_EQ(driver.Step(Stick(0.11), 1, 0.0, kDt_s).steering_wheel_rad, 0.0) << "no thumb rests exactly";
}

TEST(PadDriver, TriggersArePedalsAndButtonsDoWhatTheySay) {
  PadDriver driver;
  PadReading pad = Stick(0.0);
  EXPECT_EQ(driver.controls().gear, 1);
  pad.throttle = 0.03;
  EXPECT_EQ(driver.Step(pad, 1, 0.0, kDt_s).throttle, 0.0);
  pad.throttle = 0.52;
  pad.brake = 1.0;
  EXPECT_NEAR(driver.Step(pad, 1, 0.0, kDt_s).throttle, 0.5, 1e-12);
  EXPECT_EQ(driver.controls().brake, 1.0);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearDown), 1, 0.0, kDt_s).gear, 0);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearDown), 1, 0.0, kDt_s).gear, 0) << "held, it is one press";
  (void)driver.Step(Stick(0.0), 1, 0.0, kDt_s);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearDown), 1, 0.0, kDt_s).gear, -1);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearUp), 1, 0.0, kDt_s).gear, 0);
  EXPECT_EQ(driver.Step(Held(PadButton::kHandbrake), 1, 0.0, kDt_s).handbrake, 1.0);
  EXPECT_TRUE(driver.Step(Held(PadButton::kStarter), 1, 0.0, kDt_s).starter);
  (void)driver.Step(Held(PadButton::kHorn), 1, 0.0, kDt_s);
  EXPECT_TRUE(driver.signals().horn);
  (void)driver.Step(Held(PadButton::kIndicateLeft), 1, 0.0, kDt_s);
  EXPECT_FALSE(driver.signals().horn);
  EXPECT_EQ(driver.signals().indicators, Indicators::kLeft);
  (void)driver.Step(Held(PadButton::kIndicateRight), 1, 0.0, kDt_s);
  EXPECT_EQ(driver.signals().indicators, Indicators::kRight);
  (void)driver.Step(Held(PadButton::kHazard), 1, 0.0, kDt_s);
  EXPECT_EQ(driver.signals().indicators, Indicators::kHazard);
  (void)driver.Step(Held(PadButton::kHeadlights), 1, 0.0, kDt_s);
  EXPECT_EQ(driver.signals().headlights, Headlights::kDipped);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearUp), 1, 0.0, kDt_s).gear, 1);
  EXPECT_EQ(driver.Step(Held(PadButton::kGearboxMode), 2, 0.0, kDt_s).gearbox, dynamics::GearboxMode::kManual);
  EXPECT_EQ(driver.controls().gear, 2) << "the gear that is in";
}

TEST(PadDriver, AwayThePedalsAreReleasedAndTheSteeringStays) {
  PadDriver driver;
  PadReading pad = Stick(0.5);
  pad.throttle = 1.0;
  for (int i = 0; i < 50; ++i) (void)driver.Step(pad, 1, 0.0, kDt_s);
  (void)driver.Step(Held(PadButton::kHorn), 1, 0.0, kDt_s);
  const double wheel = driver.controls().steering_wheel_rad;
  EXPECT_LT(wheel, 0.0);
  for (int i = 0; i < 50; ++i) {
    const dynamics::Controls controls = driver.Step(PadReading(), 1, 0.0, kDt_s);
    ASSERT_EQ(controls.steering_wheel_rad, wheel);
    ASSERT_EQ(controls.throttle, 0.0);
    ASSERT_EQ(controls.gear, 1);
    ASSERT_FALSE(driver.signals().horn);
  }
  EXPECT_GT(driver.Step(pad, 1, 0.0, kDt_s).throttle, 0.99);
}

TEST(PadDriver, RestoredAnywhereItGoesOnWithTheSameBits) {
  const auto hands = [](int i) {
    PadReading pad = Stick(std::sin(0.1 * i));
    pad.throttle = 0.5 + 0.5 * std::cos(0.07 * i);
    pad.down[static_cast<std::size_t>(i / 7) % kPadButtons] = true;
    pad.connected = i % 40 != 0;
    return pad;
  };
  const auto digest = [](const PadDriver& driver) {
    base::StateWriter out;
    driver.Save(out);
    return out.digest();
  };
  PadDriver whole;
  for (int i = 0; i < 300; ++i) {
    base::StateWriter out;
    whole.Save(out);
    PadDriver restored;
    base::StateReader in(out.bytes());
    restored.Restore(in);
    ASSERT_TRUE(in.Finish().ok());
    (void)whole.Step(hands(i), 2, 8.0, kDt_s);
    (void)restored.Step(hands(i), 2, 8.0, kDt_s);
    ASSERT_EQ(digest(whole), digest(restored)) << i;
  }
}

TEST(PlainWheel, IsAGuessByTheNumberOfAxes) {
  const DeviceUse device{"wheel", std::string(32, 'a'), ""};
  EXPECT_FALSE(PlainWheel(device, 1, 9));
  const auto two = PlainWheel(device, 2, 3), three = PlainWheel(device, 3, 1), five = PlainWheel(device, 5, 12);
  EXPECT_EQ(AxesText(*two), "steering on axis 0, pedals on 1");
  EXPECT_EQ(AxesText(*three), "steering on axis 0, throttle on 1, brake on 2");
  EXPECT_EQ(AxesText(*five), "steering on axis 0, throttle on 2, brake on 3");
  EXPECT_EQ(two->buttons[static_cast<std::size_t>(WheelButton::kGearUp)]->button, 0u);
  EXPECT_FALSE(three->buttons[static_cast<std::size_t>(WheelButton::kGearUp)]);
  EXPECT_EQ(five->buttons[static_cast<std::size_t>(WheelButton::kGearDown)]->button, 5u);
  WheelDriver driver(*two);
  DeviceReading reading{true, {0.0, 0.0}, {0, 0, 0}};
  (void)driver.Step(std::span(&reading, 1), 1);
  reading.axes = {-32768.0, -32768.0};
  EXPECT_NEAR(driver.Step(std::span(&reading, 1), 1).throttle, 1.0, 1e-9) << "forward is the throttle";
  EXPECT_GT(driver.controls().steering_wheel_rad, 7.0);
}

}  // namespace
}  // namespace rodeira::input_devices
