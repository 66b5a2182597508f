// SPDX-License-Identifier: Apache-2.0
// The input node at the keyboard, in a run of one process; the test holds the keys.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

const std::string kConfig = "{source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}";

LiveDrive Drive(const KeyScript& script, lockstep::Step last) { return DriveByKeys(LiveLaunch(kConfig), script, last); }

// Held when the sample valid at 100 appears (activation 90): activation 100 sees it first, its sample is valid at 110.
TEST(KeyboardSource, AKeyBecomesControlsAtTheNextActivation) {
  const auto settings =
      input_devices::LoadKeyboard(std::filesystem::path(SourceDir()) / "configs/drivers/keyboard.yaml").value();
  const LiveDrive drive = Drive({{100, {"w"}}, {2000, {}}}, 3000);
  for (const auto& [step, controls] : drive.controls) {
    const double held_s = std::clamp(static_cast<double>(step - 100), 0.0, 1900.0) * 1e-3;
    const double released_s = std::max(0.0, static_cast<double>(step - 2000) * 1e-3);
    const double expected =
        std::max(0.0, std::min(1.0, held_s / settings.throttle.press_s) - released_s / settings.throttle.release_s);
    EXPECT_NEAR(controls.throttle(), expected, 1e-9) << step;
    EXPECT_EQ(controls.steering_wheel_rad(), 0.0);
    EXPECT_EQ(controls.gear(), 1);
  }
  EXPECT_EQ(drive.controls.size(), 302u) << "valid at 0, and what the activations of 0 to 3000 give";
  EXPECT_GT(drive.last.odometer_m(), 3.0) << "the car went";
}

TEST(KeyboardSource, TheSteeringLockFollowsTheSpeedOfTheCar) {
  const LiveDrive slow = Drive({{1000, {"left"}}}, 4000);
  const LiveDrive fast = Drive({{10, {"w"}}, {8000, {"left"}}}, 11000);
  const double full = slow.controls.at(4000).steering_wheel_rad();
  EXPECT_NEAR(full, 450.0 * 3.14159265358979 / 180.0, 1e-9) << "at rest the whole lock";
  EXPECT_GT(fast.controls.at(11000).steering_wheel_rad(), 0.0);
  EXPECT_LT(fast.controls.at(11000).steering_wheel_rad(), 0.4 * full);
}

TEST(KeyboardSource, AGearIsChangedOncePerPressAndTheCarGoesBackward) {
  const LiveDrive drive = Drive({{100, {"q"}}, {200, {}}, {300, {"q"}}, {320, {"w"}}}, 4000);
  EXPECT_EQ(drive.controls.at(100).gear(), 1);
  EXPECT_EQ(drive.controls.at(200).gear(), 0);
  EXPECT_EQ(drive.controls.at(400).gear(), -1);
  EXPECT_LT(drive.last.position_w_m().x() - 0.0, drive.last.odometer_m()) << "not forward";
  EXPECT_LT(drive.last.velocity_w_mps().x(), -0.5) << "the plane's start looks east";
}

// Indicators, headlights and horn stand in the controls, and the car publishes what shines.
TEST(KeyboardSource, LampsAndHornAreInTheControlsAndOnTheCar) {
  const LiveDrive drive =
      Drive({{100, {"comma"}}, {200, {}}, {300, {"l", "g"}}, {600, {}}, {700, {"slash"}}, {800, {}}}, 1000);
  EXPECT_EQ(drive.controls.at(100).indicators(), 0u);
  EXPECT_EQ(drive.controls.at(110).indicators(), 1u);
  EXPECT_EQ(drive.controls.at(300).headlights(), 0u);
  EXPECT_EQ(drive.controls.at(310).headlights(), 1u);
  EXPECT_EQ(drive.controls.at(600).horn(), 1u);
  EXPECT_EQ(drive.controls.at(610).horn(), 0u);
  EXPECT_EQ(drive.controls.at(690).indicators(), 1u);
  EXPECT_EQ(drive.controls.at(1000).indicators(), 3u);
  EXPECT_EQ(drive.last.lights(), 2u + 4u + 16u) << "both indicators and dipped beam (vehicle.idl)";
  EXPECT_EQ(drive.last.horn(), 0u);
}

TEST(KeyboardSource, WithoutAKeyTwoRunsAreEqual) {
  const base::Digest digest = Drive({}, 1500).outcome.digest;
  EXPECT_EQ(Drive({}, 1500).outcome.digest, digest);
  // The state holds the pressed keys; it does not hold which window sends, nor how often.
  const auto launch =
      launch::Launch::Parse(LiveLaunch(kConfig), std::filesystem::path(SourceDir()) / "launch/live.yaml");
  auto nodes = cli::LocalNodes::Make(launch.value());
  EXPECT_EQ(DriveLive(launch.value(), nodes.value(), 1500, nullptr).outcome.digest, digest) << "without any window";
  EXPECT_NE(Drive({{100, {"w"}}}, 1500).outcome.digest, digest);
  EXPECT_EQ(Drive({{100, {"w"}}}, 1500).outcome.digest, Drive({{100, {"up"}}}, 1500).outcome.digest)
      << "either key for the same thing";
}

TEST(KeyboardSource, WrongFilesAreRefused) {
  const auto complaint = [](const std::string& config) {
    const auto launch =
        launch::Launch::Parse(LiveLaunch(config), std::filesystem::path(SourceDir()) / "launch/live.yaml");
    if (!launch) return launch.error().Text();
    auto nodes = cli::LocalNodes::Make(launch.value());
    if (nodes.ok()) return std::string();
    EXPECT_EQ(nodes.error().exit_status(), 2);
    return nodes.error().Text();
  };
  EXPECT_NE(complaint("{source: keybord}").find("did you mean 'keyboard'?"), std::string::npos)
      << complaint("{source: keybord}");
  EXPECT_NE(complaint("{source: keyboard}").find("'nodes.driver.config.keyboard' is missing"), std::string::npos)
      << complaint("{source: keyboard}");
  EXPECT_NE(complaint("{source: keyboard, keyboard: no.yaml}").find("there is no such file"), std::string::npos);
  EXPECT_NE(complaint("{source: keyboard, keyboard: ../configs/drivers/default.yaml}").find("'rodeira' is 'driver/1'"),
            std::string::npos)
      << complaint("{source: keyboard, keyboard: ../configs/drivers/default.yaml}");
}

}  // namespace
}  // namespace rodeira
