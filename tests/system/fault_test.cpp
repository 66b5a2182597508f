// SPDX-License-Identifier: Apache-2.0
// A node that is killed, hangs, is stopped or is not of the run: time stops, the node is named, the status is 1 or 2.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// Runs at real pace, sends `signal` to one process once the run drives, and expects its name within a second.
void ExpectNamed(const std::string& node, int signal, const std::string& expected) {
  const std::string run_name = "fault-" + node + std::to_string(signal);
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "1000", "--pace", "real",
               "--run", run_name});
  ASSERT_TRUE(Runs(run_name));
  const auto victims = ProcessesWith("--run " + run_name, node == "clock" ? "/rodeira-clock" : "--node " + node);
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], signal);
  const auto took = run.WaitForLine(expected, 5s);
  EXPECT_GE(took, 0ms) << node;
  EXPECT_LE(took, 1000ms) << node;
  const Ended ended = run.Wait(10s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());
}

TEST(Fault, AKilledNodeIsNamedWithinASecond) { ExpectNamed("b", SIGKILL, "node 'b' was killed by signal 9"); }
TEST(Fault, AStoppedNodeIsNamedWithinASecond) { ExpectNamed("c", SIGSTOP, "node 'c' was stopped by signal 19"); }
TEST(Fault, AKilledClockIsNamedWithinASecond) { ExpectNamed("clock", SIGKILL, "the clock … signal 9"); }
TEST(Fault, AStoppedClockIsNamedWithinASecond) { ExpectNamed("clock", SIGSTOP, "the clock … signal 19"); }

TEST(Fault, AHangingNodeIsNamedByItsDeadline) {
  Started run(
      {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--set", "nodes.b.config.hang_at_step=200"});
  EXPECT_GE(run.WaitForLine("node 'b' … computing step 200 … limits.step_s", 10s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
}

// Its step holds the thread that receives: it is no silence of the clock, however long it takes.
TEST(Fault, AHangingNodeIsNamedByADeadlineThatIsLongerThanTheClocksSilence) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--set", "limits.step_s=4.5", "--set",
               "nodes.b.config.hang_at_step=200"});
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.out, HasLine("node 'b' … computing step 200 … limits.step_s"));
  EXPECT_EQ(ended.out.find("the clock has sent nothing"), std::string::npos) << ended.out;
}

TEST(Fault, AHangingServerIsNamedByItsDeadline) {
  const auto part = [](const std::string& program, const std::string& node) {
    std::vector<std::string> words{"HANG_AT_REQUEST=500",
                                   Bin(program),
                                   "--launch",
                                   LaunchFile("first_drive.yaml"),
                                   "--run",
                                   "hanging-server",
                                   "--set",
                                   "nodes.recorder.kind=none",
                                   "--set",
                                   "nodes.ego.config.ground=remote"};
    if (!node.empty()) words.insert(words.end(), {"--node", node});
    return words;
  };
  Started road(part("rodeira-test-hanging-road", "road"));
  Started driver(part("rodeira-input", "driver"));
  Started ego(part("rodeira-vehicle", "ego"));
  const Ended ended = Started(part("rodeira-clock", "")).Wait(30s);
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.out, HasLine("node 'road' … request … limits.step_s"));
  const Ended server = road.Wait(30s);
  EXPECT_EQ(server.status, 1) << server.out;
  EXPECT_NE(server.out.find("node 'road' hangs 3 s after it was told to end"), std::string::npos) << server.out;
}

// Its step holds the thread that receives, and nothing else ends its process.
class HangingByHand : public ::testing::Test {
 protected:
  HangingByHand() {
    for (const char* node : {"a", "b", "c", "d"}) nodes_.push_back(std::make_unique<Started>(Part("empty", node)));
  }
  static std::vector<std::string> Part(const std::string& kind, const std::string& node) {
    std::vector<std::string> words{Bin("rodeira-" + kind),
                                   "--launch",
                                   LaunchFile("empty.yaml"),
                                   "--run",
                                   fmt::format("hanging-{}", ::getpid()),
                                   "--set",
                                   "nodes.b.config.hang_at_step=200",
                                   "--set",
                                   "limits.step_s=4"};
    if (!node.empty()) words.insert(words.end(), {"--node", node});
    return words;
  }
  void ExpectEndOfTheHangingNode(const std::string& reason) {
    const Ended ended = nodes_[1]->Wait(40s);
    EXPECT_EQ(ended.status, 1) << ended.out;
    EXPECT_NE(ended.out.find("node 'b' hangs 3 s after it was told to end ("), std::string::npos) << ended.out;
    EXPECT_THAT(ended.out, HasLine(reason));
  }
  std::vector<std::unique_ptr<Started>> nodes_;
};

TEST_F(HangingByHand, ANodeHearsThatItsRunIsAborted) {
  const Ended ended = Started(Part("clock", "")).Wait(30s);
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.out, HasLine("node 'b' … computing step 200 … limits.step_s"));
  ExpectEndOfTheHangingNode("node 'b' … computing step 200 … limits.step_s");
}

TEST_F(HangingByHand, ANodeMissesAClockThatIsGone) {
  Started clock(Part("clock", ""));
  ASSERT_GE(nodes_[1]->WaitFor("told to hang here", 30s), 0ms);
  ::kill(clock.pid(), SIGKILL);
  ExpectEndOfTheHangingNode("the clock has sent nothing for 3.0 s");
}

TEST(Fault, AFailingNodeIsNamedWithItsReason) {
  const Ended ended = RunCommand(
      {Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--set", "nodes.d.config.fail_at_step=300"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.out.find("node 'd' failed at step 300: told to fail here"), std::string::npos) << ended.out;
}

// Without a parent that sees processes die, the clock's own watch names the silent node.
TEST(Fault, TheClockItselfNotesASilentNode) {
  std::vector<std::unique_ptr<Started>> nodes;
  for (const char* node : {"a", "b", "c", "d"}) {
    nodes.push_back(std::make_unique<Started>(std::vector<std::string>{
        Bin("rodeira-empty"), "--launch", LaunchFile("empty.yaml"), "--run", "silent", "--node", node}));
  }
  Started clock({Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", "silent", "--pace", "real",
                 "--for", "1000"});
  ASSERT_GE(clock.WaitFor("progress", 10s), 0ms);
  ::kill(nodes[1]->pid(), SIGKILL);
  const auto took = clock.WaitFor("fault node 'b' has sent nothing for", 5s);
  EXPECT_GE(took, 0ms);
  EXPECT_LE(took, 1000ms);
  EXPECT_EQ(clock.Wait(10s).status, 1);
  EXPECT_EQ(nodes[0]->Wait(5s).status, 1);
}

TEST(Fault, ASecondClockIsRefused) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "1000", "--pace", "real",
               "--run", "two-clocks", "--domain", "7"});
  ASSERT_TRUE(Runs("two-clocks"));
  const Ended second =
      RunCommand({Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", "two-clocks", "--domain", "7"});
  EXPECT_EQ(second.status, 2) << second.out;
  EXPECT_NE(second.out.find("run 'two-clocks' in domain 7 has a clock already"), std::string::npos) << second.out;
  ::kill(run.pid(), SIGINT);
  EXPECT_EQ(run.Wait(10s).status, 0) << "and the first run did not mind";
}

// Tests that run at the same time have runs of their own.
std::string RefusedRun() { return "refused-" + std::to_string(::getpid()); }

// A process of another build, machine or launch file is refused, with both values.
void ExpectRefused(const std::string& environment, const std::vector<std::string>& more, const std::string& what) {
  Started clock({Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", RefusedRun()});
  std::vector<std::string> command{Bin(environment.empty() ? "rodeira-empty" : "rodeira-test-pretends"),
                                   "--launch",
                                   LaunchFile("empty.yaml"),
                                   "--run",
                                   RefusedRun(),
                                   "--node",
                                   "a"};
  if (!environment.empty()) command.insert(command.begin(), environment);
  command.insert(command.end(), more.begin(), more.end());
  Started node(command);
  const Ended ended = clock.Wait(20s);
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(ended.out.find("was refused: its " + what + " is "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("the clock's is "), std::string::npos) << ended.out;
}

TEST(Fault, AnotherTypeOfAUsedTopicIsRefused) {
  Started clock({Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", RefusedRun()});
  Started node({"PRETEND_TYPE=rodeira/pulse|unsigned long long value|double value", Bin("rodeira-test-pretends"),
                "--launch", LaunchFile("empty.yaml"), "--run", RefusedRun(), "--node", "a"});
  const Ended ended = clock.Wait(20s);
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_THAT(ended.out, HasLine("node 'a' (process … refused … rodeira/pulse … rodeira::msg::Pulse, member 2: … "
                                 "'double value' … 'unsigned long long value'"));
}

TEST(Fault, ANodeWithAnotherUnusedTopicTakesPart) {
  std::vector<std::unique_ptr<Started>> nodes;
  for (const char* node : {"a", "b", "c", "d"}) {
    nodes.push_back(std::make_unique<Started>(std::vector<std::string>{
        "PRETEND_TYPE=rodeira/controls|double throttle|float throttle", Bin("rodeira-test-pretends"), "--launch",
        LaunchFile("empty.yaml"), "--run", "unused", "--node", node}));
  }
  Started clock({Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", "unused", "--for", "0.5"});
  const Ended ended = clock.Wait(20s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  for (const auto& node : nodes) EXPECT_EQ(node->Wait(5s).status, 0);
}

TEST(Fault, OtherMathematicsAreRefused) { ExpectRefused("PRETEND_MATHEMATICS=9", {}, "mathematics hash"); }
TEST(Fault, AnotherRosterIsRefused) { ExpectRefused("", {"--set", "nodes.b.period_s=0.002"}, "roster hash"); }

// Two PCs with the same launch file and other world files: the road server and the traffic each load their own.
TEST(Fault, AnotherWorldIsRefused) {
  const std::string source(SourceDir());
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("rodeira-worlds-{}", ::getpid());
  std::string world = base::ReadText(source + "/tests/data/straight.yaml").value();
  const std::string vehicle = source + "/configs/vehicles/default.yaml";
  const std::string launch =
      "rodeira: launch/1\nworld: world.yaml\nnodes:\n  road: {kind: road}\n  driver: {kind: input, config: {source: "
      "script, script: " +
      source + "/tests/data/standing.csv}}\n  ego: {kind: vehicle, config: {vehicle: " + vehicle +
      "}}\n  traffic: {kind: traffic, config: {vehicles: 2}}\n";
  for (const char* pc : {"one", "two"}) {
    std::filesystem::create_directories(folder / pc);
    ASSERT_TRUE(base::WriteWhole(folder / pc / "launch.yaml", std::string_view(launch)).ok());
    ASSERT_TRUE(base::WriteWhole(folder / pc / "world.yaml", std::string_view(world)).ok());
    const auto fall = world.find("fall: 0.025");
    if (fall != std::string::npos) world.replace(fall, 11, "fall: 0.026");
  }
  const auto command = [&](const std::string& program, const std::string& pc, std::vector<std::string> more) {
    std::vector<std::string> words{Bin(program), "--launch", (folder / pc / "launch.yaml").string(), "--run", "worlds"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  Started clock(command("rodeira-clock", "one", {}));
  Started road(command("rodeira-road", "one", {"--node", "road"}));
  Started traffic(command("rodeira-traffic", "two", {"--node", "traffic"}));
  const Ended ended = clock.Wait(30s);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(ended.out.find("was refused: its world hash is "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("both need the same world files"), std::string::npos) << ended.out;
}

TEST(Fault, MissingNodesAreNamed) {
  Started clock(
      {Bin("rodeira-clock"), "--launch", LaunchFile("empty.yaml"), "--run", "lonely", "--set", "limits.start_s=1"});
  Started node({Bin("rodeira-empty"), "--launch", LaunchFile("empty.yaml"), "--run", "lonely", "--set",
                "limits.start_s=1", "--node", "a"});
  const Ended ended = clock.Wait(20s);
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.out, HasLine("1 s … missing: 'a' … 'b' (no message … 'c' (no message … 'd' (no message"));
}

}  // namespace
}  // namespace rodeira::system_test
