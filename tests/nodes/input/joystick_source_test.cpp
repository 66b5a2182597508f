// SPDX-License-Identifier: Apache-2.0
// The input node at a steering wheel: SDL's virtual joystick, no display and no device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "common/core/base/files.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "launch/rodeira/run/pause_buttons.hpp"
#include "nodes/view/window/wheel_buttons.hpp"
#include "tests/names.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

class JoystickSource : public testing::Test {
 protected:
  void SetUp() override {
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string WheelFile(const std::string& guid, const std::string& more = "") const {
    const std::string text =
        "rodeira: wheel/1\ndevices: {rim: \"" + guid + "\"}\nsteering: {axis: 0, lock_deg: 450}\n" +
        "throttle: {axis: 2, inverted: true}\nbrake: {axis: 3, inverted: true}\nbuttons: {gear_up: {button: "
        "4}, gear_down: {button: 5}}\n" +
        more;
    const auto path = folder_ / "wheel.yaml";
    EXPECT_TRUE(base::WriteWhole(path, std::string_view(text)).ok());
    return path.string();
  }
  static launch::Launch LaunchOf(const std::string& config) {
    return launch::Launch::Parse(LiveLaunch(config), std::filesystem::path(SourceDir()) / "launch/live.yaml").value();
  }
  static std::string Complaint(const std::string& config) {
    const launch::Launch launch = LaunchOf(config);
    const auto nodes = cli::LocalNodes::Make(launch);
    if (nodes.ok()) return {};
    EXPECT_EQ(nodes.error().exit_status(), 2);
    return nodes.error().Text();
  }

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-joystick-" + std::to_string(::getpid()));
};

TEST_F(JoystickSource, AWheelIsFoundByItsGuidAndRead) {
  VirtualWheel wheel;
  bool listed = false;
  for (const auto& info : joysticks_->Connected()) {
    if (info.guid != wheel.guid()) continue;
    listed = true;
    EXPECT_EQ(info.axes, 4);
    EXPECT_EQ(info.buttons, 8);
  }
  EXPECT_TRUE(listed);
  joysticks_->Use({wheel.guid(), std::string(32, 'f')});
  EXPECT_TRUE(joysticks_->reading(0).connected);
  EXPECT_FALSE(joysticks_->reading(1).connected);
  wheel.Axis(0, -12345);
  wheel.Button(4, true);
  joysticks_->Update();
  EXPECT_EQ(joysticks_->reading(0).axes.at(0), -12345.0);
  EXPECT_EQ(joysticks_->reading(0).buttons.at(4), 1);
}

TEST_F(JoystickSource, TheWheelDrivesTheCar) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  wheel.Axis(3, 32767);
  const launch::Launch launch = LaunchOf("{source: joystick, wheel: " + WheelFile(wheel.guid()) + "}");
  auto nodes = cli::LocalNodes::Make(launch);
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  const LiveDrive drive = DriveLive(launch, nodes.value(), 4000, [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, -32768);
    if (step == 2500) wheel.Axis(0, -16384);
    if (step == 3000) wheel.Axis(2, 32767);
    if (step == 3000) wheel.Axis(3, 0);
  });
  EXPECT_EQ(drive.controls.at(100).throttle(), 0.0) << "nobody has touched it";
  EXPECT_EQ(drive.controls.at(110).throttle(), 1.0) << "what is there at an activation is that activation's sample";
  EXPECT_EQ(drive.controls.at(2500).steering_wheel_rad(), 0.0);
  EXPECT_NEAR(drive.controls.at(2510).steering_wheel_rad(), 225.0 * 3.14159265358979 / 180.0, 1e-3)
      << "half to the left";
  EXPECT_EQ(drive.controls.at(3010).throttle(), 0.0);
  EXPECT_NEAR(drive.controls.at(3010).brake(), 0.5, 1e-4);
  EXPECT_GT(drive.last.odometer_m(), 4.0);
}

TEST_F(JoystickSource, UnpluggedInTheRunThePedalsAreReleasedTheSteeringStaysAndTheRunGoesOn) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  const launch::Launch launch = LaunchOf("{source: joystick, wheel: " + WheelFile(wheel.guid()) + "}");
  auto nodes = cli::LocalNodes::Make(launch);
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  testing::internal::CaptureStderr();
  const LiveDrive drive = DriveLive(launch, nodes.value(), 2000, [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, -32768);
    if (step == 100) wheel.Axis(0, 8192);
    if (step == 1000) wheel.Detach();
    if (step == 1500) {
      wheel.Attach();
      wheel.Axis(2, 32767);
    }
    if (step == 1600) wheel.Axis(2, -32768);
  });
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(drive.controls.at(1000).throttle(), 1.0);
  const double steering = drive.controls.at(1000).steering_wheel_rad();
  EXPECT_LT(steering, -1.0);
  for (lockstep::Step step = 1010; step <= 1500; step += 10) {
    ASSERT_EQ(drive.controls.at(step).throttle(), 0.0) << step;
    ASSERT_EQ(drive.controls.at(step).steering_wheel_rad(), steering) << step;
  }
  EXPECT_EQ(drive.controls.at(1700).throttle(), 1.0) << "plugged in again";
  EXPECT_THAT(said, HasLine("node 'driver': warning: rim ' … unplugged"));
  EXPECT_NE(said.find("is there again"), std::string::npos) << said;
}

// The operator's button and the window's: a press counts once, one that is held at the beginning does not, and a wheel
// may come and go.
TEST_F(JoystickSource, ButtonsForPauseAndCameraArePressesAndNoControls) {
  VirtualWheel wheel;
  const std::string config = "{source: joystick, wheel: " + WheelFile(wheel.guid()) + "}";
  const auto path = folder_ / "wheel.yaml";
  std::string text = base::ReadText(path).value();
  const std::string gear = "gear_up: {button: 4}";
  text.replace(text.find(gear), gear.size(), gear + ", pause: {button: 6}, camera: {button: 7}");
  ASSERT_TRUE(base::WriteWhole(path, std::string_view(text)).ok());
  const launch::Launch launch = LaunchOf(config);
  EXPECT_EQ(Complaint(config), "");
  wheel.Button(6, true);
  const auto pause = cli::PauseButtons::Open(launch);
  ASSERT_NE(pause, nullptr);
  const auto camera = nodes::WheelButtons::Open({{wheel.guid(), 7}});
  ASSERT_NE(camera, nullptr);
  EXPECT_FALSE(pause->Pressed()) << "held as it begins";
  wheel.Button(6, false);
  EXPECT_FALSE(pause->Pressed());
  wheel.Button(6, true);
  EXPECT_TRUE(pause->Pressed());
  EXPECT_FALSE(pause->Pressed()) << "still held";
  EXPECT_FALSE(camera->Pressed());
  wheel.Button(7, true);
  EXPECT_FALSE(pause->Pressed());
  EXPECT_TRUE(camera->Pressed());
  wheel.Button(7, false);
  EXPECT_FALSE(camera->Pressed());
  wheel.Button(7, true);
  EXPECT_TRUE(camera->Pressed());
  EXPECT_FALSE(camera->Pressed());
  wheel.Detach();
  EXPECT_FALSE(camera->Pressed());
  EXPECT_FALSE(pause->Pressed());
  wheel.Attach();
  EXPECT_FALSE(camera->Pressed());
  EXPECT_FALSE(pause->Pressed());
  wheel.Button(7, true);
  wheel.Button(6, true);
  EXPECT_TRUE(camera->Pressed());
  EXPECT_TRUE(pause->Pressed());
  EXPECT_EQ(cli::PauseButtons::Open(LaunchOf("{source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}")),
            nullptr);
  EXPECT_EQ(nodes::WheelButtons::Open({}), nullptr);
}

TEST_F(JoystickSource, AMissingDeviceIsOneSentenceThatListsWhatIsThere) {
  const std::string nowhere(32, 'f');
  EXPECT_NE(Complaint("{source: joystick, wheel: " + WheelFile(nowhere) + "}")
                .find("wheel.yaml:2: device 'rim' with GUID " + nowhere + " is not there; "),
            std::string::npos)
      << Complaint("{source: joystick, wheel: " + WheelFile(nowhere) + "}");
  VirtualWheel wheel;
  const std::string said = Complaint("{source: joystick, wheel: " + WheelFile(nowhere) + "}");
  EXPECT_NE(said.find("connected: "), std::string::npos) << said;
  EXPECT_NE(said.find(wheel.guid()), std::string::npos) << said;
  // The GUID of the launch file stands above that of the wheel file.
  EXPECT_EQ(
      Complaint("{source: joystick, wheel: " + WheelFile(nowhere) + ", devices: {rim: \"" + wheel.guid() + "\"}}"), "");
  EXPECT_NE(Complaint("{source: joystick, wheel: " + WheelFile(nowhere) + ", devices: {rym: \"" + wheel.guid() + "\"}}")
                .find("the wheel file has no device 'rym'; did you mean 'rim'?"),
            std::string::npos);
}

TEST_F(JoystickSource, AnAxisThatTheDeviceDoesNotHaveIsRefused) {
  VirtualWheel wheel;
  const std::string axis =
      Complaint("{source: joystick, wheel: " + WheelFile(wheel.guid(), "clutch: {axis: 7}\n") + "}");
  EXPECT_NE(axis.find("wheel.yaml:7: axis 7 of device 'rim' was asked for; "), std::string::npos) << axis;
  EXPECT_NE(axis.find("has 4 (the first is 0)"), std::string::npos) << axis;
  const std::string button =
      Complaint("{source: joystick, wheel: " + WheelFile(wheel.guid(), "lever: {reverse: {button: 8}}\n") + "}");
  EXPECT_NE(button.find("wheel.yaml:7: button 8 of device 'rim' was asked for; "), std::string::npos) << button;
}

}  // namespace
}  // namespace rodeira
