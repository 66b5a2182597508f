// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/names.hpp"

namespace rodeira::lockstep {
namespace {

constexpr Step kFree = 1'000'000;

class ClockTest : public ::testing::Test {
 protected:
  static Report Make(NodeIndex node, Phase phase, Step progress, std::uint32_t incarnation = 0) {
    Report report;
    report.node = node;
    report.phase = phase;
    report.progress = progress;
    report.incarnation = incarnation;
    return report;
  }
  void Take(const Report& report) { ASSERT_TRUE(clock_.Take(report).ok()); }
  const Roster roster_ = Roster::Create(1'000'000, 8,
                                        {{"a", "t", Role::kStepped, 1, 0, 0, {"x"}, {}},
                                         {"b", "t", Role::kStepped, 4, 0, 0, {"x"}, {}},
                                         {"road", "road", Role::kService, 1, 0, 0, {}, {}}})
                             .value();
  Clock clock_{roster_, 100};
};

TEST_F(ClockTest, GrantsNothingBeforeAllNodesAreReady) {
  Take(Make(0, Phase::kReady, 0));
  Take(Make(1, Phase::kStarting, 0));
  EXPECT_EQ(clock_.Update(kFree).through, -1);
  EXPECT_EQ(clock_.Missing(Phase::kReady), (std::vector<std::string>{"b", "road"}));
  Take(Make(1, Phase::kReady, 0));
  Take(Make(2, Phase::kReady, 0));
  EXPECT_EQ(clock_.Update(kFree).through, 8);
}

// A server has no steps of its own: that it died before says nothing, as long as the run gets on.
TEST_F(ClockTest, AServerMayBeLostAgainAndAgainWhereTheRunGetsOn) {
  std::vector<NodeSpec> specs{
      {"car", "t", Role::kStepped, 1, 1, 0, {"a"}, {}, 10},
      {"recorder",
       "t",
       Role::kStepped,
       5,
       5,
       0,
       {},
       {{"a", PortKind::kEvent, {"car"}}, {std::string(kSnapshotTopic), PortKind::kEvent, {"car"}}},
       0},
      {"road", "road", Role::kService, 1, 0, 0, {}, {}, 0}};
  const Roster roster = Roster::Create(1'000'000, 20, specs).value();
  Clock clock(roster, 1000, 0, std::vector<Policy>(3, Policy::kRestart));
  const auto all_at = [&](Step step) {
    for (const NodeIndex n : {0u, 1u, 2u}) {
      Report report = Make(n, step == 0 ? Phase::kReady : Phase::kRunning, n == 2 ? 0 : step, clock.incarnation(n));
      report.safe = n == 1 ? step : -1;
      ASSERT_TRUE(clock.Take(report).ok());
    }
    clock.Update(kFree);
  };
  all_at(0);
  EXPECT_EQ(clock.reached(2), 20);
  Step before = -1;
  for (Step step = 20; step <= 200; step += 20) {
    all_at(step);
    EXPECT_EQ(clock.reached(0), step);
    EXPECT_EQ(clock.reached(2), step + 20);
    EXPECT_EQ(clock.HandleLoss(2).policy, Policy::kRestart) << step;
    EXPECT_GT(clock.grant().resume, before) << "one that is back holds nothing up";
    before = clock.grant().resume;
  }
  all_at(220);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(clock.HandleLoss(2).policy, Policy::kRestart);
  const auto fourth = clock.HandleLoss(2);
  EXPECT_EQ(fourth.policy, Policy::kStop);
  EXPECT_THAT(fourth.why, Names(" 4 times … step 240"));
}

TEST_F(ClockTest, TheSlowestNodeHoldsTheWindowAndThePaceHoldsTheRest) {
  for (const NodeIndex n : {0u, 1u, 2u}) Take(Make(n, Phase::kReady, 0));
  (void)clock_.Update(kFree);
  Take(Make(0, Phase::kRunning, 9));
  EXPECT_EQ(clock_.Update(kFree).through, 8) << "b is still at 0";
  Take(Make(1, Phase::kRunning, 4));
  EXPECT_EQ(clock_.Update(10).through, 10) << "the pace allows 10, the window 12";
  EXPECT_EQ(clock_.Update(kFree).through, 12);
  EXPECT_EQ(clock_.Update(3).through, 12) << "what is granted stays granted";
}

TEST_F(ClockTest, TheLastStepIsFinal) {
  Clock clock(roster_, 5);
  for (const NodeIndex n : {0u, 1u, 2u}) ASSERT_TRUE(clock.Take(Make(n, Phase::kReady, 0)).ok());
  const Grant grant = clock.Update(kFree);
  EXPECT_EQ(grant.through, 5);
  EXPECT_TRUE(grant.final);
  EXPECT_FALSE(clock.all_finished());
  for (const NodeIndex n : {0u, 1u, 2u})
    ASSERT_TRUE(clock.Take(Make(n, Phase::kFinished, n == 0 ? 6 : n == 1 ? 8 : 0)).ok());
  EXPECT_TRUE(clock.all_finished());
}

TEST_F(ClockTest, AFailedNodeIsNeitherReadyNorFinished) {
  Take(Make(0, Phase::kReady, 0));
  Take(Make(1, Phase::kFailed, 0));
  Take(Make(2, Phase::kReady, 0));
  EXPECT_FALSE(clock_.all_ready());
  EXPECT_EQ(clock_.Update(kFree).through, -1) << "nothing is granted to the others";
  Take(Make(0, Phase::kFinished, 0));
  Take(Make(2, Phase::kFinished, 0));
  EXPECT_FALSE(clock_.all_finished());
  EXPECT_EQ(clock_.Missing(Phase::kFinished), std::vector<std::string>{"b"});
}

TEST_F(ClockTest, StopMakesTheGrantedStepTheLast) {
  for (const NodeIndex n : {0u, 1u, 2u}) Take(Make(n, Phase::kReady, 0));
  (void)clock_.Update(kFree);
  clock_.Stop();
  Take(Make(0, Phase::kRunning, 8));
  Take(Make(1, Phase::kRunning, 8));
  EXPECT_EQ(clock_.Update(kFree).through, 8);
  EXPECT_TRUE(clock_.grant().final);
}

TEST_F(ClockTest, RefusesReportsThatDoNotMatchAndNamesThem) {
  for (const NodeIndex n : {0u, 1u, 2u}) Take(Make(n, Phase::kReady, 0, 2));
  (void)clock_.Update(kFree);
  EXPECT_EQ(clock_.Take(Make(7, Phase::kReady, 0)).error().Text(),
            "a report of node number 7 was refused: the roster has 3 nodes");
  EXPECT_THAT(clock_.Take(Make(1, Phase::kRunning, 3, 2)).error().Text(),
              Names("report of node 'b': … progress 3 … period 4 "));
  EXPECT_EQ(clock_.Take(Make(0, Phase::kRunning, 4, 1)).error().Text(),
            "report of node 'a': incarnation 1 was found, 2 is the living one");
  EXPECT_EQ(clock_.Take(Make(0, Phase::kRunning, 30, 2)).error().Text(),
            "report of node 'a': progress 30 was found, but only step 8 is granted");
  EXPECT_EQ(clock_.slowest_progress(), 0) << "none of them moved anything";
  EXPECT_TRUE(clock_.Take(Make(0, Phase::kRunning, 8, 2)).ok());
  EXPECT_TRUE(clock_.Take(Make(0, Phase::kRunning, 4, 2)).ok()) << "an overtaken report is no news";
  EXPECT_EQ(clock_.report(0).progress, 8);
}

TEST_F(ClockTest, TheFirstReasonOfAnAbortCounts) {
  clock_.Abort("the vehicle was killed");
  clock_.Abort("the view complained");
  EXPECT_TRUE(clock_.grant().abort);
  EXPECT_EQ(clock_.grant().reason, "the vehicle was killed");
}

}  // namespace
}  // namespace rodeira::lockstep
