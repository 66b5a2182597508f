// SPDX-License-Identifier: Apache-2.0
// What a run does without a node of its own, by its policy: it waits for an operator, ends, or goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recovery_fixture.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

TEST_F(Recovery, PauseWaitsForAPersonWithoutALimit) {
  Undisturbed("8");
  const std::string run_name = "recovery-pause-" + std::to_string(::getpid());
  Started run(Command(run_name, File("pause.mcap"), "8", "pause"));
  ASSERT_TRUE(WaitForStep(run_name, 1000));
  // As a debugger stops it: it goes on when it is let go on.
  const pid_t ego = Find(run_name, "ego");
  ASSERT_GT(ego, 0);
  ::kill(ego, SIGSTOP);
  ASSERT_GE(run.WaitForLine("node 'ego' … signal 19", 5s), 0ms);
  std::this_thread::sleep_for(2s);  // longer than any limit of silence
  const Ended state = RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"});
  EXPECT_EQ(state.status, 0) << state.out;
  EXPECT_THAT(state.out, HasLine("it stands: node 'ego' … signal 19")) << "the end of the chain of waiting is named";
  ::kill(ego, SIGCONT);
  ASSERT_TRUE(WaitForStep(run_name, StepIn(state.out) + 1000)) << "it goes on";
  // Dead, it needs a person's word.
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  ASSERT_GE(run.WaitForLine("node 'traffic' … signal 9", 5s), 0ms);
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
  Started run({Bin("rodeira"), "run", launch.string(), "--run", run_name, "--for", "8", "--pace", "real", "--record",
               File("pace.mcap")});
  ASSERT_TRUE(WaitForStep(run_name, 3000));
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
  ASSERT_GE(run.WaitForLine("node 'ego' … signal 9", 5s), 0ms);
  ASSERT_TRUE(Runs(run_name)) << "it goes on";
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasLine("again   node 'ego' … signal 9"));
  EXPECT_THAT(ended.out, HasLine("node 'traffic' … signal 9"));
}

// A dead node need not be restarted only to be able to stop.
TEST_F(Recovery, ARunThatWaitsForADeadNodeCanBeStopped) {
  const std::string run_name = "recovery-stop-" + std::to_string(::getpid());
  Started run(Command(run_name, File("stop.mcap"), "60", "pause"));
  ASSERT_TRUE(Runs(run_name));
  const pid_t traffic = Find(run_name, "traffic");
  ASSERT_GT(traffic, 0);
  ::kill(traffic, SIGKILL);
  ASSERT_GE(run.WaitForLine("node 'traffic' … signal 9", 5s), 0ms);
  const Ended state = RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "state"});
  EXPECT_THAT(state.out, HasLine("it stands: node 'traffic' … signal 9"));
  (void)RunCommand({Bin("rodeira"), "ctl", "--run", run_name, "stop"});
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasLine("stopped while the run waited: node 'traffic' … signal 9"));
  const Ended info = RunCommand({Bin("rodeira"), "info", File("stop.mcap")});
  EXPECT_THAT(info.out, HasLine("no gaps … cancelled at step "));
}

TEST_F(Recovery, RepeatedCrashWithoutProgressEndsRun) {
  const std::string run_name = "recovery-loop-" + std::to_string(::getpid());
  Started run(Command(run_name, File("loop.mcap"), "1000", "restart"));
  ASSERT_TRUE(Runs(run_name));
  for (int life = 0; life < 4; ++life) {
    const pid_t ego = Find(run_name, "ego");
    ASSERT_GT(ego, 0) << life;
    ::kill(ego, SIGKILL);
    for (int i = 0; i < 400 && ::kill(ego, 0) == 0; ++i) ::usleep(5000);
  }
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasLine("node 'ego' … lost 4 times"));
  EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
}

// Its next incarnation computes other samples than those it has published: the node that kept them notices, and the
// restarted node is named.
TEST_F(Recovery, ANodeThatReadsAClockIsDetectedWhenItIsRestarted) {
  const auto launch = folder_.Write(
      "broken.yaml",
      "rodeira: launch/1\nrecovery: restart\nnodes:\n  a: {kind: empty}\n  b: {kind: empty, config: {broken: clock}}\n"
      "  recorder: {kind: recorder}\n");
  const std::string run_name = "recovery-broken-" + std::to_string(::getpid());
  Started run({Bin("rodeira"), "run", launch.string(), "--run", run_name, "--for", "60", "--pace", "real", "--record",
               File("broken.mcap")});
  ASSERT_TRUE(WaitForStep(run_name, 1500));
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
