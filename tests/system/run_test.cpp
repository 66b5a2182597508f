// SPDX-License-Identifier: Apache-2.0
// Runs of separate processes: the same digests every time, however they are started and whatever else the machine does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>

#include "tests/names.hpp"

#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

std::set<std::string> SharedMemory() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    names.insert(entry.path().filename().string());
  return names;
}

TEST(Run, TheSameDigestAtEveryRunUnderLoadOverUdpAndInOneProcess) {
  const auto first = RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record"});
  ASSERT_EQ(first.status, 0) << first.out;
  const std::string digest = DigestIn(first.out);
  ASSERT_EQ(digest.size(), 16u) << first.out;
  EXPECT_NE(first.out.find("faults  none"), std::string::npos);

  std::atomic<bool> busy = true;
  std::thread load([&busy] {
    while (busy) {
    }
  });
  EXPECT_EQ(DigestIn(RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record"}).out), digest);
  busy = false;
  load.join();
  EXPECT_EQ(DigestIn(RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--in-process"}).out),
            digest);
  EXPECT_EQ(
      DigestIn(
          RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--set", "transport=udp"}).out),
      digest);
  EXPECT_NE(DigestIn(RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--seed", "2"}).out),
            digest);
}

TEST(Run, ANodeThatCannotSaveItsStateSaysSo) {
  const std::vector<std::string> command{Bin("rodeira"), "run",   LaunchFile("empty.yaml"),    "--no-record", "--for",
                                         "0.5",          "--set", "nodes.c.config.saves=false"};
  const auto processes = RunCommand(command);
  EXPECT_EQ(processes.status, 0) << processes.out;
  EXPECT_NE(processes.out.find(
                "state   node 'c' cannot save its state: replayed from the first step, and not to be started again\n"),
            std::string::npos)
      << processes.out;
  EXPECT_EQ(processes.out.find("node 'b' cannot"), std::string::npos) << processes.out;
  auto in_process = command;
  in_process.push_back("--in-process");
  const auto one = RunCommand(in_process);
  EXPECT_NE(one.out.find("state   node 'c' cannot save its state"), std::string::npos) << one.out;
  EXPECT_EQ(DigestIn(one.out), DigestIn(processes.out));
}

TEST(Run, RealPaceTakesRealTime) {
  // Not a measurement: a bound from below, which load can only raise.
  const auto begin = std::chrono::steady_clock::now();
  const auto run =
      RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "0.5", "--pace", "real"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 500ms);
}

// A program that executes itself anew is named after /proc/self/exe.
TEST(Run, NoProcessOfItIsStartedTwice) {
  Started run({"GLIBC_TUNABLES=", Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--run",
               "started-once", "--pace", "real", "--for", "1000"});
  ASSERT_TRUE(Runs("started-once"));
  const auto name_of = [](pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
    std::string text;
    std::getline(file, text);
    return text;
  };
  EXPECT_EQ(name_of(run.pid()), "rodeira");
  EXPECT_EQ(name_of(ProcessWith("--run started-once", "--node a")), "rodeira-empty");
  ::kill(run.pid(), SIGINT);
  EXPECT_EQ(run.Wait().status, 0);
}

TEST(Run, CtrlCStopsAllNodesAtTheSameStepAndIsNoFault) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "1000", "--pace", "real",
               "--run", "ctrlc"});
  ASSERT_TRUE(Runs("ctrlc"));
  ::kill(run.pid(), SIGINT);
  const Ended ended = run.Wait(10s);
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run ctrlc").empty());
}

TEST(Run, LeavesNothingInSharedMemoryAndNoProcess) {
  const auto before = SharedMemory();
  ASSERT_EQ(
      RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "0.1", "--run", "tidy"})
          .status,
      0);
  auto left = SharedMemory();  // what others leave or clear away meanwhile is theirs
  for (const auto& name : before) left.erase(name);
  EXPECT_EQ(left, std::set<std::string>());
  EXPECT_TRUE(ProcessesWith("--run tidy").empty());
}

TEST(Run, WhereRodeiraItselfIsKilledNoProcessIsLeftWithinTwoSeconds) {
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "1000", "--pace", "real",
               "--run", "killed-front-door"});
  ASSERT_TRUE(Runs("killed-front-door"));
  ASSERT_EQ(ProcessesWith("--run killed-front-door", "/rodeira-").size(), 5u);
  ::kill(run.pid(), SIGKILL);
  const auto limit = std::chrono::steady_clock::now() + 2s;
  const auto left = [] { return ProcessesWith("--run killed-front-door", "/rodeira-").size(); };
  while (left() > 0 && std::chrono::steady_clock::now() < limit) ::usleep(5000);
  EXPECT_EQ(left(), 0u);
}

TEST(Run, WrongInputIsOneSentenceAndStatusTwo) {
  const auto refuses = [](const std::vector<std::string>& arguments, const std::string& text) {
    std::vector<std::string> command{Bin("rodeira"), "run", "--no-record"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Ended ended = RunCommand(command);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.out, HasLine(text));
  };
  refuses({"/no/such.yaml"}, "/no/such.yaml: there is no such file");
  refuses({LaunchFile("empty.yaml"), "--set", "nodes.a.kind=emtpy"},
          "'nodes.a.kind' is 'emtpy'; did you mean 'empty'?");
  refuses({LaunchFile("empty.yaml"), "--set", "nodes.a.config.fail_at_stp=3"},
          "unknown key 'nodes.a.config.fail_at_stp'; did you mean 'fail_at_step'?");
  refuses({LaunchFile("empty.yaml"), "--pace", "fast"}, "--pace: 'fast' … max, real");
  refuses({LaunchFile("empty.yaml"), "--for", "-3"}, "--for: '-3' … a positive number");
  refuses({LaunchFile("empty.yaml"), "--set", "seed"}, "KEY=VALUE was expected");
}

}  // namespace
}  // namespace rodeira::system_test
