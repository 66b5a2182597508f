// SPDX-License-Identifier: Apache-2.0
// Parts of a run are killed and stopped at random instants; the finished recording is that of an undisturbed run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "common/core/base/files.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/names.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/system/recovery_fixture.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// RODEIRA_KILLS says how often, one part after the other; RODEIRA_KILLS_SEED repeats a sequence of instants.
TEST_F(Recovery, KilledAndStoppedAtAnyInstantNothingIsLost) {
  const int kills = static_cast<int>(Setting("RODEIRA_KILLS", 6));
  const auto seed = static_cast<unsigned>(Setting("RODEIRA_KILLS_SEED", std::random_device()()));
  SCOPED_TRACE("RODEIRA_KILLS_SEED=" + std::to_string(seed));
  std::mt19937 rng(seed);
  const std::string seconds = "16";  // a run that is over is followed by another one
  Undisturbed(seconds);
  int done = 0;
  for (int round = 0; done < kills && round < 3 + kills; ++round) {
    const std::string run_name = "recovery-" + std::to_string(::getpid()) + "-" + std::to_string(round);
    const std::string recording = File(run_name + ".mcap");
    Started run(Command(run_name, recording, seconds, "restart"));
    std::string story;
    // The first instants may fall into the start.
    while (done < kills) {
      // Two of three once the run has got on since the last one, the others in the midst of a recovery.
      if (rng() % 3 != 0) WaitForGrowth(recording);
      std::this_thread::sleep_for(std::chrono::milliseconds(200 + rng() % 1500));
      const std::string& part = kParts[static_cast<std::size_t>(done) % kParts.size()];
      const pid_t victim =
          ProcessesOf(run_name, "recorder").empty() && ProcessesOf(run_name, "ego").empty() ? -1 : Find(run_name, part);
      if (victim < 0) break;  // the run is over
      const int signal = rng() % 3 == 0 ? SIGSTOP : SIGKILL;
      ::kill(victim, signal);
      story += part + (signal == SIGSTOP ? " stopped, " : " killed, ");
      ++done;
    }
    const Ended ended = run.Wait(120s);
    SCOPED_TRACE(story);
    ExpectUndisturbed(ended, recording);
    if (HasFailure()) return;
    std::filesystem::remove(recording);
  }
  EXPECT_EQ(done, kills);
}

TEST_F(Recovery, AKilledNodeIsBackInStepWithinTwoSecondsOfBeingNamed) {
  const std::string run_name = "recovery-time-" + std::to_string(::getpid());
  Started run(Command(run_name, File("time.mcap"), "6", "restart"));
  ASSERT_TRUE(WaitForStep(run_name, 600));
  const pid_t ego = Find(run_name, "ego");
  ASSERT_GT(ego, 0);
  ::kill(ego, SIGKILL);
  const auto named = run.WaitForLine("node 'ego' … signal 9", 5s);
  EXPECT_GE(named, 0ms);
  EXPECT_LE(named, 1000ms);
  const Ended ended = run.Wait(60s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasLine("again   node 'ego' … signal 9"));
  std::int64_t before_ns = 0, longest_ns = 0;
  for (const auto& wall : MessagesOf<msg::WallTime>(File("time.mcap"), idl::topics::kWallTime)) {
    longest_ns = std::max<std::int64_t>(longest_ns, wall.monotonic_ns() - before_ns);
    before_ns = wall.monotonic_ns();
  }
  EXPECT_GT(longest_ns, 0);
  EXPECT_LT(longest_ns, 3'000'000'000) << "a second until it is named, two until it is back";
  bool remarked = false;
  for (const auto& remark : MessagesOf<msg::Remark>(File("time.mcap"), idl::topics::kRemarks)) {
    remarked = remarked || (remark.kind() == "fault" && remark.text().find("'ego' was killed") != std::string::npos);
  }
  EXPECT_TRUE(remarked);
}

// Steps that a dead clock granted before it could say when: they are counted, and no other wall time stands for them.
TEST_F(Recovery, OfAKilledClockTheWallTimesThatWentWithItAreCounted) {
  Undisturbed("8");
  const std::string run_name = "recovery-clock-" + std::to_string(::getpid());
  Started run(Command(run_name, File("clock.mcap"), "8", "restart"));
  ASSERT_TRUE(WaitForStep(run_name, 1000));
  const pid_t clock = Find(run_name, "clock");
  ASSERT_GT(clock, 0);
  ::kill(clock, SIGKILL);
  ExpectUndisturbed(run.Wait(60s), File("clock.mcap"));
  std::vector<int> said(8'001, 0);
  for (const auto& wall : MessagesOf<msg::WallTime>(File("clock.mcap"), idl::topics::kWallTime)) {
    ASSERT_LT(wall.through_step(), std::ssize(said));
    for (auto step = wall.after_step() + 1; step <= wall.through_step(); ++step) ++said[static_cast<std::size_t>(step)];
  }
  const auto missing = std::count(said.begin(), said.end(), 0);
  EXPECT_EQ(std::count(said.begin(), said.end(), 1), std::ssize(said) - missing) << "no step was granted twice";
  EXPECT_LE(missing, 400) << "what is not said yet is a twentieth of a second old, at twice real time";
  const Ended info = RunCommand({Bin("rodeira"), "info", File("clock.mcap")});
  const std::string sentence = "the wall times of " + std::to_string(missing) + " steps are missing";
  EXPECT_EQ(info.out.find(sentence) != std::string::npos, missing > 0) << sentence << "\n" << info.out;
  std::int64_t lost_at = -1;
  for (const auto& remark : MessagesOf<msg::Remark>(File("clock.mcap"), idl::topics::kRemarks)) {
    if (remark.text().find("the clock was lost") != std::string::npos) lost_at = remark.step();
  }
  EXPECT_GT(lost_at, 0);
}

// It may be killed before any process has received its samples: at its start, while it looks for other clocks, while
// the nodes start.
TEST_F(Recovery, AClockThatDiesWhileTheRunStartsIsStartedAgain) {
  Undisturbed("2");
  for (const auto after : {0ms, 100ms, 350ms, 600ms}) {
    SCOPED_TRACE(after.count());
    const std::string run_name = "recovery-start-" + std::to_string(::getpid()) + "-" + std::to_string(after.count());
    Started run(Command(run_name, File(run_name + ".mcap"), "2", "restart"));
    const pid_t clock = Find(run_name, "clock");
    ASSERT_GT(clock, 0);
    std::this_thread::sleep_for(after);
    ::kill(clock, SIGKILL);
    const Ended ended = run.Wait(60s);
    ExpectUndisturbed(ended, File(run_name + ".mcap"));
    EXPECT_THAT(ended.out, HasLine("again   the clock … signal 9"));
    if (HasFailure()) return;
  }
}

// It writes its pictures again, as an undisturbed one does.
TEST_F(Recovery, AKilledViewThatWritesPicturesLeavesNoneOut) {
  const auto command = [&](const std::string& name, const std::string& pace) {
    return std::vector<std::string>{Bin("rodeira"),
                                    "run",
                                    LaunchFile("demo.yaml"),
                                    "--headless",
                                    "--run",
                                    name,
                                    "--for",
                                    "5",
                                    "--pace",
                                    pace,
                                    "--record",
                                    File(name + ".mcap"),
                                    "--set",
                                    "recovery=restart",
                                    "--set",
                                    "nodes.view.config.quality=low",
                                    "--set",
                                    "nodes.view.config.width_px=160",
                                    "--set",
                                    "nodes.view.config.height_px=96",
                                    "--set",
                                    "nodes.view.config.frames.times_s=[0.5, 2, 3.5, 5]",
                                    "--set",
                                    "nodes.view.config.frames.folder=" + File(name)};
  };
  const std::string calm = "view-calm-" + std::to_string(::getpid()),
                    struck = "view-struck-" + std::to_string(::getpid());
  const Ended undisturbed = RunCommand(command(calm, "max"));
  ASSERT_EQ(undisturbed.status, 0) << undisturbed.out;
  digest_ = DigestIn(undisturbed.out);
  samples_ = SamplesOf(File(calm + ".mcap"));
  Started run(command(struck, "2"));
  ASSERT_TRUE(Runs(struck));
  for (const int signal : {SIGKILL, SIGSTOP}) {
    std::this_thread::sleep_for(500ms);
    const pid_t view = Find(struck, "view");
    ASSERT_GT(view, 0);
    ::kill(view, signal);
    ASSERT_GE(run.WaitFor(signal == SIGKILL ? "node 'view' was killed" : "node 'view' was stopped", 20s), 0ms);
  }
  ExpectUndisturbed(run.Wait(120s), File(struck + ".mcap"));
  std::size_t pictures = 0;
  for (const auto& picture : std::filesystem::directory_iterator(File(calm))) {
    ++pictures;
    const auto same = base::ReadBytes(File(struck) + "/" + picture.path().filename().string());
    ASSERT_TRUE(same.ok()) << same.error().Text();
    EXPECT_EQ(same.value(), base::ReadBytes(picture.path()).value()) << picture.path();
  }
  EXPECT_EQ(pictures, 4u);
}

// Writers to it are held up by its memory for a while: that is no node's fault.
TEST_F(Recovery, AStoppedRecorderAloneIsNamed) {
  Undisturbed("8");
  const std::string run_name = "recovery-recorder-" + std::to_string(::getpid());
  Started run(Command(run_name, File("stopped.mcap"), "8", "restart"));
  ASSERT_TRUE(WaitForStep(run_name, 1000));
  const pid_t recorder = Find(run_name, "recorder");
  ASSERT_GT(recorder, 0);
  ::kill(recorder, SIGSTOP);
  const Ended ended = run.Wait(60s);
  ExpectUndisturbed(ended, File("stopped.mcap"));
  std::size_t again = 0;
  for (auto at = ended.out.find("again   "); at != std::string::npos; at = ended.out.find("again   ", at + 1)) ++again;
  EXPECT_EQ(again, 1u) << ended.out;
  EXPECT_THAT(ended.out, HasLine("again   node 'recorder' … signal 19"));
}

// Its file is closed, but it has not said so: the most unlucky moment.
TEST_F(Recovery, ARecorderThatDiesOnItsLastWordLosesNothing) {
  Undisturbed("3");
  for (int i = 0; i < 8; ++i) {
    const std::string run_name = "recovery-last-" + std::to_string(::getpid()) + "-" + std::to_string(i);
    const std::string recording = File(run_name + ".mcap");
    Started run(Command(run_name, recording, "3", "restart"));
    const pid_t recorder = Find(run_name, "recorder");
    ASSERT_GT(recorder, 0);
    AwaitItsMark(recording);
    (void)::kill(recorder, SIGKILL);
    const Ended ended = run.Wait(60s);
    ExpectUndisturbed(ended, recording);
    if (HasFailure() || ended.out.find("'recorder' was killed by signal 9") != std::string::npos)
      return;  // else it was faster
  }
  GTEST_SKIP() << "the recorder was gone before it could be killed, eight times";
}

}  // namespace
}  // namespace rodeira::system_test
