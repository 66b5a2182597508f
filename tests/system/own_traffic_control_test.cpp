// SPDX-License-Identifier: Apache-2.0
// A node of one's own controls the traffic (examples/own_traffic_control): what it asks for happens, and is recorded,
// verified, branched and recovered as all else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;
namespace topics = idl::topics;

const fs::path kExample = fs::path(SourceDir()) / "examples/own_traffic_control";
constexpr std::int64_t kStepsOfASecond = 1000;

class OwnTrafficControl : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy(kExample / "control.yaml", folder_.path() / "control.yaml");
    fs::create_symlink(Bin("rodeira-test-traffic-control"), folder_.path() / "traffic_control");
    fs::create_symlink(Bin("rodeira-test-traffic-control.so"), folder_.path() / "traffic_control.so");
    std::string text = base::ReadText(kExample / "own_traffic_control.yaml.in").value();
    for (std::size_t at; (at = text.find("@RODEIRA_DATA@")) != std::string::npos;)
      text.replace(at, std::string("@RODEIRA_DATA@").size(), SourceDir());
    launch_ = folder_.Write("control_run.yaml", text).string();
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string Name() const { return "control-" + folder_.path().filename().string(); }
  std::vector<std::string> Command(const std::string& recording, const std::string& for_s,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{Bin("rodeira"), "run",           launch_, "--run", Name(),
                                     "--record",     File(recording), "--for", for_s};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  Ended Run(const std::string& recording, const std::string& for_s, const std::vector<std::string>& more = {}) const {
    return RunCommand(Command(recording, for_s, more));
  }
  // Another node of the same program, behind the first in the roster.
  std::vector<std::string> WithSecond() const {
    return {"--set", "nodes.second={kind: external, program: \"" + File("traffic_control") + "\", library: \"" +
                         File("traffic_control.so") + "\", manifest: \"" + File("control.yaml") +
                         "\", config: {light: nowhere}}"};
  }
  const cli::TemporaryFolder folder_;
  std::string launch_;
};

TEST_F(OwnTrafficControl, WhatItAsksForHappens) {
  const Ended ended = Run("a.mcap", "40");
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, Not(HasSubstr("refused: ")));
  std::map<std::uint32_t, std::pair<std::int64_t, std::uint32_t>> speeds;  // step and agent, by number
  std::vector<std::int64_t> asked;                                         // steps, by number
  std::size_t answered = 0;
  for (const auto& sample : MessagesOf<msg::TrafficRequests>(File("a.mcap"), topics::kTrafficRequests)) {
    for (const msg::TrafficRequest& request : sample.requests()) {
      asked.push_back(sample.header().step());
      if (request.name() == "speed") speeds[request.number()] = {sample.header().step(), request.agent()};
    }
  }
  for (const auto& sample : MessagesOf<msg::TrafficAnswers>(File("a.mcap"), topics::kTrafficAnswers)) {
    for (const msg::TrafficAnswer& answer : sample.answers()) {
      EXPECT_EQ(answer.number(), ++answered);
      EXPECT_EQ(answer.refused(), 0u) << answer.sentence();
    }
  }
  // All but those of the last 0.2 s, which the run's end overtakes.
  ASSERT_LE(answered, asked.size());
  for (std::size_t i = answered; i < asked.size(); ++i)
    EXPECT_GE(5 * asked[i], 5 * 40 * kStepsOfASecond - kStepsOfASecond);
  EXPECT_FALSE(speeds.empty());
  // Ten seconds later each is at 6 m/s at most, if it is still on its trip.
  std::map<std::uint32_t, std::uint32_t> trips;
  int slow = 0;
  for (const auto& sample : MessagesOf<msg::TrafficState>(File("a.mcap"), topics::kTrafficState)) {
    for (const auto& [number, at] : speeds) {
      for (const msg::TrafficAgent& agent : sample.agents()) {
        if (agent.id() != at.second) continue;
        if (sample.header().step() == at.first) trips[number] = agent.trip();
        if (sample.header().step() != at.first + 10 * kStepsOfASecond || agent.trip() != trips[number]) continue;
        EXPECT_LT(agent.speed_mps(), 6.1) << agent.id();
        ++slow;
      }
    }
  }
  EXPECT_GT(slow, 0);
  // By its plan the light is green until 25 s; the request turns it to amber, for 3 s, and red.
  constexpr std::uint32_t kGreen = 2, kRed = 0;
  std::size_t held = 2;
  int red = 0;
  for (const auto& sample : MessagesOf<msg::SignalsState>(File("a.mcap"), topics::kSignalsState)) {
    const double time_s = static_cast<double>(sample.header().step()) / kStepsOfASecond;
    if (time_s == 1.0) held = sample.groups().at(0).colour() == kGreen ? 0 : 1;
    if (time_s == 5.0) {
      EXPECT_EQ(sample.groups().at(held).colour(), kGreen);
    }
    if (time_s < 8.5 || time_s > 28.0) continue;
    EXPECT_EQ(sample.groups().at(held).colour(), kRed) << time_s;
    ++red;
  }
  EXPECT_GT(red, 1900);
}

// Of two nodes that ask, both are answered, in the roster's order; one that asks for a light that is not there is told
// so, and the run goes on.
TEST_F(OwnTrafficControl, ARequestThatCannotBeCarriedOutEndsNoRun) {
  const Ended ended = Run("a.mcap", "10", WithSecond());
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("refused: request 'light': there is no controller 'nowhere' of lights"));
  int both = 0;
  for (const auto& sample : MessagesOf<msg::TrafficAnswers>(File("a.mcap"), topics::kTrafficAnswers)) {
    for (std::size_t i = 0; i + 1 < sample.answers().size(); ++i) {
      EXPECT_LE(sample.answers()[i].source(), sample.answers()[i + 1].source());
      both += sample.answers()[i].source() < sample.answers()[i + 1].source() ? 1 : 0;
    }
  }
  EXPECT_GT(both, 0);
}

TEST_F(OwnTrafficControl, IsVerifiedBranchedAndTheSameInOneProcess) {
  const Ended apart = Run("a.mcap", "15");
  ASSERT_EQ(apart.status, 0) << apart.out;
  const Ended together = Run("together.mcap", "15", {"--in-process"});
  ASSERT_EQ(together.status, 0) << together.out;
  EXPECT_EQ(DigestIn(together.out), DigestIn(apart.out));
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("a.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("identical: 15000 steps"));
  const std::string library = "control=" + Bin("rodeira-test-traffic-control.so");
  const Ended again = RunCommand({Bin("rodeira"), "replay", File("a.mcap"), "--verify", "--library", library});
  EXPECT_EQ(again.status, 0) << again.out;
  EXPECT_THAT(again.out, Not(HasSubstr("not computed again")));
  // From within the held red and the held speeds.
  const auto branch = [&](const std::string& light, const std::string& file) {
    return RunCommand({Bin("rodeira"), "replay", File("a.mcap"), "--from", "10", "--branch",
                       "nodes.traffic.config.vehicles=" + light, "--library", library, "--record", File(file)});
  };
  const Ended same = branch("20", "same.mcap");
  ASSERT_EQ(same.status, 0) << same.out;
  EXPECT_EQ(FirstDifference(SamplesOf(File("a.mcap")), SamplesOf(File("same.mcap"))), "");
}

TEST_F(OwnTrafficControl, AKilledTrafficIsStartedAgainWithWhatWasAskedOfIt) {
  const Ended calm = Run("calm.mcap", "14");
  ASSERT_EQ(calm.status, 0) << calm.out;
  Started run(Command("killed.mcap", "14", {"--pace", "4", "--set", "recovery=restart"}));
  ASSERT_TRUE(Runs(Name()));
  const pid_t victim = ProcessWith("--run " + Name(), "--node traffic");
  ASSERT_GT(victim, 0);
  for (int i = 0; i < 8; ++i) WaitForGrowth(File("killed.mcap"));
  ASSERT_EQ(::kill(victim, SIGKILL), 0);
  const Ended ended = run.Wait(60s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << ended.out;
  EXPECT_EQ(FirstDifference(SamplesOf(File("calm.mcap")), SamplesOf(File("killed.mcap"))), "");
}

}  // namespace
}  // namespace rodeira::system_test
