// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/wheel_setup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/core/base/temporary_folder.hpp"

namespace rodeira::input_devices {
namespace {

using Stage = WheelSetup::Stage;

constexpr double kDegree = std::numbers::pi / 180.0;

// A person at devices with some axes: moves one thing at a time, a hundredth of a second each step, with the noise of
// real pots.
class Person {
 public:
  explicit Person(std::vector<std::vector<double>> axes, std::size_t buttons = 8)
      : at_(std::move(axes)), buttons_(at_.size(), std::vector<std::uint8_t>(buttons, 0)) {
    std::vector<DeviceUse> devices;
    for (std::size_t d = 0; d < at_.size(); ++d)
      devices.push_back({"device" + std::to_string(d + 1), std::string(32, static_cast<char>('a' + d)), ""});
    setup_ = std::make_unique<WheelSetup>(devices, 450.0 * kDegree);
  }
  WheelSetup& setup() { return *setup_; }
  std::vector<DeviceReading> Readings() {
    std::vector<DeviceReading> all;
    for (std::size_t d = 0; d < at_.size(); ++d) {
      DeviceReading reading{true, at_[d], buttons_[d]};
      for (double& value : reading.axes) value = std::round(value + base::RandomUniform({1, steps_++}, -60.0, 60.0));
      all.push_back(reading);
    }
    return all;
  }
  void Wait(double seconds) {
    for (int i = 0; i < static_cast<int>(100 * seconds); ++i) setup_->Step(Readings(), 0.01), passed_s_ += 0.01;
  }
  void Move(std::size_t device, std::size_t axis, double to, double within_s = 0.6) {
    const double from = at_[device][axis];
    const int steps = static_cast<int>(100 * within_s);
    for (int i = 1; i <= steps; ++i) {
      at_[device][axis] = from + (to - from) * i / steps;
      setup_->Step(Readings(), 0.01);
      passed_s_ += 0.01;
    }
  }
  void Press(std::size_t device, std::size_t button) {
    buttons_[device][button] = 1;
    Wait(0.1);
    buttons_[device][button] = 0;
    Wait(0.3);
  }
  void Pedal(std::size_t device, std::size_t axis, double pressed) {
    const double released = at_[device][axis];
    Move(device, axis, pressed);
    Wait(0.3);
    Move(device, axis, released);
    Wait(0.7);
  }
  double passed_s() const { return passed_s_; }

 private:
  std::vector<std::vector<double>> at_;
  std::vector<std::vector<std::uint8_t>> buttons_;
  std::unique_ptr<WheelSetup> setup_;
  std::uint64_t steps_ = 0;
  double passed_s_ = 0.0;
};

void Steer(Person& person, std::size_t device, std::size_t axis, double left, double right) {
  person.Wait(0.3);
  person.Move(device, axis, left, 1.0);
  person.Move(device, axis, right, 2.0);
  person.Move(device, axis, 0.0, 1.0);
  person.Wait(0.7);
}

// What those settings make of raw numbers.
dynamics::Controls Driven(const WheelSettings& settings,
                          const std::vector<std::vector<std::vector<double>>>& positions) {
  WheelDriver driver(settings);
  dynamics::Controls controls;
  for (const auto& axes : positions) {
    std::vector<DeviceReading> readings;
    for (const auto& values : axes) readings.push_back({true, values, std::vector<std::uint8_t>(8, 0)});
    controls = driver.Step(readings, 1);
  }
  return controls;
}

TEST(WheelSetup, AnOrdinaryWheelInSixMovements) {
  Person person({{0.0, 500.0, 32767.0, 32767.0}});
  EXPECT_EQ(person.setup().stage(), Stage::kSteering);
  Steer(person, 0, 0, -32000.0, 32300.0);
  ASSERT_EQ(person.setup().stage(), Stage::kThrottle) << person.setup().remark();
  person.Pedal(0, 2, -32768.0);
  ASSERT_EQ(person.setup().stage(), Stage::kBrake) << person.setup().remark();
  person.Pedal(0, 3, -20000.0);
  ASSERT_EQ(person.setup().stage(), Stage::kClutch) << person.setup().remark();
  person.Press(0, 1);
  ASSERT_EQ(person.setup().stage(), Stage::kGears);
  person.Press(0, 4);
  person.Press(0, 4);
  EXPECT_EQ(person.setup().remark(), "That was the same button; another one was asked for.");
  person.Press(0, 5);
  ASSERT_EQ(person.setup().stage(), Stage::kWindow);
  person.Press(0, 4);
  EXPECT_EQ(person.setup().remark(), "That button changes gears; another one was asked for.");
  person.Press(0, 6);
  person.Press(0, 7);
  ASSERT_EQ(person.setup().stage(), Stage::kDone);
  EXPECT_LT(person.passed_s(), 60.0) << "at most a minute";
  const WheelSettings settings = person.setup().settings();
  EXPECT_EQ(settings.buttons[0]->button, 4u);
  EXPECT_EQ(settings.buttons[1]->button, 5u);
  EXPECT_EQ(settings.buttons[static_cast<std::size_t>(WheelButton::kCamera)]->button, 6u);
  EXPECT_EQ(settings.buttons[static_cast<std::size_t>(WheelButton::kPause)]->button, 7u);
  EXPECT_FALSE(settings.AxisOf(WheelAxis::kClutch));
  const std::vector<std::vector<double>> rest = {{0.0, 500.0, 32767.0, 32767.0}};
  const dynamics::Controls left = Driven(settings, {rest, {{-32000.0, 500.0, -32768.0, 32767.0}}});
  EXPECT_NEAR(left.steering_wheel_rad, 450.0 * kDegree, 0.05);
  EXPECT_EQ(left.throttle, 1.0);
  EXPECT_EQ(left.brake, 0.0);
  const dynamics::Controls right = Driven(settings, {rest, {{32300.0, 500.0, 32767.0, -20000.0}}});
  EXPECT_NEAR(right.steering_wheel_rad, -450.0 * kDegree, 0.05);
  EXPECT_EQ(right.throttle, 0.0);
  EXPECT_EQ(right.brake, 1.0);
}

// Separate pedals, everything the other way round, a clutch.
TEST(WheelSetup, SeveralDevicesAndInvertedAxes) {
  Person person({{0.0}, {-30000.0, 0.0}, {-32768.0, -32768.0, 32767.0}});
  Steer(person, 0, 0, 30000.0, -30000.0);
  ASSERT_EQ(person.setup().stage(), Stage::kThrottle) << person.setup().remark();
  person.Pedal(2, 0, 32767.0);
  person.Pedal(2, 1, 10000.0);
  ASSERT_EQ(person.setup().stage(), Stage::kClutch) << person.setup().remark();
  person.Pedal(2, 2, -32768.0);
  ASSERT_EQ(person.setup().stage(), Stage::kGears) << person.setup().remark();
  person.Pedal(2, 0, 32767.0);  // no buttons
  ASSERT_EQ(person.setup().stage(), Stage::kWindow) << person.setup().remark();
  person.Pedal(2, 0, 32767.0);
  ASSERT_EQ(person.setup().stage(), Stage::kDone);
  const WheelSettings settings = person.setup().settings();
  ASSERT_EQ(settings.devices.size(), 2u) << "the second one has nothing to do";
  EXPECT_EQ(settings.devices[1].guid, std::string(32, 'c'));
  EXPECT_FALSE(settings.buttons[0]);
  const dynamics::Controls c =
      Driven(settings, {{{0.0}, {-32768.0, -32768.0, 32767.0}}, {{30000.0}, {32767.0, -32768.0, -32768.0}}});
  EXPECT_GT(c.steering_wheel_rad, 400.0 * kDegree);
  EXPECT_EQ(c.throttle, 1.0);
  EXPECT_EQ(c.brake, 0.0);
  EXPECT_EQ(c.clutch, 1.0);
}

TEST(WheelSetup, TwoPedalsOnOneAxis) {
  for (const double throttle : {32767.0, -32768.0}) {
    Person person({{0.0, 0.0}});
    Steer(person, 0, 0, -32000.0, 32000.0);
    person.Pedal(0, 1, throttle);
    person.Pedal(0, 1, throttle);
    EXPECT_EQ(person.setup().remark(), "That was the throttle again; the brake was asked for.");
    person.Pedal(0, 1, -throttle);
    ASSERT_EQ(person.setup().stage(), Stage::kClutch) << person.setup().remark();
    person.Press(0, 0);
    person.Press(0, 1);
    person.Press(0, 2);
    person.Press(0, 3);
    person.Pedal(0, 1, throttle);  // a button for the camera, none that pauses
    ASSERT_EQ(person.setup().stage(), Stage::kDone);
    const WheelSettings settings = person.setup().settings();
    EXPECT_TRUE(settings.buttons[static_cast<std::size_t>(WheelButton::kCamera)]);
    EXPECT_FALSE(settings.buttons[static_cast<std::size_t>(WheelButton::kPause)]);
    const dynamics::Controls go = Driven(settings, {{{0.0, 0.0}}, {{0.0, throttle}}}),
                             stop = Driven(settings, {{{0.0, 0.0}}, {{0.0, -throttle}}});
    EXPECT_EQ(go.throttle, 1.0);
    EXPECT_EQ(go.brake, 0.0);
    EXPECT_EQ(stop.throttle, 0.0);
    EXPECT_EQ(stop.brake, 1.0);
  }
}

// Drivers say anything of an axis until it first moves: a pedal that is up may read as half down.
TEST(WheelSetup, WhatADeviceSaysBeforeItMovesIsNotBelieved) {
  Person person({{0.0, 0.0, 0.0}});
  Steer(person, 0, 0, -32000.0, 32000.0);
  person.Move(0, 1, 32767.0, 0.01);  // it leaps to where it is
  person.Pedal(0, 1, -32768.0);
  ASSERT_EQ(person.setup().stage(), Stage::kBrake) << person.setup().remark();
  person.Move(0, 2, 32767.0, 0.01);
  person.Pedal(0, 2, -32768.0);
  ASSERT_EQ(person.setup().stage(), Stage::kClutch) << person.setup().remark();
  person.Press(0, 0);
  for (const std::size_t button : {1, 2, 3, 4}) person.Press(0, button);
  const dynamics::Controls c =
      Driven(person.setup().settings(), {{{0.0, 32767.0, 32767.0}}, {{0.0, -32768.0, 30000.0}}});
  EXPECT_EQ(c.throttle, 1.0);
  EXPECT_LT(c.brake, 0.05);
}

// However long a foot stays on the floor, and whether it pumps there or not: released is where the pedal comes back to.
TEST(WheelSetup, APedalThatIsHeldIsWaitedFor) {
  for (const double up : {32767.0, -32768.0}) {
    Person person({{0.0, up, up, up}});
    Steer(person, 0, 0, -32000.0, 32000.0);
    for (const auto& [axis, stage, pedal] : {std::tuple(std::size_t{1}, Stage::kThrottle, "throttle"),
                                             {std::size_t{2}, Stage::kBrake, "brake"},
                                             {std::size_t{3}, Stage::kClutch, "clutch"}}) {
      ASSERT_EQ(person.setup().stage(), stage) << person.setup().remark();
      person.Move(0, axis, -up);
      person.Wait(3.0);
      person.Move(0, axis, 0.3 * up);
      person.Move(0, axis, -up);
      person.Wait(3.0);
      ASSERT_EQ(person.setup().stage(), stage) << "held at the floor";
      EXPECT_EQ(person.setup().remark(),
                std::string("The ") + pedal + " has not come back yet: release it, or press it once more.");
      person.Move(0, axis, up);
      person.Wait(0.7);
    }
    ASSERT_EQ(person.setup().stage(), Stage::kGears) << person.setup().remark();
    for (const std::size_t button : {1, 2, 3, 4}) person.Press(0, button);
    const WheelSettings settings = person.setup().settings();
    const std::vector<std::vector<double>> rest = {{0.0, up, up, up}};
    const dynamics::Controls free = Driven(settings, {rest}), floor = Driven(settings, {rest, {{0.0, -up, -up, -up}}});
    EXPECT_EQ(free.throttle, 0.0);
    EXPECT_EQ(free.brake, 0.0);
    EXPECT_EQ(free.clutch, 0.0);
    EXPECT_EQ(floor.throttle, 1.0);
    EXPECT_EQ(floor.brake, 1.0);
    EXPECT_EQ(floor.clutch, 1.0);
  }
}

TEST(WheelSetup, WhatWasNotAskedForIsSaid) {
  Person person({{0.0, 32767.0, 32767.0}});
  person.Wait(5.0);
  EXPECT_EQ(person.setup().stage(), Stage::kSteering) << "nothing happens, nothing is taken";
  person.Move(0, 0, -32000.0);
  person.Wait(0.7);
  EXPECT_EQ(person.setup().remark(), "The wheel was not turned to both sides and back; once more.");
  person.Move(0, 0, 0.0);
  person.Wait(0.7);
  Steer(person, 0, 0, -32000.0, 32000.0);
  ASSERT_EQ(person.setup().stage(), Stage::kThrottle);
  Steer(person, 0, 0, -32000.0, 32000.0);
  EXPECT_EQ(person.setup().remark(), "That was the steering wheel; the throttle alone was asked for.");
  EXPECT_EQ(person.setup().stage(), Stage::kThrottle);
}

TEST(WheelText, IsReadAsTheSame) {
  Person person({{0.0}, {-32768.0, -32768.0, 32767.0}});
  Steer(person, 0, 0, 30000.0, -30000.0);
  person.Pedal(1, 0, 32767.0);
  person.Pedal(1, 1, 10000.0);
  person.Pedal(1, 2, -32768.0);
  person.Press(0, 4);
  person.Press(1, 5);
  person.Press(1, 6);
  person.Press(0, 5);
  ASSERT_EQ(person.setup().stage(), Stage::kDone);
  WheelSettings settings = person.setup().settings();
  settings.lever[-1] = {0, 7, ""};
  settings.lever[1] = {1, 3, ""};
  auto folder = base::TemporaryFolder::Make("wheel");
  ASSERT_TRUE(folder.ok());
  const auto file = folder.value().path() / "wheel.yaml";
  ASSERT_TRUE(base::WriteWhole(file, WheelText(settings, "O'Neill: \"pro\" \\ #1")).ok());
  const auto read = LoadWheel(file);
  ASSERT_TRUE(read.ok()) << read.error().Text();
  EXPECT_EQ(WheelText(read.value(), "a wheel"), WheelText(settings, "a wheel"));
  EXPECT_EQ(read.value().AxisOf(WheelAxis::kClutch)->inverted, true);
  EXPECT_NEAR(read.value().lock_rad, settings.lock_rad, 1e-12);
  EXPECT_EQ(read.value().lever.at(1).device, 1u);
  EXPECT_EQ(read.value().buttons[static_cast<std::size_t>(WheelButton::kPause)]->button, 5u);
}

}  // namespace
}  // namespace rodeira::input_devices
