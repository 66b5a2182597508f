// SPDX-License-Identifier: Apache-2.0
// What is promised of the wheel in seconds: runs at real pace, which run alone. SDL's virtual joystick, a motor of the
// test's.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "common/vehicle/input_devices/joysticks.hpp"
#include "nodes/input/input_node.hpp"
#include "nodes/input/joystick_source.hpp"
#include "tests/nodes/input/live_drive.hpp"
#include "tests/nodes/input/virtual_wheel.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using lockstep::Step;

double Now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// What a motor was told, and when, by the wall's clock.
struct MotorLog {
  struct Told {
    double at_s, share, for_s;
  };
  std::mutex mutex;
  std::vector<Told> told;

  // Until when the last effect holds.
  double EndsAt_s() {
    const std::lock_guard lock(mutex);
    double end_s = 0.0;
    for (const Told& one : told) end_s = std::max(end_s, one.at_s + one.for_s);
    return end_s;
  }
  double Strongest() {
    const std::lock_guard lock(mutex);
    double strongest = 0.0;
    for (const Told& one : told) strongest = std::max(strongest, std::fabs(one.share));
    return strongest;
  }
  std::size_t size() {
    const std::lock_guard lock(mutex);
    return told.size();
  }
};

class LoggedMotor final : public input_devices::ForceDevice {
 public:
  explicit LoggedMotor(MotorLog& log) : log_(log) {}
  bool Push(double share, double for_s) override {
    const std::lock_guard lock(log_.mutex);
    log_.told.push_back({Now_s(), share, for_s});
    return true;
  }

 private:
  MotorLog& log_;
};

// A vehicle that is lost at a step: in its place no node answers any more.
class Mortal final : public lockstep::Node {
 public:
  Mortal(lockstep::Node& whole, lockstep::Step dies_at, std::atomic<double>& died_s)
      : whole_(whole), dies_at_(dies_at), died_s_(died_s) {}
  base::Status Initialise(lockstep::Outbox& outbox) override { return whole_.Initialise(outbox); }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    if (step.step < dies_at_) return whole_.Step(step, inbox, outbox);
    died_s_ = Now_s();
    return base::Failed("vehicle.not_finite", "the car is lost");
  }
  void Save(base::StateWriter& out) const override { whole_.Save(out); }
  void Restore(base::StateReader& in) override { whole_.Restore(in); }

 private:
  lockstep::Node& whole_;
  lockstep::Step dies_at_;
  std::atomic<double>& died_s_;
};

class InTime : public testing::Test {
 protected:
  void SetUp() override {
    auto started = input_devices::Joysticks::Start();
    ASSERT_TRUE(started.ok()) << started.error().Text();
    joysticks_ = std::move(started).value();
  }
  // A wheel with a motor drives a car at real pace; the axes move at steps, so that the rim is known and the road
  // pulls.
  void Drive(VirtualWheel& wheel, lockstep::InProcessSettings settings, const std::function<void(Step)>& moves = {},
             std::optional<Step> car_dies_at = std::nullopt) {
    wheel.Axis(2, -32768);
    const launch::Launch launch =
        launch::Launch::Parse(LiveLaunch("{source: keyboard, keyboard: ../configs/drivers/keyboard.yaml}"),
                              std::filesystem::path(SourceDir()) / "launch/live.yaml")
            .value();
    input_devices::WheelSettings use;
    use.devices = {{"rim", wheel.guid(), ""}};
    use.axes[static_cast<std::size_t>(input_devices::WheelAxis::kSteering)].emplace();
    use.axes[static_cast<std::size_t>(input_devices::WheelAxis::kThrottle)].emplace().axis = 2;
    const auto driver = launch.roster().Find("driver"), ego = launch.roster().Find("ego");
    auto nodes = cli::LocalNodes::Make(launch, [&](lockstep::NodeIndex node) -> std::unique_ptr<lockstep::Node> {
      if (node != driver) return nullptr;
      auto source =
          nodes::OpenWheel(use, "driver", [&](std::size_t, bool) -> std::unique_ptr<input_devices::ForceDevice> {
            return std::make_unique<LoggedMotor>(log_);
          });
      EXPECT_TRUE(source.ok()) << source.error().Text();
      return nodes::InputNodeOf(std::move(source).value(), launch.roster().base_step_ns());
    });
    ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
    std::vector<lockstep::Node*> all = nodes.value().nodes();
    std::optional<Mortal> mortal;
    if (car_dies_at) all[ego] = &mortal.emplace(*all[ego], *car_dies_at, died_s_);
    settings.pace = 1.0;
    settings.on_sample = [&](const lockstep::Sample& sample) {
      if (launch.roster().source(sample.source()).topic != idl::topics::kControls) return;
      const Step step = sample.valid();
      controls_[step] = idl::Decode<msg::Controls>(*sample.payload).value();
      seen_s_[step] = Now_s();
      if (step == 50) wheel.Axis(0, -4000);
      if (step == 50) wheel.Axis(2, 20000);
      if (moves) moves(step);
    };
    outcome_ = lockstep::RunThreaded(launch.roster(), all, settings);
  }

  std::unique_ptr<input_devices::Joysticks> joysticks_;  // keeps SDL's joysticks up through the test
  MotorLog log_;
  std::map<Step, msg::Controls> controls_;
  std::map<Step, double> seen_s_;  // by the wall's clock
  std::atomic<double> died_s_ = 0.0;
  lockstep::RunOutcome outcome_;
};

TEST_F(InTime, APauseFreesTheWheelWithinATenthOfASecondAndItFadesInAfterwards) {
  VirtualWheel wheel;
  double paused_s = 0.0, resumed_s = 0.0, end_of_effects_s = 0.0;
  lockstep::InProcessSettings settings;
  settings.last_step = 3000;
  const double begin_s = Now_s();
  settings.next_command = [&]() -> std::optional<lockstep::OperatorCommand> {
    using Kind = lockstep::Command::Kind;
    if (paused_s == 0.0 && Now_s() > begin_s + 1.5) {
      return lockstep::OperatorCommand{{Kind::kPause, 1, 0.0, ""}, [&](const base::Result<std::string>& done) {
                                         if (done.ok()) paused_s = Now_s();
                                       }};
    }
    if (paused_s > 0.0 && resumed_s == 0.0 && Now_s() > paused_s + 0.5) {
      end_of_effects_s = log_.EndsAt_s();
      return lockstep::OperatorCommand{{Kind::kResume, 1, 0.0, ""},
                                       [&](const base::Result<std::string>&) { resumed_s = Now_s(); }};
    }
    return std::nullopt;
  };
  Drive(wheel, settings);
  ASSERT_TRUE(outcome_.ok) << outcome_.fault;
  ASSERT_GT(resumed_s, paused_s);
  EXPECT_GT(log_.Strongest(), 0.0) << "the road pulls";
  EXPECT_GT(end_of_effects_s, 0.0);
  EXPECT_LE(end_of_effects_s - paused_s, 0.1);
  const std::lock_guard lock(log_.mutex);
  const auto after = std::find_if(log_.told.begin(), log_.told.end(),
                                  [&](const MotorLog::Told& one) { return one.at_s > paused_s + 0.3; });
  ASSERT_NE(after, log_.told.end());
  EXPECT_EQ(after->share, 0.0) << "from nothing again";
}

TEST_F(InTime, AStopFreesTheWheelWithinATenthOfASecond) {
  VirtualWheel wheel;
  double stopped_s = 0.0;
  lockstep::InProcessSettings settings;
  const double begin_s = Now_s();
  settings.stop_requested = [&] {
    if (stopped_s == 0.0 && Now_s() > begin_s + 1.5) stopped_s = Now_s();
    return stopped_s > 0.0;
  };
  Drive(wheel, settings);
  ASSERT_TRUE(outcome_.ok) << outcome_.fault;
  EXPECT_GT(log_.Strongest(), 0.0);
  EXPECT_LE(log_.EndsAt_s() - stopped_s, 0.1);
}

TEST_F(InTime, AVehicleThatIsLostFreesTheWheelWithinATenthOfASecond) {
  VirtualWheel wheel;
  lockstep::InProcessSettings settings;
  settings.last_step = 20'000;
  Drive(wheel, settings, {}, 1500);
  EXPECT_FALSE(outcome_.ok);
  EXPECT_NE(outcome_.fault.find("the car is lost"), std::string::npos) << outcome_.fault;
  EXPECT_GT(died_s_.load(), 0.0);
  EXPECT_GT(log_.Strongest(), 0.0);
  EXPECT_LE(log_.EndsAt_s() - died_s_, 0.1);
}

// Whatever the car does, no effect is endless.
TEST_F(InTime, EveryEffectIsFinite) {
  VirtualWheel wheel;
  lockstep::InProcessSettings settings;
  settings.last_step = 2000;
  Drive(wheel, settings);
  ASSERT_TRUE(outcome_.ok) << outcome_.fault;
  const std::lock_guard lock(log_.mutex);
  ASSERT_GT(log_.told.size(), 100u);
  for (const MotorLog::Told& one : log_.told) {
    ASSERT_GT(one.for_s, 0.0);
    ASSERT_LE(one.for_s, 0.1);
    ASSERT_LE(std::fabs(one.share), 1.0);
  }
}

// Plugged in again it drives, and has its motor anew, within two seconds of the wall's clock.
TEST_F(InTime, AWheelThatIsPluggedInAgainDrivesWithinTwoSeconds) {
  VirtualWheel wheel;
  double attached_s = 0.0, driven_s = 0.0;
  std::size_t told_before = 0;
  lockstep::InProcessSettings settings;
  settings.last_step = 4000;
  Drive(wheel, settings, [&](Step step) {
    if (step == 800) wheel.Detach();
    if (step == 1300) {
      EXPECT_EQ(controls_.at(step).throttle(), 0.0);
      told_before = log_.size();
      wheel.Attach();
      wheel.Axis(2, -32768);
      attached_s = Now_s();
    }
    if (step == 1400) wheel.Axis(2, 32767);
    if (step == 1400) wheel.Axis(0, 16384);
    if (driven_s == 0.0 && step > 1300 && controls_.at(step).throttle() > 0.9 &&
        controls_.at(step).steering_wheel_rad() < -1.0)
      driven_s = seen_s_.at(step);
  });
  ASSERT_TRUE(outcome_.ok) << outcome_.fault;
  ASSERT_GT(driven_s, 0.0) << "it drives again";
  EXPECT_LT(driven_s - attached_s, 2.0);
  EXPECT_GT(log_.size(), told_before) << "and is felt";
}

}  // namespace
}  // namespace rodeira
