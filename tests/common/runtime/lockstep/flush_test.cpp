// SPDX-License-Identifier: Apache-2.0
// What a step has given to the node's own threads is waited for before its progress is told, and that waiting is not
// the step's time.
#include <gtest/gtest.h>

#include "common/runtime/lockstep/runner.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using namespace std::chrono_literals;

class NoBus final : public Bus {
 public:
  base::Status Publish(const Sample&) override { return {}; }
  void SendNack(const Gap&) override {}
  void Tell(const Report& report) override { told.push_back(report); }
  std::vector<Report> told;
};

// Remembers where its runner said that it stood.
class Writer final : public Node {
 public:
  base::Status Initialise(Outbox&) override { return {}; }
  base::Status Flush() override {
    seen.push_back(runner->report());
    if (answer.ok()) settled_through = next;
    return answer;
  }
  base::Status Step(const StepInfo& step, const Inbox&, Outbox&) override {
    next = step.step + step.period;
    seen.push_back(runner->report());
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

  const Runner* runner = nullptr;
  base::Status answer;
  std::vector<Report> seen;
  lockstep::Step next = 0, settled_through = 0;
};

class SettleTest : public ::testing::Test {
 protected:
  SettleTest() {
    node_.runner = &runner_;
    Grant grant;
    grant.through = 10;
    mailbox_.DeliverGrant(grant);
  }
  Runner::Outcome Go() {
    Runner::Outcome outcome = Runner::Outcome::kWorking;
    while (outcome == Runner::Outcome::kWorking) outcome = runner_.Advance(0ms);
    return outcome;
  }
  const Roster roster_ = Roster::Create(1'000'000, 20, {{"view", "t", Role::kStepped, 10, 0, 0, {}, {}}}).value();
  NoBus bus_;
  Mailbox mailbox_{roster_, 0};
  Writer node_;
  Runner runner_{roster_, 0, node_, bus_, mailbox_, {}};
};

// A node that is restarted begins behind the progress that was told: a picture that is still drawn must not count.
TEST_F(SettleTest, AStepIsProgressWhenItsWorkIsDone) {
  EXPECT_EQ(Go(), Runner::Outcome::kBlocked);
  ASSERT_EQ(node_.seen.size(), 4u);  // activation 0, its work done, activation 10, its work done
  for (std::size_t i = 0; i < node_.seen.size(); ++i) {
    EXPECT_EQ(node_.seen[i].waiting, i % 2 == 1 ? Waiting::kOutput : Waiting::kNothing) << i;
    EXPECT_EQ(node_.seen[i].progress, i < 2 ? 0 : 10) << i;
    EXPECT_EQ(node_.seen[i].phase, Phase::kRunning) << i;
  }
  EXPECT_EQ(runner_.report().progress, 20);
  for (const Report& told : bus_.told) EXPECT_LE(told.progress, node_.settled_through) << "told before it was done";
}

TEST_F(SettleTest, WhatCannotBeWrittenEndsTheNode) {
  node_.answer = base::Failed("recording.cannot_write", "the disk is full");
  EXPECT_EQ(Go(), Runner::Outcome::kFailed);
  EXPECT_EQ(node_.seen.size(), 2u);
  EXPECT_EQ(runner_.report().progress, 0);
  EXPECT_NE(runner_.report().message.find("the disk is full"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::lockstep
