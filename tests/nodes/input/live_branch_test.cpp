// SPDX-License-Identifier: Apache-2.0
// A branch with a person as its new driver: recorded up to T, then another source goes on where the first one left the
// hands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <optional>

#include "common/runtime/replay/recorded_run.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/branch.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
using system_test::Bin;
using ::testing::ElementsAre;

class LiveBranch : public ::testing::Test {
 protected:
  void SetUp() override {
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
    const auto ended = system_test::RunCommand({Bin("rodeira"), "run", system_test::LaunchFile("first_drive.yaml"),
                                                "--in-process", "--record", File("parent.mcap"), "--for", "4"});
    ASSERT_EQ(ended.status, 0) << ended.out;
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::string Source(const std::string& name) { return SourceDir() + "/" + name; }
  // What the driver did, by the step at which it was valid.
  static std::map<Step, msg::Controls> ControlsOf(const std::string& file) {
    std::map<Step, msg::Controls> all;
    const auto run = replay::RecordedRun::Open(file);
    EXPECT_TRUE(run.ok()) << run.error().Text();
    if (!run) return all;
    auto samples = run.value().Samples();
    for (auto sample = samples.Next(); sample.ok() && sample.value(); sample = samples.Next()) {
      if (run.value().roster().source(sample.value()->source()).topic != idl::topics::kControls) continue;
      all[sample.value()->valid()] = idl::Decode<msg::Controls>(*sample.value()->payload).value();
    }
    return all;
  }
  static void ExpectIdentical(const std::string& file, const std::vector<std::string>& live) {
    const auto run = replay::RecordedRun::Open(file);
    ASSERT_TRUE(run.ok()) << run.error().Text();
    const auto verdict = Verify(run.value(), 0);
    ASSERT_TRUE(verdict.ok()) << verdict.error().Text();
    EXPECT_FALSE(verdict.value().difference.has_value()) << verdict.value().difference->Text();
    EXPECT_EQ(verdict.value().substituted, live);
  }

  TemporaryFolder folder_;
  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
};

TEST_F(LiveBranch, APersonTakesTheWheelAtTAndWhatTheyDoIsKept) {
  VirtualWheel wheel;
  wheel.Axis(2, 32767);
  const auto file = folder_.Write("wheel.yaml", "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() +
                                                    "\"}\nsteering: {axis: 0, lock_deg: 450}\n" +
                                                    "throttle: {axis: 2, inverted: true}\n");
  const auto parent = ControlsOf(File("parent.mcap"));
  BranchSpec spec{File("parent.mcap"),
                  2000,
                  {{"nodes.driver.config", "{source: joystick, wheel: \"" + file.string() + "\"}"}},
                  4000,
                  File("live.mcap")};
  spec.pace = 2.0;
  // The hand moves a while after the drive has begun: an axis counts from its first move on.
  std::optional<std::chrono::steady_clock::time_point> begun;
  spec.next_command = [&]() -> std::optional<lockstep::OperatorCommand> {
    const auto now = std::chrono::steady_clock::now();
    if (!begun) begun = now;
    if (now - *begun > std::chrono::milliseconds(400)) wheel.Axis(0, -16384);
    return std::nullopt;
  };
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_THAT(outcome.value().live, ElementsAre("driver"));
  EXPECT_THAT(outcome.value().taken_over, ElementsAre("driver"));
  const auto branch = ControlsOf(File("live.mcap"));
  ASSERT_EQ(branch.rbegin()->first, 4000);
  for (Step step = 0; step <= 2000; step += 10) ASSERT_TRUE(branch.at(step) == parent.at(step)) << step;
  EXPECT_EQ(branch.at(2010).steering_wheel_rad(), parent.at(2000).steering_wheel_rad()) << "not moved yet";
  EXPECT_NE(parent.at(2010).throttle(), 0.0);
  EXPECT_EQ(branch.at(2010).throttle(), 0.0) << "the foot is another one";
  EXPECT_NEAR(branch.at(4000).steering_wheel_rad(), 225.0 * 3.14159265358979 / 180.0, 1e-3) << "half to the left";
  ExpectIdentical(File("live.mcap"), {"driver"});

  // Branched again: where no change names the driver, the person's hands are those recorded.
  const auto again = Branch({File("live.mcap"), 3000, {{"seed", "7"}}, std::nullopt, File("again.mcap")});
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_TRUE(again.value().live.empty());
  const auto hands = ControlsOf(File("again.mcap"));
  ASSERT_EQ(hands.size(), branch.size());
  for (const auto& [step, recorded] : branch) {
    ASSERT_EQ(hands.at(step).steering_wheel_rad(), recorded.steering_wheel_rad()) << step;
    ASSERT_EQ(hands.at(step).throttle(), recorded.throttle()) << step;
  }
}

TEST_F(LiveBranch, StoppedByCtrlCItKeepsWhatThePersonHasDriven) {
  VirtualWheel wheel;
  const auto file = folder_.Write("wheel.yaml", "rodeira: wheel/1\ndevices: {rim: \"" + wheel.guid() +
                                                    "\"}\nsteering: {axis: 0}\nthrottle: {axis: 2}\n");
  BranchSpec spec{File("parent.mcap"),
                  1000,
                  {{"nodes.driver.config", "{source: joystick, wheel: \"" + file.string() + "\"}"}},
                  100'000,
                  File("live.mcap")};
  spec.pace = 1.0;
  bool stop = false;
  int asked = 0;
  spec.next_command = [&]() -> std::optional<lockstep::OperatorCommand> {
    stop = ++asked > 20;
    return std::nullopt;
  };
  spec.stop_requested = [&] { return stop; };
  const auto outcome = Branch(spec);
  ASSERT_TRUE(outcome.ok()) << outcome.error().Text();
  EXPECT_GT(outcome.value().last_step, 1000);
  EXPECT_LT(outcome.value().last_step, 100'000);
  ExpectIdentical(File("live.mcap"), {"driver"});
}

TEST_F(LiveBranch, AnyDriverGoesOnWithTheHandsOfAnyOther) {
  const std::string keyboard = "{source: keyboard, keyboard: \"" + Source("configs/drivers/keyboard.yaml") + "\"}";
  const auto parent = ControlsOf(File("parent.mcap"));
  const auto to_keys =
      Branch({File("parent.mcap"), 2000, {{"nodes.driver.config", keyboard}}, 3000, File("keys.mcap")});
  ASSERT_TRUE(to_keys.ok()) << to_keys.error().Text();
  EXPECT_THAT(to_keys.value().live, ElementsAre("driver"));
  const auto keys = ControlsOf(File("keys.mcap"));
  const double before = parent.at(2000).throttle();
  EXPECT_GT(before, 0.1);
  EXPECT_GT(keys.at(2010).throttle(), 0.0) << "no key is held: the foot is on its way up from where the script had it";
  EXPECT_LT(keys.at(2010).throttle(), before);
  EXPECT_EQ(keys.at(3000).throttle(), 0.0);
  ExpectIdentical(File("keys.mcap"), {"driver"});

  const std::string script = "{source: script, script: \"" + Source("configs/scenarios/first_drive.csv") + "\"}";
  const auto back =
      Branch({File("keys.mcap"), 2500, {{"nodes.driver.config", script}}, std::nullopt, File("script.mcap")});
  ASSERT_TRUE(back.ok()) << back.error().Text();
  EXPECT_TRUE(back.value().live.empty());
  EXPECT_EQ(ControlsOf(File("script.mcap")).at(3000).throttle(), parent.at(3000).throttle())
      << "a script is a function of time";
  ExpectIdentical(File("script.mcap"), {});
}

}  // namespace
}  // namespace rodeira::cli
