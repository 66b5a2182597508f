// SPDX-License-Identifier: Apache-2.0
// `rodeira run` is killed: no process of its run exists two seconds later, whatever the run was doing.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

class KilledFrontDoor : public ::testing::Test {
 protected:
  std::string Name() const { return fmt::format("orphans-{}", ::getpid()); }
  std::vector<std::string> Command(const std::vector<std::string>& settings) const {
    std::vector<std::string> command{
        Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--pace", "real", "--for", "1000",
        "--run",        Name()};
    for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
    return command;
  }
  pid_t Part(const std::string& text) const {
    const auto found = ProcessesWith("--run " + Name(), text);
    return found.size() == 1 ? found.front() : -1;
  }
  void ExpectNoProcessAfterItsDeath(const Started& run) const {
    ::kill(run.pid(), SIGKILL);
    const auto until = std::chrono::steady_clock::now() + 2s;
    while (!ProcessesWith("--run " + Name()).empty() && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(10ms);
    for (const pid_t left : ProcessesWith("--run " + Name())) {
      ADD_FAILURE() << "process " << left << " lives";
      ::kill(left, SIGKILL);
    }
  }
};

TEST_F(KilledFrontDoor, WhileANodeLoads) {
  Started run(Command({"nodes.b.config.initialise_s=100"}));
  ASSERT_GE(run.WaitFor("told to compute here", 30s), 0ms);
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, WhileItRuns) {
  Started run(Command({}));
  ASSERT_TRUE(Runs(Name()));
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, WhileItIsPaused) {
  Started run(Command({}));
  ASSERT_TRUE(Runs(Name()));
  ASSERT_EQ(RunCommand({Bin("rodeira"), "ctl", "pause", "--run", Name()}).status, 0);
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, WhileANodeHangs) {
  Started run(Command({"nodes.b.config.hang_at_step=200", "nodes.b.deadline_s=600"}));
  ASSERT_GE(run.WaitFor("told to hang here", 30s), 0ms);
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, WhileItWaitsForAStoppedNode) {
  Started run(Command({"recovery=pause"}));
  ASSERT_TRUE(Runs(Name()));
  ::kill(Part("--node b"), SIGSTOP);
  ASSERT_GE(run.WaitFor("the run waits", 30s), 0ms);
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, WhileItWaitsForANodeThatWasTerminated) {
  Started run(Command({"recovery=pause"}));
  ASSERT_TRUE(Runs(Name()));
  ::kill(Part("--node b"), SIGTERM);
  ASSERT_GE(run.WaitFor("the run waits", 30s), 0ms);
  ExpectNoProcessAfterItsDeath(run);
}

TEST_F(KilledFrontDoor, RightAfterANodeWasTerminated) {
  Started run(Command({}));
  ASSERT_TRUE(Runs(Name()));
  ::kill(Part("--node b"), SIGTERM);
  ExpectNoProcessAfterItsDeath(run);
}

// Stops all threads of it. When the parent ends, the kernel continues processes that are stopped at that moment only.
bool IsStopped(pid_t process) {
  std::error_code problem;
  for (const auto& thread : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", process), problem)) {
    std::ifstream in(thread.path() / "stat");
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto name_ends = text.rfind(") ");
    if (name_ends != std::string::npos && text[name_ends + 2] != 'T') return false;
  }
  return true;
}

TEST_F(KilledFrontDoor, WithTheClockOrEverythingStopped) {
  for (const char* stopped : {"/rodeira-clock", "/rodeira-"}) {
    Started run(Command({}));
    ASSERT_TRUE(Runs(Name()));
    ::kill(run.pid(), SIGSTOP);  // it does not see it
    for (const pid_t part : ProcessesWith("--run " + Name(), stopped)) {
      ::kill(part, SIGSTOP);
      while (!IsStopped(part)) std::this_thread::sleep_for(1ms);
    }
    ExpectNoProcessAfterItsDeath(run);
  }
}

}  // namespace
}  // namespace rodeira::system_test
