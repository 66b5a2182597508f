// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/wheel_driver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::input_devices {
namespace {

// Wheel with a combined lever, and pedals of their own.
WheelSettings Settings() {
  WheelSettings s;
  s.devices = {{"wheel", std::string(32, 'a'), ""}, {"pedals", std::string(32, 'b'), ""}};
  s.lock_rad = 7.5;
  AxisUse steering;
  s.axes[static_cast<std::size_t>(WheelAxis::kSteering)] = steering;
  AxisUse throttle;
  throttle.device = 1;
  throttle.min = -20000.0;
  throttle.max = 30000.0;
  throttle.inverted = true;  // released at 30000
  throttle.dead_zone = 0.1;
  s.axes[static_cast<std::size_t>(WheelAxis::kThrottle)] = throttle;
  AxisUse brake;
  brake.device = 1;
  brake.axis = 1;
  brake.exponent = 2.0;
  s.axes[static_cast<std::size_t>(WheelAxis::kBrake)] = brake;
  s.buttons[static_cast<std::size_t>(WheelButton::kGearUp)] = ButtonUse{0, 0, ""};
  s.buttons[static_cast<std::size_t>(WheelButton::kGearDown)] = ButtonUse{0, 1, ""};
  s.buttons[static_cast<std::size_t>(WheelButton::kStarter)] = ButtonUse{1, 0, ""};
  s.buttons[static_cast<std::size_t>(WheelButton::kHandbrake)] = ButtonUse{0, 2, ""};
  return s;
}

std::vector<DeviceReading> Rest() { return {{true, {0.0}, {0, 0, 0}}, {true, {30000.0, -32768.0}, {0}}}; }

TEST(Axis, LinearFromTheCentreToEitherEndBehindTheDeadZone) {
  AxisUse use;
  use.min = -1000.0;
  use.centre = 200.0;
  use.max = 1000.0;
  EXPECT_EQ(TwoSided(use, 200.0), 0.0);
  EXPECT_DOUBLE_EQ(TwoSided(use, 600.0), 0.5);
  EXPECT_DOUBLE_EQ(TwoSided(use, -400.0), -0.5) << "each side has its own length";
  EXPECT_EQ(TwoSided(use, 5000.0), 1.0);
  EXPECT_EQ(TwoSided(use, -5000.0), -1.0);
  use.dead_zone = 0.2;
  EXPECT_EQ(TwoSided(use, 359.0), 0.0);
  EXPECT_DOUBLE_EQ(TwoSided(use, 680.0), 0.5) << "(0.6 - 0.2) / 0.8: no jump behind the dead zone";
  use.exponent = 3.0;
  EXPECT_DOUBLE_EQ(TwoSided(use, 680.0), 0.125);
  use.inverted = true;
  EXPECT_DOUBLE_EQ(TwoSided(use, 680.0), -0.125);
}

TEST(Axis, APedalGoesFromItsRestToItsEnd) {
  AxisUse use;
  use.min = -20000.0;
  use.max = 30000.0;
  use.inverted = true;
  use.dead_zone = 0.1;
  EXPECT_EQ(OneSided(use, 30000.0), 0.0);
  EXPECT_EQ(OneSided(use, 25001.0), 0.0);
  EXPECT_DOUBLE_EQ(OneSided(use, 2500.0), 0.5) << "(0.55 - 0.1) / 0.9";
  EXPECT_EQ(OneSided(use, -20000.0), 1.0);
  EXPECT_EQ(OneSided(use, -32768.0), 1.0);
}

TEST(WheelDriver, AnAxisCountsFromItsFirstMoveOn) {
  WheelDriver driver(Settings());
  // A driver that says "half down" and "at the stop" before anything was touched.
  std::vector<DeviceReading> readings{{true, {-32768.0}, {0, 0, 0}}, {true, {5000.0, 0.0}, {0}}};
  for (int i = 0; i < 3; ++i) {
    const auto controls = driver.Step(readings, 1);
    EXPECT_EQ(controls.steering_wheel_rad, 0.0);
    EXPECT_EQ(controls.throttle, 0.0);
    EXPECT_EQ(controls.brake, 0.0);
  }
  readings[1].axes[0] = 5300.0;  // noise of less than a hundredth
  EXPECT_EQ(driver.Step(readings, 1).throttle, 0.0);
  readings[1].axes[0] = 2500.0;
  EXPECT_DOUBLE_EQ(driver.Step(readings, 1).throttle, 0.5);
  readings[1].axes[0] = 5000.0;
  EXPECT_GT(driver.Step(readings, 1).throttle, 0.0) << "once moved it counts, also where it began";
  EXPECT_EQ(driver.controls().steering_wheel_rad, 0.0) << "each axis by itself";
}

TEST(WheelDriver, RightOnTheWheelIsNegativeSteering) {
  WheelDriver driver(Settings());
  auto readings = Rest();
  driver.Step(readings, 1);
  readings[0].axes[0] = 32767.0;
  EXPECT_DOUBLE_EQ(driver.Step(readings, 1).steering_wheel_rad, -7.5);
  readings[0].axes[0] = -16384.0;
  EXPECT_DOUBLE_EQ(driver.Step(readings, 1).steering_wheel_rad, 3.75);
  readings[1].axes[1] = 0.0;
  EXPECT_NEAR(driver.Step(readings, 1).brake, 0.25, 1e-4) << "(1/2)²";
}

TEST(WheelDriver, CombinedPedalsAreThrottleOnOneSideAndBrakeOnTheOther) {
  WheelSettings s = Settings();
  s.axes[static_cast<std::size_t>(WheelAxis::kThrottle)].reset();
  s.axes[static_cast<std::size_t>(WheelAxis::kBrake)].reset();
  AxisUse pedals;
  pedals.device = 1;
  s.axes[static_cast<std::size_t>(WheelAxis::kPedals)] = pedals;
  WheelDriver driver(s);
  auto readings = Rest();
  readings[1].axes[0] = 0.0;
  driver.Step(readings, 1);
  readings[1].axes[0] = 32767.0;
  EXPECT_EQ(driver.Step(readings, 1).throttle, 1.0);
  EXPECT_EQ(driver.controls().brake, 0.0);
  readings[1].axes[0] = -16384.0;
  EXPECT_EQ(driver.Step(readings, 1).throttle, 0.0);
  EXPECT_DOUBLE_EQ(driver.controls().brake, 0.5);
}

TEST(WheelDriver, AButtonHeldIsOnePress) {
  WheelDriver driver(Settings());
  auto readings = Rest();
  readings[0].buttons[1] = 1;
  for (int i = 0; i < 10; ++i) driver.Step(readings, 1);
  EXPECT_EQ(driver.controls().gear, 0) << "from D to N, once";
  readings[0].buttons[1] = 0;
  driver.Step(readings, 0);
  readings[0].buttons[1] = 1;
  EXPECT_EQ(driver.Step(readings, 0).gear, -1);
  readings[0].buttons[2] = 1;
  readings[1].buttons[0] = 1;
  EXPECT_EQ(driver.Step(readings, 0).handbrake, 1.0);
  EXPECT_TRUE(driver.controls().starter);
}

// Buttons for lamps, horn and R N D: presses count once each, the horn sounds while its button is down, and where the
// wheel is unplugged it is free.
TEST(WheelDriver, ButtonsForLampsHornAndGearsDoWhatTheySay) {
  WheelSettings settings = Settings();
  const std::array uses{WheelButton::kIndicateLeft, WheelButton::kHeadlights, WheelButton::kHorn,
                        WheelButton::kReverse,      WheelButton::kNeutral,    WheelButton::kDrive};
  for (std::size_t i = 0; i < uses.size(); ++i)
    settings.buttons[static_cast<std::size_t>(uses[i])] = ButtonUse{0, 10 + i, ""};
  WheelDriver driver(settings);
  auto readings = Rest();
  readings[0].buttons.assign(16, 0);
  const auto press = [&](std::size_t button) {
    readings[0].buttons[10 + button] = 1;
    for (int i = 0; i < 5; ++i) (void)driver.Step(readings, 1);
    const Signals held = driver.signals();
    readings[0].buttons[10 + button] = 0;
    (void)driver.Step(readings, 1);
    return held;
  };
  EXPECT_EQ(press(0).indicators, Indicators::kLeft);
  EXPECT_EQ(press(0).indicators, Indicators::kOff);
  EXPECT_EQ(press(1).headlights, Headlights::kDipped);
  EXPECT_EQ(press(1).headlights, Headlights::kFull);
  EXPECT_TRUE(press(2).horn);
  EXPECT_FALSE(driver.signals().horn);
  (void)press(3);
  EXPECT_EQ(driver.controls().gear, -1);
  (void)press(5);
  EXPECT_EQ(driver.controls().gear, 1);
  (void)press(4);
  EXPECT_EQ(driver.controls().gear, 0);
  readings[0].buttons[12] = 1;
  (void)driver.Step(readings, 1);
  EXPECT_TRUE(driver.signals().horn);
  readings[0].connected = false;
  (void)driver.Step(readings, 1);
  EXPECT_EQ(driver.signals(), (Signals{Indicators::kOff, Headlights::kFull, false}));
}

TEST(WheelDriver, ALeverWithPlacesIsWhereItStands) {
  WheelSettings s = Settings();
  s.gearbox = dynamics::GearboxMode::kManual;
  s.lever = {{-1, {0, 2, ""}}, {1, {0, 0, ""}}, {2, {0, 1, ""}}};
  s.buttons[static_cast<std::size_t>(WheelButton::kGearUp)].reset();
  s.buttons[static_cast<std::size_t>(WheelButton::kGearDown)].reset();
  s.buttons[static_cast<std::size_t>(WheelButton::kHandbrake)].reset();
  WheelDriver driver(s);
  auto readings = Rest();
  EXPECT_EQ(driver.Step(readings, 0).gear, 0) << "no place: neutral";
  readings[0].buttons = {0, 1, 0};
  EXPECT_EQ(driver.Step(readings, 0).gear, 2);
  readings[0].buttons = {0, 0, 1};
  EXPECT_EQ(driver.Step(readings, 2).gear, -1);
}

TEST(WheelDriver, UnpluggedThePedalsAreReleasedAndTheSteeringStays) {
  WheelDriver driver(Settings());
  auto readings = Rest();
  driver.Step(readings, 1);
  readings[0].axes[0] = -8192.0;
  readings[1].axes[0] = -20000.0;
  ASSERT_EQ(driver.Step(readings, 1).throttle, 1.0);
  const double steering = driver.controls().steering_wheel_rad;
  ASSERT_GT(steering, 1.0);
  readings[1].connected = false;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(driver.Step(readings, 1).throttle, 0.0);
    EXPECT_EQ(driver.controls().steering_wheel_rad, steering);
  }
  readings[1].connected = true;  // it comes back and says at once what it said before
  EXPECT_EQ(driver.Step(readings, 1).throttle, 0.0) << "nobody has touched it since";
  EXPECT_EQ(driver.controls().steering_wheel_rad, steering);
  readings[1].axes[0] = 2500.0;
  EXPECT_DOUBLE_EQ(driver.Step(readings, 1).throttle, 0.5);
}

TEST(WheelDriver, RestoredAnywhereItGoesOnWithTheSameBits) {
  const auto drawn = [](std::uint64_t step) {
    auto readings = Rest();
    readings[0].axes[0] = std::floor(base::RandomUniform({1, step / 9}, -32768.0, 32767.0));
    readings[1].axes[0] = std::floor(base::RandomUniform({2, step / 5}, -32768.0, 32767.0));
    for (std::size_t b = 0; b < 3; ++b) readings[0].buttons[b] = base::RandomUniform({3, step / 3, b}) < 0.3;
    readings[1].connected = base::RandomUniform({4, step / 20}) > 0.2;
    return readings;
  };
  const auto digest = [](const WheelDriver& driver) {
    base::StateWriter out;
    driver.Save(out);
    return out.digest();
  };
  WheelDriver whole(Settings());
  for (std::uint64_t step = 0; step < 300; ++step) {
    base::StateWriter out;
    whole.Save(out);
    WheelDriver restored(Settings());
    base::StateReader in(out.bytes());
    restored.Restore(in);
    ASSERT_TRUE(in.Finish().ok());
    whole.Step(drawn(step), 2);
    restored.Step(drawn(step), 2);
    ASSERT_EQ(digest(whole), digest(restored)) << step;
  }
}

}  // namespace
}  // namespace rodeira::input_devices
