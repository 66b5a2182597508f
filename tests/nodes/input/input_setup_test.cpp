// SPDX-License-Identifier: Apache-2.0
// `rodeira input setup` at SDL's virtual wheel, and a run that finds what it has written.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/input_devices/wheel_setup.hpp"
#include "launch/rodeira/commands/input_command.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

class InputSetup : public testing::Test {
 protected:
  void SetUp() override {
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
    auto made = base::TemporaryFolder::Make("input");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    ::setenv("XDG_CONFIG_HOME", folder_->path().c_str(), 1);
  }
  void TearDown() override { ::unsetenv("XDG_CONFIG_HOME"); }

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
  std::optional<base::TemporaryFolder> folder_;
};

TEST_F(InputSetup, WritesAFileThatARunFindsByTheWheelItself) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  wheel.Axis(3, 32767);
  // At which of the 10 ms what is moved: from one place to another in half a second each.
  struct Move {
    int axis, from, to;
  };
  const std::vector<Move> moves = {{0, 0, -32000}, {0, -32000, 32000}, {0, 32000, 0},      {-1, 0, 0},
                                   {-1, 0, 0},     {2, 32767, -32768}, {2, -32768, 32767}, {-1, 0, 0},
                                   {-1, 0, 0},     {3, 32767, -32768}, {3, -32768, 32767}, {-1, 0, 0},
                                   {-1, 0, 0}};
  int tick = 0;
  std::string said;
  const auto wait = [&] {
    const auto at = static_cast<std::size_t>(tick / 50);
    if (at < moves.size()) {
      const Move& move = moves[at];
      if (move.axis >= 0) wheel.Axis(move.axis, move.from + (move.to - move.from) * (tick % 50 + 1) / 50);
    } else {  // no clutch: a button; then two for the gears, and two for camera and pause
      const int after = tick - 50 * static_cast<int>(moves.size());
      for (const int press : {0, 1, 2, 3, 4})
        wheel.Button(3 + press, after >= 30 * press + 10 && after < 30 * press + 20);
    }
    ++tick;
    return tick < 3000;
  };
  ASSERT_EQ(cli::SetUpInput(
                {}, [&](const std::string& line) { said += line + "\n"; }, wait),
            0)
      << said;
  EXPECT_NE(said.find("1. Turn the steering wheel"), std::string::npos) << said;
  EXPECT_NE(said.find("5. Press the button for a higher gear"), std::string::npos) << said;
  EXPECT_NE(said.find("6. Press the button for another camera"), std::string::npos) << said;
  EXPECT_EQ(said.find("7. "), std::string::npos) << said;
  const auto file = folder_->path() / "rodeira/wheels" / (wheel.guid() + ".yaml");
  EXPECT_EQ(input_devices::WheelFileOf(wheel.guid()), file);
  EXPECT_NE(said.find("written: " + file.string()), std::string::npos) << said;
  const launch::Launch launch =
      launch::Launch::Parse(LiveLaunch("{source: joystick}"), std::filesystem::path(SourceDir()) / "launch/live.yaml")
          .value();
  auto nodes = cli::LocalNodes::Make(launch);
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  const LiveDrive drive = DriveLive(launch, nodes.value(), 1500, [&](lockstep::Step step) {
    if (step == 100) wheel.Axis(2, -32768);
    if (step == 1000) wheel.Axis(0, 32000);
  });
  EXPECT_EQ(drive.controls.at(110).throttle(), 1.0);
  EXPECT_NEAR(drive.controls.at(1010).steering_wheel_rad(), -450.0 * 3.14159265358979 / 180.0, 0.02)
      << "its end is the car's lock";
}

TEST_F(InputSetup, CancelledOrWithoutAWheelItSaysSoAndWritesNothing) {
  const auto say = [](const std::string&) {};
  const bool none = joysticks_->Connected().empty();
  EXPECT_EQ(cli::SetUpInput({}, say, [] { return true; }), none ? 2 : 1);
  VirtualWheel wheel;
  int ticks = 0;
  EXPECT_EQ(cli::SetUpInput({}, say, [&] { return ++ticks < 100; }), 1);
  EXPECT_EQ(cli::SetUpInput({}, say, [] { return true; }), 1) << "a minute without a movement";
  EXPECT_FALSE(std::filesystem::exists(folder_->path() / "rodeira"));
}

// A device that is no wheel to SDL is not guessed at.
TEST_F(InputSetup, WithoutAFileARunNamesTheSetup) {
  const VirtualWheel stick(SDL_JOYSTICK_TYPE_UNKNOWN);
  const launch::Launch launch =
      launch::Launch::Parse(LiveLaunch("{source: joystick}"), std::filesystem::path(SourceDir()) / "launch/live.yaml")
          .value();
  const auto nodes = cli::LocalNodes::Make(launch);
  ASSERT_FALSE(nodes.ok());
  EXPECT_EQ(nodes.error().exit_status(), 2);
  EXPECT_NE(
      nodes.error().Text().find("no 'wheel' is named, and none of the devices was set up (`rodeira input setup`)"),
      std::string::npos)
      << nodes.error().Text();
  EXPECT_NE(nodes.error().Text().find(stick.guid()), std::string::npos) << nodes.error().Text();
}

TEST_F(InputSetup, WithoutAFileAWheelDrivesAtOnce) {
  const VirtualWheel wheel;
  const launch::Launch launch =
      launch::Launch::Parse(LiveLaunch("{source: joystick}"), std::filesystem::path(SourceDir()) / "launch/live.yaml")
          .value();
  const auto nodes = cli::LocalNodes::Make(launch);
  EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
}

}  // namespace
}  // namespace rodeira
