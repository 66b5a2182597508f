// SPDX-License-Identifier: Apache-2.0
// Parts of a run are killed and stopped at random instants; the finished recording is that of an undisturbed run.
#include <fcntl.h>
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
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

const std::string kLaunch = SourceDir() + "/tests/data/n222_traffic.yaml";
const std::vector<std::string> kParts{"clock", "road", "driver", "ego", "traffic", "recorder"};

std::vector<pid_t> ProcessesOf(const std::string& run, const std::string& part) {
  return ProcessesWith("--run " + run, part == "clock" ? "/rodeira-clock" : "--node " + part);
}

// The process, once it lives and is let alone for a moment: a signal between fork and exec would hit nothing of
// interest.
pid_t Find(const std::string& run, const std::string& part) {
  for (int i = 0; i < 1000; ++i) {
    const auto found = ProcessesOf(run, part);
    if (found.size() == 1) return found.front();
    ::usleep(5000);
  }
  return -1;
}

// Until more of a recording is on the disk than now, or nothing comes for long: the run may be over.
void WaitForGrowth(const std::string& recording) {
  std::error_code problem;
  const auto before = std::filesystem::file_size(recording, problem);
  for (int i = 0; i < 2000 && (std::filesystem::file_size(recording, problem) == before || problem); ++i)
    ::usleep(5000);
}

// Until a recording is closed, without a pause: what its recorder does then takes microseconds.
void AwaitItsMark(const std::string& recording) {
  const auto until = std::chrono::steady_clock::now() + 30s;
  int file = -1;
  for (; file < 0 && std::chrono::steady_clock::now() < until; ::usleep(1000))
    file = ::open(recording.c_str(), O_RDONLY | O_CLOEXEC);
  char mark[8] = {};
  for (unsigned i = 0; file >= 0 && (i % 1000 != 0 || std::chrono::steady_clock::now() < until); ++i) {
    const off_t size = ::lseek(file, 0, SEEK_END);
    if (size > 100'000 && ::pread(file, mark, 8, size - 8) == 8 && std::string(mark, 8) == "\x89MCAP0\r\n") break;
  }
  if (file >= 0) ::close(file);
}

class Recovery : public ::testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  // At a pace: a fast machine's run would be over before a node was killed.
  std::vector<std::string> Command(const std::string& run, const std::string& recording, const std::string& seconds,
                                   const std::string& policy) const {
    return {Bin("rodeira"),
            "run",
            kLaunch,
            "--run",
            run,
            "--for",
            seconds,
            "--record",
            recording,
            "--pace",
            "2",
            "--set",
            "recovery=" + policy};
  }
  void Undisturbed(const std::string& seconds) {
    const Ended calm =
        RunCommand({Bin("rodeira"), "run", kLaunch, "--in-process", "--for", seconds, "--record", File("calm.mcap")});
    ASSERT_EQ(calm.status, 0) << calm.out;
    digest_ = DigestIn(calm.out);
    samples_ = SamplesOf(File("calm.mcap"));
    ASSERT_GT(samples_.size(), 1000u);
  }
  void ExpectUndisturbed(const Ended& ended, const std::string& recording) const {
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest_) << ended.out;
    EXPECT_EQ(FirstDifference(samples_, SamplesOf(recording)), "") << ended.out;
    const Ended info = RunCommand({Bin("rodeira"), "info", recording});
    EXPECT_EQ(info.status, 0) << info.out;
  }
  const cli::TemporaryFolder folder_;
  std::string digest_;
  std::vector<Recorded> samples_;
};

// RODEIRA_KILLS says how often, one part after the other; RODEIRA_KILLS_SEED repeats a sequence of instants.
TEST_F(Recovery, KilledAndStoppedAtAnyInstantNothingIsLost) {
  const int kills = static_cast<int>(Setting("RODEIRA_KILLS", 6));
  const auto seed = static_cast<unsigned>(Setting("RODEIRA_KILLS_SEED", std::random_device()()));
  SCOPED_TRACE("RODEIRA_KILLS_SEED=" + std::to_string(seed));
  std::mt19937 lot(seed);
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
      if (lot() % 3 != 0) WaitForGrowth(recording);
      std::this_thread::sleep_for(std::chrono::milliseconds(200 + lot() % 1500));
      const std::string& part = kParts[static_cast<std::size_t>(done) % kParts.size()];
      const pid_t victim =
          ProcessesOf(run_name, "recorder").empty() && ProcessesOf(run_name, "ego").empty() ? -1 : Find(run_name, part);
      if (victim < 0) break;  // the run is over
      const int signal = lot() % 3 == 0 ? SIGSTOP : SIGKILL;
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
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(300ms);
  const pid_t ego = Find(run_name, "ego");
  ASSERT_GT(ego, 0);
  ::kill(ego, SIGKILL);
  const auto named = run.WaitFor("node 'ego' was killed by signal 9", 5s);
  EXPECT_GE(named, 0ms);
  EXPECT_LE(named, 1000ms);
  const Ended ended = run.Wait(60s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("again   node 'ego' was killed by signal 9"), std::string::npos) << ended.out;
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
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(500ms);
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

// It may die before any process has heard of it: in its first moment, while it looks for other clocks, while the nodes
// start.
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
    EXPECT_NE(ended.out.find("again   the clock was killed by signal 9"), std::string::npos) << ended.out;
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
    ASSERT_GE(
        run.WaitFor(signal == SIGKILL ? "node 'view' was killed by signal 9" : "node 'view' was stopped by signal 19",
                    20s),
        0ms);
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
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(500ms);
  const pid_t recorder = Find(run_name, "recorder");
  ASSERT_GT(recorder, 0);
  ::kill(recorder, SIGSTOP);
  const Ended ended = run.Wait(60s);
  ExpectUndisturbed(ended, File("stopped.mcap"));
  std::size_t again = 0;
  for (auto at = ended.out.find("again   "); at != std::string::npos; at = ended.out.find("again   ", at + 1)) ++again;
  EXPECT_EQ(again, 1u) << ended.out;
  EXPECT_NE(ended.out.find("again   node 'recorder' was stopped by signal 19"), std::string::npos) << ended.out;
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

TEST_F(Recovery, PauseWaitsForAPersonWithoutALimit) {
  Undisturbed("8");
  const std::string run_name = "recovery-pause-" + std::to_string(::getpid());
  Started run(Command(run_name, File("pause.mcap"), "8", "pause"));
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(500ms);
  // As a debugger stops it: it goes on when it is let go on.
  const pid_t ego = Find(run_name, "ego");
  ASSERT_GT(ego, 0);
  ::kill(ego, SIGSTOP);
  ASSERT_GE(run.WaitFor("node 'ego' was stopped by signal 19", 5s), 0ms);
  std::this_thread::sleep_for(2s);  // longer than any limit of silence
  const Ended state = RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"});
  EXPECT_EQ(state.status, 0) << state.out;
  EXPECT_NE(state.out.find("it stands: node 'ego' was stopped by signal 19"), std::string::npos)
      << "the end of the chain of waiting is named: " << state.out;
  ::kill(ego, SIGCONT);
  std::this_thread::sleep_for(500ms);
  // Dead, it needs a person's word.
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  ASSERT_GE(run.WaitFor("node 'traffic' was killed by signal 9", 5s), 0ms);
  const Ended restart = RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "restart", "traffic"});
  EXPECT_EQ(restart.status, 0) << restart.out;
  EXPECT_NE(restart.out.find("'traffic' is started again"), std::string::npos) << restart.out;
  const Ended ended = run.Wait(60s);
  ExpectUndisturbed(ended, File("pause.mcap"));
  EXPECT_NE(ended.out.find("again   node 'traffic' at about step "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find(": asked for by the operator; started again"), std::string::npos) << ended.out;
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("pause.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << "computed again, it is the same: " << verified.out;
}

// What was granted before a node began again is no time that the run owes: it goes on from there at its pace.
TEST_F(Recovery, AtAPaceARestartAfterAPauseCostsItsOwnTimeOnly) {
  const std::string run_name = "recovery-pace-" + std::to_string(::getpid());
  const auto launch = folder_.Write("empty.yaml",
                                    "rodeira: launch/1\nrecovery: pause\nnodes:\n  a: {kind: empty}\n  b: {kind: "
                                    "empty}\n  recorder: {kind: recorder}\n");
  Started run({Bin("rodeira"), "run", launch.string(), "--run", run_name, "--for", "5", "--pace", "real", "--record",
               File("pace.mcap")});
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(3s);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"pause"}, {"step", "10"}, {"resume"}, {"restart", "a"}}) {
    std::vector<std::string> command{Bin("rodeira"), "ctl", "--run", run_name};
    command.insert(command.end(), words.begin(), words.end());
    const Ended done = RunCommand(command);
    EXPECT_EQ(done.status, 0) << done.out;
  }
  const Ended ended = run.Wait(30s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  const auto dropped = ended.out.find(" s dropped");
  ASSERT_NE(dropped, std::string::npos) << ended.out;
  const auto begin = ended.out.rfind(' ', dropped - 1);
  EXPECT_LT(std::stod(ended.out.substr(begin)), 3.0) << "less than it had run before: " << ended.out;
}

// The whole run restarts the nodes that it loses; only without its traffic it is to end.
TEST_F(Recovery, EachNodeMayHaveAPolicyOfItsOwn) {
  const std::string run_name = "recovery-own-" + std::to_string(::getpid());
  std::vector<std::string> command = Command(run_name, File("own.mcap"), "1000", "restart");
  command.insert(command.end(), {"--set", "nodes.traffic.recovery=stop"});
  Started run(command);
  ASSERT_TRUE(Runs(run_name));
  const pid_t ego = Find(run_name, "ego");
  ASSERT_GT(ego, 0);
  ::kill(ego, SIGKILL);
  ASSERT_GE(run.WaitFor("node 'ego' was killed by signal 9", 5s), 0ms);
  ASSERT_TRUE(Runs(run_name)) << "it goes on";
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("again   node 'ego' was killed by signal 9"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("node 'traffic' was killed by signal 9"), std::string::npos) << ended.out;
}

// A dead node need not be restarted only to be able to stop.
TEST_F(Recovery, ARunThatWaitsForADeadNodeCanBeStopped) {
  const std::string run_name = "recovery-stop-" + std::to_string(::getpid());
  Started run(Command(run_name, File("stop.mcap"), "60", "pause"));
  ASSERT_TRUE(Runs(run_name));
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  ASSERT_GE(run.WaitFor("node 'traffic' was killed by signal 9", 5s), 0ms);
  const Ended state = RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"});
  EXPECT_NE(state.out.find("it stands: node 'traffic' was killed by signal 9"), std::string::npos) << state.out;
  (void)RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "stop"});
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("stopped while the run waited: node 'traffic' was killed by signal 9"), std::string::npos)
      << ended.out;
  const Ended info = RunCommand({Bin("rodeira"), "info", File("stop.mcap")});
  EXPECT_NE(info.out.find("no gaps; the run was broken off at step "), std::string::npos) << info.out;
}

TEST_F(Recovery, RepeatedCrashWithoutProgressEndsRun) {
  const std::string run_name = "recovery-loop-" + std::to_string(::getpid());
  Started run(Command(run_name, File("loop.mcap"), "1000", "restart"));
  std::this_thread::sleep_for(1500ms);
  for (int life = 0; life < 4; ++life) {
    const pid_t ego = Find(run_name, "ego");
    ASSERT_GT(ego, 0) << life;
    ::kill(ego, SIGKILL);
    for (int i = 0; i < 400 && ::kill(ego, 0) == 0; ++i) ::usleep(5000);
  }
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("it was lost 4 times without getting beyond step"), std::string::npos) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
}

// Its other life computes what it has said already: the keeper of that notices, and the node is named, not the keeper.
TEST_F(Recovery, ANodeThatReadsAClockIsDetectedWhenItIsRestarted) {
  const auto launch = folder_.Write(
      "broken.yaml",
      "rodeira: launch/1\nrecovery: restart\nnodes:\n  a: {kind: empty}\n  b: {kind: empty, config: {broken: clock}}\n"
      "  recorder: {kind: recorder}\n");
  const std::string run_name = "recovery-broken-" + std::to_string(::getpid());
  Started run({Bin("rodeira"), "run", launch.string(), "--run", run_name, "--for", "60", "--pace", "real", "--record",
               File("broken.mcap")});
  ASSERT_TRUE(Runs(run_name));
  std::this_thread::sleep_for(1500ms);
  const pid_t broken = Find(run_name, "b");
  ASSERT_GT(broken, 0);
  ::kill(broken, SIGKILL);
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("node 'b' contradicts itself at step "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("field 'value': "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("depends on more than its inputs and its state"), std::string::npos) << ended.out;
}

TEST_F(Recovery, WhatCannotBeIsRefused) {
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> command{Bin("rodeira"), "run", kLaunch, "--for", "1"};
    command.insert(command.end(), more.begin(), more.end());
    const Ended ended = RunCommand(command);
    EXPECT_EQ(ended.status, 2) << ended.out;
    return ended.out;
  };
  const std::string without = refused({"--no-record", "--set", "recovery=restart"});
  EXPECT_NE(without.find("can be started again only where there is a recorder, but there is none"), std::string::npos)
      << without;
  const std::string unknown = refused({"--set", "recovery=restrat"});
  EXPECT_NE(unknown.find("restart"), std::string::npos) << unknown;
  const std::string live =
      refused({"--set", "nodes.driver.config.source=keyboard", "--set", "nodes.driver.recovery=restart"});
  EXPECT_NE(live.find("driven by a person"), std::string::npos) << live;
}

}  // namespace
}  // namespace rodeira::system_test
