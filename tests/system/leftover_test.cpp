// SPDX-License-Identifier: Apache-2.0
// What the demo leaves when it ends, however it ends: its files, and nothing else.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <thread>

#include "launch/rodeira/run/shared_memory.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

class Leftover : public ::testing::Test {
 protected:
  Leftover() : before_(cli::SharedMemoryFiles()) {}

  std::vector<std::string> Demo(const std::string& run_name, std::vector<std::string> more) const {
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--headless", "--run", run_name,
                               "--record", (folder_.path() / "a.mcap").string(), "--set",
                               "nodes.view.config.frames.folder=" + (folder_.path() / "frames").string(), "--set",
                               "nodes.view.config.width_px=160", "--set", "nodes.view.config.height_px=90"});
    return more;
  }
  // The clock and six nodes.
  static void WaitUntilAllAreThere(const std::string& run_name) {
    const auto until = std::chrono::steady_clock::now() + 30s;
    while (ProcessesWith("--run " + run_name, "bin/rodeira-").size() < 7 && std::chrono::steady_clock::now() < until)
      ::usleep(5000);
    ASSERT_EQ(ProcessesWith("--run " + run_name, "bin/rodeira-").size(), 7u);
  }
  // Files of DDS in /dev/shm that were not there before.
  std::set<std::string> Left() const {
    std::set<std::string> left;
    std::ranges::set_difference(cli::SharedMemoryFiles(), before_, std::inserter(left, left.end()));
    return left;
  }
  const std::set<std::string> before_;
  const cli::TemporaryFolder folder_;
};

TEST_F(Leftover, OfANormalEnd) {
  const Ended ended = RunCommand(Demo("left-normal", {"--for", "0.2"}));
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run left-normal").empty());
  EXPECT_EQ(Left(), std::set<std::string>());
}

TEST_F(Leftover, TwoSecondsAfterCtrlC) {
  Started run(Demo("left-ctrlc", {"--for", "1000", "--pace", "real"}));
  WaitUntilAllAreThere("left-ctrlc");
  ASSERT_TRUE(WaitForStep("left-ctrlc", 1000));
  ::kill(run.pid(), SIGINT);
  std::this_thread::sleep_for(2s);
  EXPECT_TRUE(ProcessesWith("--run left-ctrlc", "bin/rodeira-").empty());
  EXPECT_EQ(run.Wait(1s).status, 0);
  EXPECT_EQ(Left(), std::set<std::string>());
}

// While the nodes still load their worlds and wait for each other.
TEST_F(Leftover, TwoSecondsAfterCtrlCDuringTheStart) {
  Started run(Demo("left-early", {"--for", "1000", "--pace", "real"}));
  WaitUntilAllAreThere("left-early");
  ::kill(run.pid(), SIGINT);
  std::this_thread::sleep_for(2s);
  EXPECT_TRUE(ProcessesWith("--run left-early", "bin/rodeira-").empty());
  EXPECT_NE(run.Wait(1s).status, 0) << "nothing has been driven";
  EXPECT_EQ(Left(), std::set<std::string>());
}

TEST_F(Leftover, TwoSecondsAfterRodeiraItselfWasKilled) {
  Started run(Demo("left-killed", {"--for", "1000", "--pace", "real"}));
  WaitUntilAllAreThere("left-killed");
  ASSERT_TRUE(WaitForStep("left-killed", 1000));
  ::kill(run.pid(), SIGKILL);
  std::this_thread::sleep_for(2s);
  EXPECT_TRUE(ProcessesWith("--run left-killed", "bin/rodeira-").empty());
  EXPECT_EQ(Left(), std::set<std::string>());
}

}  // namespace
}  // namespace rodeira::system_test
