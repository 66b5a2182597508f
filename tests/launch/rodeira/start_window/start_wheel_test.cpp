// SPDX-License-Identifier: Apache-2.0
// A steering wheel is set up in the start window: SDL's virtual joystick, a window without a display, a mouse of pushed
// events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "tests/launch/rodeira/start_window/start_hands.hpp"
#include "tests/names.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"

namespace rodeira::cli {
namespace {

class StartWheel : public StartHands {
 protected:
  void SetUp() override {
    StartHands::SetUp();
    if (IsSkipped()) return;
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
  }

  // Frames while `axis` goes evenly from one place to the other, or nothing moves.
  void Move(VirtualWheel& wheel, int axis, int from, int to) {
    for (int i = 1; i <= 30; ++i) {
      wheel.Axis(axis, from + (to - from) * i / 30);
      Frame();
    }
  }
  void Rest() {
    for (int i = 0; i < 60; ++i) Frame();
  }
  int QuestionNumber() const { return start_->wheel().wizard() == nullptr ? 0 : start_->wheel().wizard()->number(); }

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
};

TEST_F(StartWheel, SixMovementsAndTheWheelIsTheOneToDriveWith) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  wheel.Axis(3, 32767);
  Keep("start_window.png");
  ASSERT_TRUE(Click("set up a steering wheel"));
  ASSERT_TRUE(start_->wheel().open()) << start_->wheel().said();
  EXPECT_EQ(QuestionNumber(), 1);
  Frame();
  Move(wheel, 0, 0, -32000);
  const window::Image left = Frame();
  Move(wheel, 0, -32000, 32000);
  EXPECT_NE(Frame(), left) << "the bars follow the hand";
  Keep("wheel_setup.png");
  Move(wheel, 0, 32000, 0);
  Rest();
  EXPECT_EQ(QuestionNumber(), 2);
  Move(wheel, 0, 0, 20000);
  Move(wheel, 0, 20000, 0);
  Rest();
  EXPECT_EQ(QuestionNumber(), 2);
  EXPECT_THAT(start_->wheel().wizard()->remark(), Names("steering wheel … throttle"));
  Move(wheel, 2, 32767, -32768);
  Move(wheel, 2, -32768, 32767);
  Rest();
  EXPECT_EQ(QuestionNumber(), 3);
  Move(wheel, 3, 32767, -32768);
  Move(wheel, 3, -32768, 32767);
  Rest();
  EXPECT_EQ(QuestionNumber(), 4);
  for (const int button : {1, 4, 5, 6, 7}) {  // there is no clutch; then up and down, camera and pause
    wheel.Button(button, true);
    Frame();
    wheel.Button(button, false);
    Frame();
  }
  EXPECT_FALSE(start_->wheel().open());
  const auto file = input_devices::WheelFileOf(wheel.guid());
  EXPECT_EQ(start_->wheel().said(), "written: " + file.string());
  const auto written = input_devices::LoadWheel(file);
  ASSERT_TRUE(written.ok()) << written.error().Text();
  EXPECT_EQ(written.value().AxisOf(input_devices::WheelAxis::kSteering)->axis, 0u);
  EXPECT_EQ(written.value().AxisOf(input_devices::WheelAxis::kThrottle)->axis, 2u);
  EXPECT_EQ(written.value().AxisOf(input_devices::WheelAxis::kBrake)->axis, 3u);
  EXPECT_EQ(written.value().buttons[static_cast<std::size_t>(input_devices::WheelButton::kGearUp)]->button, 4u);
  EXPECT_EQ(written.value().buttons[static_cast<std::size_t>(input_devices::WheelButton::kCamera)]->button, 6u);
  EXPECT_NEAR(written.value().lock_rad, 450.0 * 3.14159265358979 / 180.0, 1e-6) << "half of 900 degrees";
  EXPECT_EQ(start_->choice().driver, StartDriver::kWheel);
  EXPECT_EQ(start_->choice().wheel, file);
}

TEST_F(StartWheel, CancelledOrWithoutOneItSaysSoAndWritesNothing) {
  if (joysticks_->Connected().empty()) {
    ASSERT_TRUE(Click("set up a steering wheel"));
    EXPECT_FALSE(start_->wheel().open());
    EXPECT_EQ(start_->wheel().said(), "no wheel is connected, or none that you may read (`rodeira doctor` says which)");
  }
  VirtualWheel wheel;
  ASSERT_TRUE(Click("set up a steering wheel"));
  ASSERT_TRUE(start_->wheel().open());
  EXPECT_EQ(start_->wheel().said(), "") << "what was said before is no more";
  ASSERT_TRUE(Click("cancel"));
  EXPECT_FALSE(start_->wheel().open());
  EXPECT_EQ(start_->wheel().said(), "setup cancelled; nothing was written");
  ASSERT_TRUE(Click("set up a steering wheel"));
  wheel.Detach();
  Frame();
  Frame();
  EXPECT_FALSE(start_->wheel().open());
  EXPECT_EQ(start_->wheel().said(), "the wheel was unplugged; nothing was written");
  EXPECT_FALSE(std::filesystem::exists(folder_->path() / "rodeira"));
}

// A file where the folder should be: the sentence stands in the window, and the window goes on.
TEST_F(StartWheel, WhatCannotBeWrittenIsSaid) {
  VirtualWheel wheel;
  ASSERT_TRUE(base::WriteWhole(folder_->path() / "rodeira", std::string_view("no folder")).ok());
  ASSERT_TRUE(Click("set up a steering wheel"));
  Move(wheel, 0, 0, -32000);
  Move(wheel, 0, -32000, 32000);
  Move(wheel, 0, 32000, 0);
  Rest();
  for (const int pedal : {2, 3}) {
    Move(wheel, pedal, -32768, 32767);
    Move(wheel, pedal, 32767, -32768);
    Rest();
  }
  for (const int button : {1, 4, 5, 6, 7}) {
    wheel.Button(button, true);
    Frame();
    wheel.Button(button, false);
    Frame();
  }
  EXPECT_FALSE(start_->wheel().open());
  EXPECT_NE(start_->wheel().said().find(wheel.guid() + ".yaml"), std::string::npos) << start_->wheel().said();
  EXPECT_EQ(start_->wheel().said().find("written: "), std::string::npos) << start_->wheel().said();
  EXPECT_EQ(start_->choice().driver, StartDriver::kKeyboard);
}

}  // namespace
}  // namespace rodeira::cli
