// SPDX-License-Identifier: Apache-2.0
// What a node has given to its own threads is waited for before each activation, and that waiting is not its step's
// time.
#include <gtest/gtest.h>

#include "common/runtime/lockstep/runner.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using namespace std::chrono_literals;

class NoBus final : public Bus {
 public:
  base::Status Publish(const Sample&) override { return {}; }
  void Ask(const Gap&) override {}
  void Tell(const Report&) override {}
};

// Remembers where its runner said that it stood.
class Writer final : public Node {
 public:
  base::Status Initialise(Outbox&) override { return {}; }
  base::Status Settle() override {
    seen.push_back(runner->report());
    return answer;
  }
  base::Status Step(const StepInfo&, const Inbox&, Outbox&) override {
    seen.push_back(runner->report());
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

  const Runner* runner = nullptr;
  base::Status answer;
  std::vector<Report> seen;
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

TEST_F(SettleTest, IsWaitedForBeforeEachActivationAndIsNoComputing) {
  EXPECT_EQ(Go(), Runner::Outcome::kBlocked);
  ASSERT_EQ(node_.seen.size(), 4u);  // activations 0 and 10
  for (std::size_t i = 0; i < node_.seen.size(); ++i) {
    EXPECT_EQ(node_.seen[i].waiting, i % 2 == 0 ? Waiting::kOutput : Waiting::kNothing) << i;
    EXPECT_EQ(node_.seen[i].progress, i < 2 ? 0 : 10) << i;
    EXPECT_EQ(node_.seen[i].phase, Phase::kRunning) << i;
  }
}

TEST_F(SettleTest, WhatCannotBeWrittenEndsTheNode) {
  node_.answer = base::Failed("the disk is full");
  EXPECT_EQ(Go(), Runner::Outcome::kFailed);
  EXPECT_EQ(node_.seen.size(), 1u);
  EXPECT_NE(runner_.report().message.find("the disk is full"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::lockstep
