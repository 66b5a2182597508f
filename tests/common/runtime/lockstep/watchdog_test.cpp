// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/watchdog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/names.hpp"

namespace rodeira::lockstep {
namespace {

class WatchdogTest : public ::testing::Test {
 protected:
  void Hear(NodeIndex node, std::int64_t now_ms, Phase phase = Phase::kRunning, Waiting waiting = Waiting::kInputs,
            std::int64_t since_ms = 0) {
    Report report;
    report.node = node;
    report.phase = phase;
    report.waiting = waiting;
    report.since_ms = since_ms;
    report.progress = 7;
    report.message = "no such file";
    dog_.Heard(report, now_ms);
  }
  const Roster roster_ = Roster::Create(1'000'000, 8,
                                        {{"car", "t", Role::kStepped, 1, 0, 300, {"x"}, {}},
                                         {"view", "t", Role::kStepped, 4, 0, 0, {}, {}}})
                             .value();
  Grant grant_;
  Watchdog dog_{roster_, {600, 2000, 5000}};
};

TEST_F(WatchdogTest, NamesASilentNode) {
  for (std::int64_t now = 0; now <= 1000; now += 50) {
    if (now <= 300) Hear(0, now);
    Hear(1, now);
    const auto fault = dog_.Check(now, grant_);
    if (now <= 900) {
      EXPECT_FALSE(fault) << now;
    } else {
      ASSERT_TRUE(fault);
      EXPECT_EQ(fault->node, 0u);
    }
    if (now == 950) {
      EXPECT_EQ(fault->reason, "node 'car' has sent nothing for 0.65 s at step 7: it was killed, stopped or cut off");
    }
  }
}

TEST_F(WatchdogTest, ANodeThatEndsBeforeTheRunDoesIsNamed) {
  Hear(0, 0);
  Hear(1, 0, Phase::kFinished);
  EXPECT_EQ(dog_.Check(0, grant_)->reason, "node 'view' ended at step 7 although the run goes on");
  grant_.final = true;
  EXPECT_FALSE(dog_.Check(0, grant_));
  Hear(0, 0, Phase::kAborted);
  EXPECT_EQ(dog_.Check(0, grant_)->node, 0u);
  grant_.abort = true;
  EXPECT_FALSE(dog_.Check(0, grant_));
}

TEST_F(WatchdogTest, NamesANodeThatHangsByItsOwnDeadlineButNotOneThatWaits) {
  Hear(0, 0, Phase::kRunning, Waiting::kInputs, 60000);
  Hear(1, 0, Phase::kRunning, Waiting::kNothing, 1999);
  EXPECT_FALSE(dog_.Check(0, grant_)) << "waiting for others and working within the deadline are no faults";
  Hear(0, 0, Phase::kRunning, Waiting::kServer, 60000);
  EXPECT_FALSE(dog_.Check(0, grant_));
  Hear(0, 0, Phase::kRunning, Waiting::kNothing, 301);
  EXPECT_EQ(dog_.Check(0, grant_)->reason,
            "node 'car' has been computing step 7 for 0.30 s, its deadline is 0.30 s (nodes.car.deadline_s)");
}

TEST_F(WatchdogTest, AServerThatAnswersNoMoreIsNamedWithTheStepOfTheRun) {
  const Roster roster = Roster::Create(1'000'000, 8, {{"road", "t", Role::kService, 1, 0, 0, {}, {}}}).value();
  Watchdog dog(roster, {600, 2000, 5000});
  Report report;
  report.phase = Phase::kRunning;
  report.since_ms = 2000;
  dog.Heard(report, 0);
  grant_.through = 480;
  EXPECT_FALSE(dog.Check(0, grant_));
  report.since_ms = 2001;
  dog.Heard(report, 0);
  EXPECT_EQ(dog.Check(0, grant_)->reason,
            "node 'road' has been answering a request for 2.00 s at step 480, its deadline is 2.00 s (limits.step_s)");
}

TEST_F(WatchdogTest, ANodeThatWritesItsResultsHasAsLongAsAtTheStart) {
  Hear(0, 0, Phase::kRunning, Waiting::kOutput, 5000);
  EXPECT_FALSE(dog_.Check(0, grant_));
  Hear(0, 0, Phase::kRunning, Waiting::kOutput, 5001);
  EXPECT_EQ(dog_.Check(0, grant_)->reason,
            "node 'car' has been writing the output of the steps before 7 for 5 s, its limit is 5 s (limits.start_s)");
}

TEST_F(WatchdogTest, ANodesOwnWordComesFirst) {
  Hear(0, 0, Phase::kRunning, Waiting::kNothing, 9000);
  Hear(1, 0, Phase::kFailed);
  EXPECT_EQ(dog_.Check(0, grant_)->reason, "node 'view' failed at step 7: no such file");
}

TEST_F(WatchdogTest, AFailedNodeStaysSoAndARefusedInputIsStatusTwo) {
  Hear(0, 0, Phase::kRunning);
  Hear(1, 0, Phase::kFailed);
  Hear(1, 0, Phase::kRunning);
  ASSERT_TRUE(dog_.Check(0, grant_)) << "a report overtaken on its way is no recovery";
  EXPECT_EQ(dog_.Check(0, grant_)->status, 1);
  Hear(0, 0, Phase::kRefused);
  EXPECT_EQ(dog_.Check(0, grant_)->status, 2);
}

TEST_F(WatchdogTest, ForgivesTheClocksOwnAbsence) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  EXPECT_FALSE(dog_.Check(5000, grant_)) << "the clock itself stood still";
  for (std::int64_t now = 5050; now <= 5500; now += 50) EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  std::optional<Watchdog::Fault> fault;
  for (std::int64_t now = 5550; now <= 6000 && !fault; now += 50) fault = dog_.Check(now, grant_);
  EXPECT_TRUE(fault) << "but not for ever";
}

TEST_F(WatchdogTest, SaysWhichNodesAreMissingAtTheStart) {
  std::optional<Watchdog::Fault> fault;
  for (std::int64_t now = 0; now <= 5200 && !fault; now += 100) {
    Hear(0, now, Phase::kReady, Waiting::kGrant);
    fault = dog_.Check(now, grant_);
  }
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->reason, "after 5 s these are still missing: 'view' (no message from it)");
  EXPECT_EQ(fault->node, 1u);
}

TEST_F(WatchdogTest, SaysWhatAMissingNodeWaitsFor) {
  std::optional<Watchdog::Fault> fault;
  for (std::int64_t now = 0; now <= 5200 && !fault; now += 100) {
    Hear(0, now, Phase::kReady, Waiting::kGrant);
    Report report;
    report.node = 1;
    report.message = "waits for something since 4.9 s";
    dog_.Heard(report, now);
    fault = dog_.Check(now, grant_);
  }
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->reason, Names("5 s … 'view' … (waits for something since 4.9 s)"));
}

TEST_F(WatchdogTest, ALoadingNodeMayBeSilentFiveTimesAsLong) {
  std::optional<Watchdog::Fault> fault;
  std::int64_t now = 0;
  for (Hear(0, 0, Phase::kStarting, Waiting::kNothing); now <= 5000 && !fault; now += 50) {
    Hear(1, now, Phase::kStarting, Waiting::kNothing);
    fault = dog_.Check(now, grant_);
    if (now <= 3000) {
      ASSERT_FALSE(fault) << now;
    }
  }
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->reason, Names("node 'car' … 3.05 s … step 7: "));
}

// On a PC with too much work the clock is late repeatedly: reports that it did not receive then are no silence of a
// node.
TEST_F(WatchdogTest, ForgivesWhatTheClockHadNoProcessorFor) {
  Hear(0, 0);
  Hear(1, 0);
  for (std::int64_t now = 0; now <= 3000; now += 120) EXPECT_FALSE(dog_.Check(now, grant_)) << now;
}

TEST_F(WatchdogTest, AFinishedNodeMayBeSilent) {
  grant_.final = true;
  Hear(0, 0, Phase::kFinished);
  for (std::int64_t now = 0; now <= 2000; now += 100) {
    Hear(1, now);
    EXPECT_FALSE(dog_.Check(now, grant_));
  }
}

TEST_F(WatchdogTest, NoSilenceCountsWhileANodeIsRestarted) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  dog_.ExpectRestart(0, 0);
  for (std::int64_t now = 50; now <= 3000; now += 50) EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  Report back;
  back.node = 0;
  back.incarnation = 1;
  back.phase = Phase::kRunning;
  back.waiting = Waiting::kGrant;
  dog_.Heard(back, 3000);
  EXPECT_FALSE(dog_.Check(3000, grant_));
  dog_.Heard(back, 3050);
  for (std::int64_t now = 3050; now <= 3650; now += 50) EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  const auto fault = dog_.Check(3700, grant_);
  ASSERT_TRUE(fault) << "from then on it counts anew";
  EXPECT_EQ(fault->node, 0u);
}

// A recorder was stopped and killed, and its next incarnation is ready in half a second; the car hangs for two in what
// it had wanted to say to the old one.
TEST_F(WatchdogTest, ANodeHeldUpByADeadProcessIsNotNamedForIt) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  dog_.ExpectRestart(1, 0);
  Report back;
  back.node = 1;
  back.incarnation = 1;
  back.phase = Phase::kReady;
  back.waiting = Waiting::kGrant;
  for (std::int64_t now = 50; now <= 2000; now += 50) {
    if (now >= 500) dog_.Heard(back, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  Hear(0, 2050);
  for (std::int64_t now = 2050; now <= 2650; now += 50) {
    dog_.Heard(back, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  dog_.Heard(back, 2700);
  ASSERT_TRUE(dog_.Check(2700, grant_)) << "once it has spoken, its silence is like anybody's";
  EXPECT_EQ(dog_.Check(2700, grant_)->node, 0u);
}

TEST_F(WatchdogTest, ANodeThatNeverSpeaksAgainIsNamedAtLast) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  dog_.ExpectRestart(1, 0);
  Report back;
  back.node = 1;
  back.incarnation = 1;
  back.phase = Phase::kReady;
  std::int64_t now = 500;
  for (; now <= 500 + 5 * 600; now += 50) {
    dog_.Heard(back, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  dog_.Heard(back, now);
  ASSERT_TRUE(dog_.Check(now, grant_));
  EXPECT_THAT(dog_.Check(now, grant_)->reason, Names("node 'car' … 3.05 s … step 7: "));
}

TEST_F(WatchdogTest, ALifeThatDoesNotBecomeReadyIsNamed) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  dog_.ExpectRestart(1, 1000);
  for (std::int64_t now = 50; now <= 6000; now += 50) {
    Hear(0, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  const auto fault = dog_.Check(6050, grant_);
  ASSERT_TRUE(fault);
  EXPECT_THAT(fault->reason, Names("5 s … 'view' … (no message from it)"));
}

TEST_F(WatchdogTest, ASuspendedNodeIsNotNamedUntilItGoesOn) {
  Hear(0, 0);
  Hear(1, 0);
  EXPECT_FALSE(dog_.Check(0, grant_));
  dog_.Suspend(0);
  for (std::int64_t now = 50; now <= 20000; now += 50) {
    Hear(1, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  Hear(0, 20000);
  for (std::int64_t now = 20050; now <= 20600; now += 50) {
    Hear(1, now);
    EXPECT_FALSE(dog_.Check(now, grant_)) << now;
  }
  Hear(1, 20650);
  EXPECT_TRUE(dog_.Check(20650, grant_));
}

}  // namespace
}  // namespace rodeira::lockstep
