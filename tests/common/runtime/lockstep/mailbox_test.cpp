// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/mailbox.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {
namespace {

using namespace std::chrono_literals;

class MailboxTest : public ::testing::Test {
 protected:
  static Sample Make(SourceIndex source, Step valid, std::uint64_t content, std::uint32_t incarnation = 0) {
    base::Bytes payload = law::Payload(content);
    const SampleHeader header{valid, valid * 1'000'000, source, incarnation, 0};
    header.Write(payload);
    return {header, std::make_shared<const base::Bytes>(std::move(payload))};
  }
  static Grant Through(Step through, bool final = false) {
    Grant grant;
    grant.through = through;
    grant.final = final;
    return grant;
  }
  const Roster roster_ = Roster::Create(1'000'000, 20,
                                        {{"slow", "t", Role::kStepped, 10, 0, 0, {"a"}, {}},
                                         {"fast", "t", Role::kStepped, 2, 0, 0, {"b"}, {}},
                                         {"me",
                                          "t",
                                          Role::kStepped,
                                          5,
                                          0,
                                          0,
                                          {},
                                          {{"a", PortKind::kState, {"slow"}}, {"b", PortKind::kEvent, {"fast"}}}}})
                             .value();
  Mailbox mailbox_{roster_, 2};
};

TEST_F(MailboxTest, NamesTheOldestSampleThatIsMissingOfEachSource) {
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 6, 1)).ok());
  const auto gaps = mailbox_.Missing(10);  // sees 'slow' at 10, and of 'fast' 6, 8 and 10
  ASSERT_EQ(gaps.size(), 2u);
  EXPECT_EQ(gaps[0].source, 0u);
  EXPECT_EQ(gaps[0].from, 10);
  EXPECT_EQ(gaps[1].source, 1u);
  EXPECT_EQ(gaps[1].from, 8);
  EXPECT_EQ(mailbox_.MissingEvents(10).front().from, 0);
}

TEST_F(MailboxTest, CallsWhenWhatTheLastWaitLackedIsThere) {
  int calls = 0;
  mailbox_.OnReady(std::make_shared<const std::function<void()>>([&] { ++calls; }));
  ASSERT_EQ(mailbox_.WaitForInputs(0, 0ms), Mailbox::Woken::kTimeout);
  ASSERT_TRUE(mailbox_.Deliver(Make(0, 0, 1)).ok());
  EXPECT_EQ(calls, 0);
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 0, 1)).ok());
  EXPECT_EQ(calls, 1);
  ASSERT_EQ(mailbox_.WaitForInputs(0, 0ms), Mailbox::Woken::kReady);
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 2, 1)).ok());  // no node waits for it
  EXPECT_EQ(calls, 1);
}

TEST_F(MailboxTest, WaitsForExactlyTheSamplesOfTheLaw) {
  mailbox_.DeliverGrant(Through(100));
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0ms), Mailbox::Woken::kTimeout);
  EXPECT_EQ(mailbox_.Missing(0).front().source, 0u);
  ASSERT_TRUE(mailbox_.Deliver(Make(0, 0, 1)).ok());
  EXPECT_EQ(mailbox_.Missing(0).front().source, 1u);
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 0, 2)).ok());
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0ms), Mailbox::Woken::kReady);
  mailbox_.Forget(5);
  // At 5: a's sample of 0 still, b's of 2 and 4, in whatever order they come.
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 4, 4)).ok());
  EXPECT_EQ(mailbox_.WaitForActivation(5, 0ms), Mailbox::Woken::kTimeout);
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 6, 6)).ok());
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 2, 2)).ok());
  EXPECT_EQ(mailbox_.WaitForActivation(5, 0ms), Mailbox::Woken::kReady);
  Inbox inbox;
  mailbox_.Open(5, inbox);
  EXPECT_EQ(law::ContentOf(inbox.Latest("a")), 1u);
  ASSERT_EQ(inbox.All("b").size(), 2u);
  EXPECT_EQ(inbox.All("b")[0].valid(), 2);
  EXPECT_EQ(inbox.All("b")[1].valid(), 4);
  EXPECT_FALSE(inbox.Has("c"));
}

TEST_F(MailboxTest, WithoutAGrantNothingRuns) {
  ASSERT_TRUE(mailbox_.Deliver(Make(0, 0, 1)).ok());
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 0, 2)).ok());
  EXPECT_EQ(mailbox_.WaitForInputs(0, 0ms), Mailbox::Woken::kReady);
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0ms), Mailbox::Woken::kTimeout);
  mailbox_.DeliverGrant(Through(0));
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0ms), Mailbox::Woken::kReady);
  mailbox_.DeliverGrant(Through(-1));  // an older grant that comes late takes nothing back
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0ms), Mailbox::Woken::kReady);
}

TEST_F(MailboxTest, ADuplicateIsIgnoredAndADifferentOneRefused) {
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 2, 7)).ok());
  EXPECT_TRUE(mailbox_.Deliver(Make(1, 2, 7, 3)).ok()) << "another incarnation may say the same again";
  const auto refused = mailbox_.Deliver(Make(1, 2, 8));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().Text(), "fast.b: two different samples are valid at step 2");
}

TEST_F(MailboxTest, AStepThatCannotBeIsRefused) {
  EXPECT_EQ(mailbox_.Deliver(Make(1, 3, 7)).error().message,
            "a sample valid at 3 was found, multiples of the period 2 were expected");
  EXPECT_FALSE(mailbox_.Deliver(Make(1, -2, 7)).ok());
  EXPECT_FALSE(mailbox_.Deliver(Make(1, Step{1} << 40, 7)).ok());
  EXPECT_TRUE(mailbox_.Deliver(Make(99, 2, 7)).ok()) << "a source that this node is not wired to is nothing to it";
}

// Window, delay and periods bound how far ahead a source can be: nothing is kept for a step beyond.
TEST_F(MailboxTest, AStepThatNoSourceCanHaveReachedIsRefused) {
  EXPECT_TRUE(mailbox_.Deliver(Make(1, 30, 1)).ok()) << "window and delay";
  const auto far = mailbox_.Deliver(Make(1, 1000, 1));
  ASSERT_FALSE(far.ok());
  EXPECT_NE(far.error().Text().find("a sample valid at 1000 was found; steps from 0 to"), std::string::npos)
      << far.error().Text();
  mailbox_.DeliverGrant(Through(990));
  EXPECT_TRUE(mailbox_.Deliver(Make(1, 1000, 1)).ok()) << "this node was started again, far behind the others";
}

TEST_F(MailboxTest, AnEarlyEndIsForGoodWhateverTheClockSays) {
  EXPECT_FALSE(mailbox_.early_end());
  // Before, while and after a thread waits.
  for (int race = 0; race < 200; ++race) {
    Mailbox box(roster_, 2);
    std::thread ends([&box] { box.EndEarly({LifeEvent::kLost, "was told to end"}); });
    EXPECT_EQ(box.WaitForActivation(0, 10s), Mailbox::Woken::kAborted);
    ends.join();
  }
  mailbox_.EndEarly({LifeEvent::kLost, "was told to end"});
  mailbox_.EndEarly({LifeEvent::kFailed, "a later reason"});
  mailbox_.DeliverGrant(Through(100, true));
  EXPECT_EQ(mailbox_.WaitForActivation(0, 0s), Mailbox::Woken::kAborted);
  ASSERT_TRUE(mailbox_.early_end());
  EXPECT_EQ(mailbox_.early_end()->event, LifeEvent::kLost);
  EXPECT_TRUE(mailbox_.grant().abort);
  EXPECT_EQ(mailbox_.grant().reason, "was told to end");
}

TEST_F(MailboxTest, WakesTheWaitingThreadForTheEndAndForAnAbort) {
  std::thread later([this] {
    std::this_thread::sleep_for(20ms);
    mailbox_.DeliverGrant(Through(3, true));
  });
  EXPECT_EQ(mailbox_.WaitForActivation(5, 10s), Mailbox::Woken::kFinal);
  later.join();
  Grant abort;
  abort.abort = true;
  mailbox_.DeliverGrant(abort);
  EXPECT_EQ(mailbox_.WaitForActivation(0, 10s), Mailbox::Woken::kAborted);
}

TEST_F(MailboxTest, KnowsHowFarEverythingHasArrived) {
  for (const Step v : {0, 2, 4, 8}) ASSERT_TRUE(mailbox_.Deliver(Make(1, v, 1)).ok());
  EXPECT_EQ(mailbox_.CompleteThrough(0), 5);
  ASSERT_TRUE(mailbox_.Deliver(Make(1, 6, 1)).ok());
  EXPECT_EQ(mailbox_.CompleteThrough(0), 9);
  EXPECT_EQ(mailbox_.OpenEvents(2, 6).All("b").size(), 2u);
}

}  // namespace
}  // namespace rodeira::lockstep
