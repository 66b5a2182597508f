// SPDX-License-Identifier: Apache-2.0
// Nodes that share processes (key `process`): the bits of separate processes, also after the loss of a process.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/setting.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;

// Words that put each node into the process of this name.
Words InProcesses(const std::map<std::string, std::string>& process_of) {
  Words words;
  for (const auto& [node, process] : process_of) {
    words.insert(words.end(), {"--set", fmt::format("nodes.{}.process={}", node, process)});
  }
  return words;
}

class SharedProcesses : public testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  Words Command(const std::string& launch, const std::string& name, const std::string& seconds,
                const Words& more) const {
    Words command{
        Bin("rodeira"),       "run",   launch, "--headless", "--run", name + std::to_string(::getpid()), "--record",
        File(name + ".mcap"), "--for", seconds};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  // The undisturbed run of separate processes.
  void Separate(const std::string& launch, const std::string& seconds, const Words& more) {
    const Ended ended = RunCommand(Command(launch, "separate", seconds, more));
    ASSERT_EQ(ended.status, 0) << ended.out;
    digest_ = DigestIn(ended.out);
    samples_ = SamplesOf(File("separate.mcap"));
    ASSERT_GT(samples_.size(), 100u);
  }
  void ExpectTheSame(const Ended& ended, const std::string& name) const {
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest_) << ended.out;
    EXPECT_EQ(FirstDifference(samples_, SamplesOf(File(name + ".mcap"))), "") << ended.out;
    const Ended verified = RunCommand({Bin("rodeira"), "replay", File(name + ".mcap"), "--verify"});
    EXPECT_EQ(verified.status, 0) << verified.out;
  }

  const cli::TemporaryFolder folder_;
  std::string digest_;
  std::vector<Recorded> samples_;
};

struct Drawn {
  std::string launch, seconds;
  Words nodes, more;
};

class InGroups : public SharedProcesses, public testing::WithParamInterface<Drawn> {};

void PrintTo(const Drawn& drawn, std::ostream* out) { *out << drawn.launch; }

// RODEIRA_GROUPINGS says how many (2), RODEIRA_GROUPINGS_SEED draws others (1).
TEST_P(InGroups, DrawnAtRandomARunHasTheBitsOfSeparateProcesses) {
  const auto& [file, seconds, nodes, more] = GetParam();
  const auto seed = static_cast<unsigned>(Setting("RODEIRA_GROUPINGS_SEED", 1));
  SCOPED_TRACE("RODEIRA_GROUPINGS_SEED=" + std::to_string(seed));
  std::mt19937 rng(seed);
  Separate(LaunchFile(file), seconds, more);
  if (HasFatalFailure()) return;
  for (std::uint64_t i = 0; i < Setting("RODEIRA_GROUPINGS", 2); ++i) {
    std::map<std::string, std::string> groups;  // the first grouping has all nodes in one process
    std::string story;
    for (const std::string& node : nodes) {
      const auto drawn = i == 0 ? 1 : rng() % 3;
      if (drawn > 0) groups[node] = "p" + std::to_string(drawn);
      story += fmt::format("{}: {}, ", node, drawn);
    }
    SCOPED_TRACE(story);
    Words words = more;
    for (const std::string& word : InProcesses(groups)) words.push_back(word);
    const std::string name = "grouped" + std::to_string(i);
    ExpectTheSame(RunCommand(Command(LaunchFile(file), name, seconds, words)), name);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(
    LaunchFiles, InGroups,
    testing::Values(Drawn{"first_drive.yaml", "3", {"road", "driver", "ego", "recorder"}, {}},
                    Drawn{"demo.yaml",
                          "2",
                          {"road", "driver", "ego", "traffic", "recorder", "view"},
                          {"--set", "nodes.view.config.quality=low", "--set", "nodes.view.config.width_px=160", "--set",
                           "nodes.view.config.height_px=96", "--set", "nodes.view.config.frames.times_s=[1]"}},
                    Drawn{"scripted.yaml", "2", {"road", "driver", "ego", "traffic", "story", "recorder"}, {}}),
    [](const auto& drawn) { return std::filesystem::path(drawn.param.launch).stem().string(); });

// A part that ends ends the other nodes of its process; all of them are started again and come to the same bits.
TEST_F(SharedProcesses, AKilledProcessIsStartedAgainAndTheRunComesToTheSameBits) {
  const std::string launch = LaunchFile("first_drive.yaml");
  Separate(launch, "8", {});
  if (HasFatalFailure()) return;
  const std::vector<std::map<std::string, std::string>> groupings{
      {{"driver", "cars"}, {"ego", "cars"}}, {{"road", "all"}, {"driver", "all"}, {"ego", "all"}, {"recorder", "all"}}};
  for (const auto& groups : groupings) {
    const std::string process = groups.begin()->second, name = "killed-" + process;
    Words words{"--pace", "2", "--set", "recovery=restart"};
    for (const std::string& word : InProcesses(groups)) words.push_back(word);
    Started run(Command(launch, name, "8", words));
    ASSERT_TRUE(Runs(name + std::to_string(::getpid())));
    pid_t before = -1;
    for (const int signal : {SIGKILL, SIGSTOP}) {
      WaitForGrowth(File(name + ".mcap"));
      const pid_t victim = ProcessWith("--run " + name + std::to_string(::getpid()), "--process " + process, before);
      ASSERT_GT(victim, 0);
      ::kill(victim, signal);
      ASSERT_GE(run.WaitFor(signal == SIGKILL ? "was killed by signal 9" : "was stopped by signal 19", 10s), 0ms);
      before = victim;
    }
    const Ended ended = run.Wait(90s);
    ExpectTheSame(ended, name);
    EXPECT_THAT(ended.out, Names(fmt::format("again … '{}' … process '{}' … signal 9",
                                             process == "cars" ? "driver" : "road", process)));
  }
}

// Without a policy the run ends, and its message has the node that crashed and its process.
TEST_F(SharedProcesses, ACrashNamesTheNodeAndItsProcess) {
  const std::string launch =
      folder_
          .Write("four.yaml",
                 "rodeira: launch/1\nduration_s: 1\nnodes: {a: {kind: empty, process: p}, b: {kind: empty, process: p},"
                 " c: {kind: empty}, recorder: {kind: recorder, process: p}}\n")
          .string();
  const Ended calm = RunCommand(Command(launch, "calm", "1", {}));
  ASSERT_EQ(calm.status, 0) << calm.out;
  for (const std::string policy : {"stop", "restart"}) {
    const Ended ended = RunCommand(
        Command(launch, policy, "1",
                {"--set", "recovery=" + policy, "--set", "nodes.b.config.end_at_step=200", "--set",
                 "nodes.b.config.end_by=assertion", "--set", "nodes.b.config.end_once=" + File(policy + ".once")}));
    EXPECT_THAT(ended.out, Names("node 'b' … process 'p' … signal 6 (Aborted)"));
    EXPECT_EQ(ended.status, policy == "stop" ? 1 : 0) << ended.out;
    if (policy == "restart") {
      EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << ended.out;
      EXPECT_EQ(FirstDifference(SamplesOf(File("calm.mcap")), SamplesOf(File(policy + ".mcap"))), "");
    }
  }
}

// What one of them says of its own end is its own, and the others end with the run.
TEST_F(SharedProcesses, ANodeThatFailsIsNamedAndEndsTheRun) {
  const Ended ended =
      RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--run",
                  "fails" + std::to_string(::getpid()), "--set", "nodes.a.process=p", "--set", "nodes.b.process=p",
                  "--set", "nodes.b.config.end_at_step=200", "--set", "nodes.b.config.end_by=failure"});
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("node 'b' failed at step 200: told to fail here"), std::string::npos) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run fails" + std::to_string(::getpid())).empty());
}

TEST_F(SharedProcesses, WrongInputOfOneNodeIsRefused) {
  const Ended ended = RunCommand(Command(LaunchFile("first_drive.yaml"), "refused", "1",
                                         {"--set", "nodes.driver.process=p", "--set", "nodes.ego.process=p", "--set",
                                          "nodes.ego.config.vehicle=no_such_file.yaml"}));
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(ended.out.find("no_such_file.yaml"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rodeira::system_test
