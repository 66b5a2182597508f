// SPDX-License-Identifier: Apache-2.0
// What drives where no wheel is named: a wheel that was set up, a game pad, a device with a broken file, the window's
// keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/input_devices/key_names.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"
#include "launch/rodeira/run/pause_buttons.hpp"
#include "nodes/view/window/wheel_buttons.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/nodes/input/virtual_pad.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kKeys = "../configs/drivers/keyboard.yaml";

class FoundSource : public testing::Test {
 protected:
  void SetUp() override {
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
    if (!joysticks_->Connected().empty()) GTEST_SKIP() << "a device is plugged in, which would drive";
    auto made = base::TemporaryFolder::Make("found");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    ::setenv("XDG_CONFIG_HOME", folder_->path().c_str(), 1);
  }
  void TearDown() override { ::unsetenv("XDG_CONFIG_HOME"); }

  static launch::Launch LaunchOf(const std::string& config) {
    return launch::Launch::Parse(LiveLaunch(config), std::filesystem::path(SourceDir()) / "launch/live.yaml").value();
  }
  static void WriteOwn(const std::string& guid, const std::string& text) {
    std::filesystem::create_directories(input_devices::WheelFolder());
    ASSERT_TRUE(base::WriteWhole(input_devices::WheelFileOf(guid), text).ok());
  }
  // What was said while the nodes were made and driven.
  struct Told {
    LiveDrive drive;
    std::string said, refused;
  };
  static Told Drive(const std::string& config, lockstep::Step last, const std::function<void(lockstep::Step)>& hands) {
    Told told;
    const launch::Launch launch = LaunchOf(config);
    testing::internal::CaptureStderr();
    auto nodes = cli::LocalNodes::Make(launch);
    if (nodes.ok())
      told.drive = DriveLive(launch, nodes.value(), last, hands);
    else
      told.refused = nodes.error().Text();
    told.said = testing::internal::GetCapturedStderr();
    return told;
  }

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
  std::optional<base::TemporaryFolder> folder_;
};

TEST_F(FoundSource, ABrokenFileIsOneSentenceAndTheDeviceDrivesByAGuess) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  WriteOwn(wheel.guid(), "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() + "\"}\nsteering: {axis: nought}\n");
  const Told told = Drive("{source: joystick}", 300, [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, -32768);
    if (step == 200) wheel.Axis(0, -32768);
  });
  ASSERT_EQ(told.refused, "");
  EXPECT_THAT(told.said, HasSubstr(wheel.guid() + ".yaml:3: ")) << "file and line";
  EXPECT_THAT(told.said, HasSubstr("nought")) << "what was found";
  EXPECT_THAT(told.said, HasSubstr("expected"));
  EXPECT_THAT(told.said, HasSubstr("(`rodeira input setup` writes a new one)"));
  EXPECT_THAT(told.said, HasSubstr("drives by a guess: steering on axis 0, throttle on 2, brake on 3\n"));
  EXPECT_EQ(told.drive.controls.at(100).throttle(), 0.0);
  EXPECT_GT(told.drive.controls.at(110).throttle(), 0.99);
  EXPECT_NEAR(told.drive.controls.at(210).steering_wheel_rad(), 7.85, 1e-6);
  // Named, it is the person's word, and wrong input.
  const Told named = Drive("{source: joystick, wheel: \"" + input_devices::WheelFileOf(wheel.guid()).string() +
                               "\", keyboard: " + kKeys + "}",
                           10, nullptr);
  EXPECT_THAT(named.refused, HasSubstr(wheel.guid() + ".yaml:3: "));
  EXPECT_EQ(named.said, "");
}

TEST_F(FoundSource, AWholeFileThatAsksForWhatTheDeviceHasNotIsPassedOverToo) {
  VirtualWheel wheel;
  WriteOwn(wheel.guid(), "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() + "\"}\nsteering: {axis: 11}\n");
  const Told told = Drive("{source: joystick}", 20, nullptr);
  EXPECT_EQ(told.refused, "");
  EXPECT_THAT(told.said, HasSubstr("axis 11 of device 'rim' was asked for"));
  EXPECT_THAT(told.said, HasSubstr("drives by a guess"));
}

TEST_F(FoundSource, AWheelWithoutASetUpDrivesAtOnce) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  const auto hands = [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, -32768);
    if (step == 200) wheel.Axis(0, -32768);
  };
  const Told told = Drive(std::string("{source: joystick, keyboard: ") + kKeys + "}", 300, hands);
  ASSERT_EQ(told.refused, "");
  EXPECT_THAT(told.said, HasSubstr("drives by a guess: steering on axis 0, throttle on 2, brake on 3; it was not set "
                                   "up: `rodeira input setup` finds its axes, ends and buttons\n"));
  EXPECT_EQ(told.drive.controls.at(100).throttle(), 0.0);
  EXPECT_GT(told.drive.controls.at(110).throttle(), 0.99);
  EXPECT_NEAR(told.drive.controls.at(210).steering_wheel_rad(), 7.85, 1e-6);
  // A person at a wheel meant the wheel, not the pad beside it.
  VirtualPad pad;
  wheel.Axis(2, 32767), wheel.Axis(0, 0);
  EXPECT_THAT(Drive("{source: joystick}", 10, nullptr).said, HasSubstr("drives by a guess"));
}

TEST_F(FoundSource, WithoutAnyDeviceTheWindowsKeysDriveWhereTheyAreNamed) {
  const auto window_keys = [](const std::string& config) {
    const launch::Launch launch = LaunchOf(config);
    testing::internal::CaptureStderr();
    auto nodes = cli::LocalNodes::Make(launch);
    if (!nodes.ok()) return "refused: " + nodes.error().Text() + testing::internal::GetCapturedStderr();
    const auto window = nodes.value().keys().MakeSender();
    const LiveDrive drive = DriveLive(launch, nodes.value(), 1000, [&](lockstep::Step) {
      window->Say({{input_devices::KeyOf("up").value(), true, 1}});
    });
    EXPECT_EQ(drive.controls.at(1000).throttle(), 1.0);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_THAT(window_keys(std::string("{source: joystick, keyboard: ") + kKeys + "}"),
              HasSubstr("no wheel that was set up (`rodeira input setup`) and no game pad is there (no device is "
                        "connected); the windows' keys drive"));
  // A device of one axis, with a broken file: there is nothing to guess.
  const int lever = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_WHEEL, 1, 0, 0);
  ASSERT_GE(lever, 0);
  char guid[33] = {};
  SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(lever), guid, sizeof(guid));
  WriteOwn(guid, "rodeira: wheel/1\nsteering: [\n");
  const std::string said = window_keys(std::string("{source: joystick, keyboard: ") + kKeys + "}");
  SDL_JoystickDetachVirtual(lever);
  EXPECT_THAT(said, HasSubstr(std::string(guid) + ".yaml:"));
  EXPECT_THAT(said, Not(HasSubstr("guess")));
  EXPECT_THAT(said, HasSubstr("the windows' keys drive"));
}

TEST_F(FoundSource, AGamePadDrivesWithoutBeingSetUp) {
  VirtualPad pad;
  const Told told = Drive("{source: joystick}", 2000, [&](lockstep::Step step) {
    if (step == 100) pad.Axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767);
    if (step == 100) pad.Axis(SDL_CONTROLLER_AXIS_LEFTX, -32768);
    if (step == 900) pad.Axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, -32768);
    if (step == 900) pad.Axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT, 32767);
    if (step == 900) pad.Axis(SDL_CONTROLLER_AXIS_LEFTX, 0);
    if (step == 1500) pad.Button(SDL_CONTROLLER_BUTTON_LEFTSHOULDER, true);
    if (step == 1500) pad.Button(SDL_CONTROLLER_BUTTON_B, true);
    if (step == 1500) pad.Button(SDL_CONTROLLER_BUTTON_DPAD_RIGHT, true);
    if (step == 1500) pad.Button(SDL_CONTROLLER_BUTTON_X, true);
  });
  ASSERT_EQ(told.refused, "");
  EXPECT_THAT(told.said, HasSubstr("no wheel that was set up is there; the game pad 'A pad' drives"));
  EXPECT_EQ(told.drive.controls.at(100).throttle(), 0.0);
  EXPECT_EQ(told.drive.controls.at(110).throttle(), 1.0);
  double before = 0.0;
  for (lockstep::Step step = 110; step <= 900; step += 10) {
    const double wheel = told.drive.controls.at(step).steering_wheel_rad();
    ASSERT_LE(wheel - before, 7.85 / 0.5 * 0.01 + 1e-9) << "no faster than it may: " << step;
    before = wheel;
  }
  EXPECT_GT(before, 3.0) << "to the left";
  EXPECT_EQ(told.drive.controls.at(1500).steering_wheel_rad(), 0.0) << "let go";
  EXPECT_EQ(told.drive.controls.at(910).throttle(), 0.0);
  EXPECT_EQ(told.drive.controls.at(910).brake(), 1.0);
  EXPECT_EQ(told.drive.controls.at(1500).gear(), 1);
  EXPECT_EQ(told.drive.controls.at(1510).gear(), 0);
  EXPECT_EQ(told.drive.controls.at(1510).horn(), 1u);
  EXPECT_EQ(told.drive.controls.at(1510).indicators(), 2u);
  EXPECT_EQ(told.drive.controls.at(1510).headlights(), 1u);
  EXPECT_GT(told.drive.last.odometer_m(), 0.5);
}

TEST_F(FoundSource, AGamePadMayComeAndGo) {
  VirtualPad pad;
  const Told told = Drive("{source: gamepad}", 1000, [&](lockstep::Step step) {
    if (step == 100) pad.Axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767);
    if (step == 100) pad.Axis(SDL_CONTROLLER_AXIS_LEFTX, 32767);
    if (step == 400) pad.Detach();
    if (step == 600) pad.Attach();
    if (step == 700) pad.Axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767);
  });
  ASSERT_EQ(told.refused, "");
  const double held = told.drive.controls.at(410).steering_wheel_rad();
  EXPECT_LT(held, 0.0);
  for (lockstep::Step step = 410; step <= 600; step += 10) {
    ASSERT_EQ(told.drive.controls.at(step).throttle(), 0.0) << step;
    ASSERT_EQ(told.drive.controls.at(step).steering_wheel_rad(), held) << step;
  }
  EXPECT_EQ(told.drive.controls.at(800).throttle(), 1.0);
  EXPECT_THAT(told.said,
              HasSubstr("node 'driver': warning: game pad 'A pad' was unplugged: pedals released, steering held"));
  EXPECT_THAT(told.said, HasSubstr("game pad 'A pad' is there"));
  pad.Detach();
  EXPECT_THAT(Drive("{source: gamepad}", 10, nullptr).refused, HasSubstr("no game pad is there"));
}

TEST_F(FoundSource, AWheelThatWasSetUpStandsAboveAGamePad) {
  VirtualPad pad;
  VirtualWheel wheel;
  WriteOwn(wheel.guid(),
           "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() + "\"}\nsteering: {axis: 0}\nthrottle: {axis: 2}\n");
  const Told told = Drive("{source: joystick}", 200, [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, 32767);
  });
  EXPECT_EQ(told.refused, "");
  EXPECT_EQ(told.said, "");
  EXPECT_EQ(told.drive.controls.at(110).throttle(), 1.0);
}

TEST_F(FoundSource, APadsStartPausesAndItsYIsTheCamera) {
  VirtualPad pad;
  for (const char* config : {"{source: joystick}", "{source: gamepad}"}) {
    const auto pause = cli::PauseButtons::Open(LaunchOf(config));
    ASSERT_NE(pause, nullptr);
    EXPECT_FALSE(pause->Pressed());
    pad.Button(SDL_CONTROLLER_BUTTON_START, true);
    EXPECT_TRUE(pause->Pressed());
    EXPECT_FALSE(pause->Pressed()) << "still held";
    pad.Button(SDL_CONTROLLER_BUTTON_START, false);
    EXPECT_FALSE(pause->Pressed());
    pad.Detach();
    EXPECT_FALSE(pause->Pressed());
    pad.Attach();
    EXPECT_FALSE(pause->Pressed());
  }
  const auto camera = nodes::WheelButtons::Open({{"", nodes::kPadCameraButton}});
  ASSERT_NE(camera, nullptr);
  EXPECT_FALSE(camera->Pressed());
  pad.Button(SDL_CONTROLLER_BUTTON_Y, true);
  EXPECT_TRUE(camera->Pressed());
  EXPECT_FALSE(camera->Pressed());
  pad.Detach();
  EXPECT_FALSE(camera->Pressed());
}

// The window finds its button as the input finds its wheel: by the file of what is plugged in, also later and again.
TEST_F(FoundSource, AWheelsOwnFileNamesTheCamerasButton) {
  const auto camera = nodes::WheelButtons::Open({{"", 0, true}});
  ASSERT_NE(camera, nullptr);
  EXPECT_FALSE(camera->Pressed()) << "nothing is plugged in";
  VirtualWheel wheel;
  EXPECT_FALSE(camera->Pressed()) << "it has no file";
  wheel.Detach();
  EXPECT_FALSE(camera->Pressed());
  WriteOwn(wheel.guid(),
           "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() +
               "\"}\nsteering: {axis: 0}\nthrottle: {axis: 2}\nbrake: {axis: 3}\nbuttons: {camera: {button: 6}}\n");
  for (int times = 0; times < 2; ++times) {
    wheel.Attach();
    EXPECT_FALSE(camera->Pressed());
    wheel.Button(5, true);
    EXPECT_FALSE(camera->Pressed()) << "another button";
    wheel.Button(6, true);
    EXPECT_TRUE(camera->Pressed());
    EXPECT_FALSE(camera->Pressed()) << "still held";
    wheel.Detach();
    EXPECT_FALSE(camera->Pressed());
  }
  WriteOwn(wheel.guid(), "rodeira: wheel/1\ndevices: [");
  wheel.Attach();
  EXPECT_FALSE(camera->Pressed());
  wheel.Button(6, true);
  EXPECT_FALSE(camera->Pressed()) << "a broken file names none";
}

}  // namespace
}  // namespace rodeira
