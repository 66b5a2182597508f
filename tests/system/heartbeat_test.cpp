// SPDX-License-Identifier: Apache-2.0
// Heartbeats come from a thread that neither loading nor computing holds: a node that loads for long is no fault, a
// node that is stopped meanwhile is one.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// Five seconds are longer than any silence that is allowed (0.6 s, 3 s at the start).
TEST(Heartbeat, ANodeThatComputesForLongAtItsStartIsNoFault) {
  const Ended ended = RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--for", "1", "--set",
                                  "nodes.b.config.initialise_s=5"});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("faults  none"), std::string::npos) << ended.out;
}

TEST(Heartbeat, ANodeThatIsStoppedWhileItStartsIsNamedWithinASecond) {
  const std::string name = fmt::format("heartbeat-{}", ::getpid());
  Started run({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--no-record", "--run", name, "--set",
               "nodes.b.config.initialise_s=100"});
  ASSERT_GE(run.WaitFor("told to compute here", 30s), 0ms);
  const auto nodes = ProcessesWith("--run " + name, "--node b");
  ASSERT_EQ(nodes.size(), 1u);
  ::kill(nodes.front(), SIGSTOP);
  const auto took = run.WaitForLine("node 'b' … signal 19", 10s);
  EXPECT_GE(took, 0ms);
  EXPECT_LE(took, 1000ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
}

}  // namespace
}  // namespace rodeira::system_test
