// SPDX-License-Identifier: Apache-2.0
// SIGTERM to a part of a run (kill, systemd, a PC that shuts down), and signals to `rodeira run` in every state.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

class Terminated : public ::testing::TestWithParam<const char*> {
 protected:
  std::string Name() const { return fmt::format("terminated-{}", ::getpid()); }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> Command(std::vector<std::string> more) const {
    std::vector<std::string> command{Bin("rodeira"), "run",           LaunchFile("first_drive.yaml"), "--run", Name(),
                                     "--record",     File("run.mcap")};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  pid_t Part(const std::string& node) const {
    const auto found = ProcessesWith("--run " + Name(), node == "clock" ? "/rodeira-clock" : "--node " + node);
    return found.size() == 1 ? found.front() : -1;
  }
  // The last step of the closing table is the last one in the file.
  void ExpectTheFileHoldsWhatTheTableSays(const std::string& table) const {
    const Ended info = RunCommand({Bin("rodeira"), "info", File("run.mcap")});
    EXPECT_EQ(info.status, 0) << info.out;
    EXPECT_EQ(info.out.find("incomplete"), std::string::npos) << info.out;
    if (table.find("audit   lossless") == std::string::npos) return;
    EXPECT_EQ(RunCommand({Bin("rodeira"), "replay", File("run.mcap"), "--verify"}).status, 0) << table;
  }
  const cli::TemporaryFolder folder_;
};

class EveryPart : public Terminated {};

TEST_P(EveryPart, IsNamedWithinASecondAndTheRunEnds) {
  const std::string part = GetParam();
  Started run(Command({"--pace", "real", "--for", "100"}));
  ASSERT_TRUE(Runs(Name()));
  ::kill(Part(part), SIGTERM);
  const auto took = run.WaitFor("node '" + part + "' was told to end by signal 15 (Terminated) at about step ", 10s);
  EXPECT_GE(took, 0ms);
  EXPECT_LE(took, 1000ms);
  const Ended ended = run.Wait(10s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + Name()).empty());
  ExpectTheFileHoldsWhatTheTableSays(ended.out);
}

INSTANTIATE_TEST_SUITE_P(OfFirstDrive, EveryPart, ::testing::Values("road", "driver", "ego", "recorder"),
                         [](const auto& one) { return std::string(one.param); });

class FrontDoor : public ::testing::TestWithParam<int> {
 protected:
  std::string Name() const { return fmt::format("door-{}", ::getpid()); }
  void ExpectItsEnd(Started& run) const {
    ::kill(run.pid(), GetParam());
    const auto begin = std::chrono::steady_clock::now();
    ended_ = run.Wait(20s);
    EXPECT_LE(std::chrono::steady_clock::now() - begin, 2s) << ended_.out;
    EXPECT_TRUE(ProcessesWith("--run " + Name()).empty());
  }
  mutable Ended ended_;
};

TEST_P(FrontDoor, ARunThatDrivesEndsInOrder) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--pace", "real", "--for", "100",
               "--run", Name()});
  ASSERT_TRUE(Runs(Name()));
  ExpectItsEnd(run);
  EXPECT_EQ(ended_.status, 0) << ended_.out;
}

TEST_P(FrontDoor, ARunWithANodeThatHangsEndsWithItsName) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--pace", "real", "--for", "100",
               "--run", Name(), "--set", "nodes.b.config.hang_at_step=200", "--set", "nodes.b.deadline_s=60"});
  std::string state;
  const auto until = std::chrono::steady_clock::now() + 30s;
  while (state.find("'b' computes step 200") == std::string::npos && std::chrono::steady_clock::now() < until)
    state = RunCommand({Bin("rodeira"), "ctl", "state", "--run", Name()}).out;
  ASSERT_NE(state.find("'b' computes step 200"), std::string::npos) << state;
  ExpectItsEnd(run);
  EXPECT_EQ(ended_.status, 1) << ended_.out;
  EXPECT_THAT(ended_.out, HasLine("stopped by a signal … 'a', 'b', 'c', 'd'"));
}

TEST(SecondStart, IsRefusedAndTheFirstRunGoesOn) {
  const std::string name = fmt::format("twice-{}", ::getpid());
  const std::vector<std::string> command{
      Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--pace", "real", "--for", "3", "--run", name};
  Started first(command);
  ASSERT_TRUE(Runs(name));
  for (int i = 0; i < 2; ++i) {
    const Ended second = RunCommand(command);
    EXPECT_EQ(second.status, 2) << second.out;
    EXPECT_NE(second.out.find("run '" + name + "' is going on already on this PC"), std::string::npos) << second.out;
  }
  const Ended ended = first.Wait(20s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << ended.out;
}

TEST_P(FrontDoor, ARunThatStartsEnds) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "100", "--run", Name()});
  for (int i = 0; i < 400 && ProcessesWith("--run " + Name(), "/rodeira-").empty(); ++i) ::usleep(5000);
  ExpectItsEnd(run);
  EXPECT_NE(ended_.status, 2) << ended_.out;
}

TEST_P(FrontDoor, ARunOfOneProcessEnds) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--pace", "real", "--for", "100",
               "--in-process", "--run", Name()});
  ASSERT_TRUE(Runs(Name()));
  ExpectItsEnd(run);
  EXPECT_EQ(ended_.status, 0) << ended_.out;
}

TEST_P(FrontDoor, ARunOfOneProcessWithANodeThatHangsEnds) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "100", "--in-process", "--run",
               Name(), "--set", "nodes.b.config.hang_at_step=200"});
  ASSERT_GE(run.WaitFor("told to hang here", 30s), 0ms);
  ExpectItsEnd(run);
  EXPECT_EQ(ended_.status, 1) << ended_.out;
  EXPECT_NE(ended_.out.find("stopped by a signal before all nodes had finished"), std::string::npos) << ended_.out;
}

// Three nodes have finished, 'b' hangs at the last step.
class FinishedNodes : public ::testing::Test {
 protected:
  FinishedNodes()
      : name_(fmt::format("finished-{}", ::getpid())),
        run_({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "0.2", "--run", name_, "--set",
              "nodes.b.config.hang_at_step=200", "--set", "nodes.b.deadline_s=60"}) {}
  // Asks until 'b' hangs for so long.
  bool Hangs(double wanted_s) const {
    const std::string text = "is ending at step 200 (0.200 s)", hangs = "'b' computes step 200 since ";
    const auto until = std::chrono::steady_clock::now() + 40s;
    while (std::chrono::steady_clock::now() < until) {
      const std::string state = RunCommand({Bin("rodeira"), "ctl", "state", "--run", name_}).out;
      const auto since = state.find(hangs);
      if (state.starts_with(text) && since != std::string::npos &&
          std::stod(state.substr(since + hangs.size())) >= wanted_s)
        return true;
    }
    return false;
  }
  const std::string name_;
  Started run_;
};

TEST_F(FinishedNodes, EndWithTheFrontDoor) {
  ASSERT_TRUE(Hangs(0.5)) << "and the others have had the time to finish";
  ::kill(run_.pid(), SIGTERM);
  const auto begin = std::chrono::steady_clock::now();
  const Ended ended = run_.Wait(20s);
  EXPECT_LE(std::chrono::steady_clock::now() - begin, 2s) << ended.out;
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("stopped by a signal before these nodes had finished: 'b'"), std::string::npos) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + name_).empty());
}

INSTANTIATE_TEST_SUITE_P(ByASignal, FrontDoor, ::testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& one) { return std::string(::sigabbrev_np(one.param)); });

// Found while the node reads its input: wrong input as any other.
TEST(WrongInputAtTheStart, IsStatusTwo) {
  for (const char* process : {"--quiet", "--in-process"}) {
    const cli::TemporaryFolder folder;
    const std::string recording = (folder.path() / "a.mcap").string();
    const Ended ended = RunCommand({Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "1", "--record",
                                    recording, process, "--set", "world=" + SourceDir() + "/configs/worlds/n222.yaml",
                                    "--set", "nodes.ego.config.start={x_m: 0, y_m: 1e6}"});
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_NE(ended.out.find("outside of the world"), std::string::npos) << ended.out;
    EXPECT_FALSE(std::filesystem::exists(recording));
    EXPECT_EQ(ended.out.find("wrote "), std::string::npos) << "a recording that is not there: " << ended.out;
  }
}

}  // namespace
}  // namespace rodeira::system_test
