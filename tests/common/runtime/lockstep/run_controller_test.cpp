// SPDX-License-Identifier: Apache-2.0
// The operator's commands against a clock, in simulated wall time.
#include "common/runtime/lockstep/run_controller.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/runtime/lockstep/named_node.hpp"
#include "tests/names.hpp"

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class RunControllerTest : public ::testing::Test {
 protected:
  static Wall At(std::int64_t ms) { return {1000 * kMs + ms * kMs, 5'000'000 * kMs + ms * kMs}; }
  void Report(Phase phase, Step progress) {
    lockstep::Report report;
    report.phase = phase;
    report.progress = progress;
    ASSERT_TRUE(clock_.Take(report).ok());
  }
  // The node runs all that is granted at once.
  Step Update(std::int64_t ms) {
    const Step through = controller_.Update(At(ms)).through;
    Report(Phase::kRunning, through + 1);
    return through;
  }
  base::Result<std::string> Do(Command::Kind kind, std::int64_t ms, Step steps = 1, double pace = 0.0,
                               std::string text = "") {
    Command command;
    command.kind = kind;
    command.steps = steps;
    command.pace = pace;
    command.text = std::move(text);
    return controller_.Do(command, At(ms));
  }
  std::string Said(Command::Kind kind, std::int64_t ms, Step steps = 1, double pace = 0.0) {
    const auto done = Do(kind, ms, steps, pace);
    return done ? done.value() : "failed: " + done.error().Text();
  }

  const Roster roster_ = Roster::Create(kMs, 8, {{"a", "t", Role::kStepped, 1, 0, 0, {"x"}, {}}}).value();
  Clock clock_{roster_, 10'000};
  RunController controller_{clock_, Pacer(kMs, 1.0)};
};

using Kind = Command::Kind;

TEST_F(RunControllerTest, PauseStepAndResumeMoveTheGrantAndNothingElse) {
  Report(Phase::kReady, 0);
  EXPECT_EQ(Update(0), 0);
  EXPECT_EQ(Update(5), 5);
  EXPECT_EQ(Said(Kind::kPause, 5), "paused at step 5 (0.005 s)");
  EXPECT_EQ(Update(100), 5);
  EXPECT_EQ(Said(Kind::kStep, 100), "1 step from step 5 (0.005 s)");
  EXPECT_EQ(Update(101), 6);
  EXPECT_EQ(Update(200), 6);
  EXPECT_EQ(Said(Kind::kStep, 200, 20), "20 steps from step 6 (0.006 s)");
  EXPECT_EQ(Update(201), 15) << "window 8 from the next activation, 7";
  EXPECT_EQ(Update(202), 24);
  EXPECT_EQ(Update(203), 26);
  EXPECT_EQ(Update(300), 26);
  EXPECT_EQ(Said(Kind::kResume, 300), "runs in real time at step 26 (0.026 s)");
  EXPECT_EQ(Update(304), 30);
  EXPECT_EQ(controller_.pacer().slipped_ns(), 0);
  EXPECT_EQ(controller_.pacer().lateness().late, 7u)
      << "1 to 4 and 27 to 29, looked at too late; none of those that the operator held";
}

TEST_F(RunControllerTest, AStepOfARunningRunPausesIt) {
  Report(Phase::kReady, 0);
  (void)Update(0);
  EXPECT_EQ(Update(3), 3);
  EXPECT_EQ(Said(Kind::kStep, 3, 2), "2 steps from step 3 (0.003 s)");
  EXPECT_EQ(Update(50), 5);
  EXPECT_EQ(Update(90), 5);
  EXPECT_TRUE(controller_.pacer().paused());
}

TEST_F(RunControllerTest, PacesAndTheirLadder) {
  Report(Phase::kReady, 0);
  (void)Update(0);
  EXPECT_EQ(Said(Kind::kPace, 0, 1, 0.5), "runs at 0.5 × real time at step 0 (0.000 s)");
  EXPECT_EQ(Update(10), 5);
  EXPECT_EQ(Said(Kind::kFaster, 10), "runs in real time at step 5 (0.005 s)");
  for (int i = 0; i < 4; ++i) (void)Said(Kind::kFaster, 10);
  EXPECT_EQ(controller_.pacer().pace(), 16.0);
  EXPECT_EQ(Said(Kind::kFaster, 10), "runs as fast as it can at step 5 (0.005 s)");
  EXPECT_EQ(Said(Kind::kSlower, 10), "runs at 16 × real time at step 5 (0.005 s)");
  for (int i = 0; i < 20; ++i) (void)Said(Kind::kSlower, 10);
  EXPECT_EQ(controller_.pacer().pace(), 1.0 / 64.0);
  EXPECT_EQ(Said(Kind::kToggle, 10), "paused at step 5 (0.005 s)");
  EXPECT_EQ(Said(Kind::kToggle, 11), "runs at 0.015625 × real time at step 5 (0.005 s)");
}

TEST_F(RunControllerTest, WhatTheRunCannotDoIsASentence) {
  EXPECT_EQ(Said(Kind::kPause, 0), "failed: the run has not begun; it waits for a");
  EXPECT_EQ(Said(Kind::kMark, 0), "failed: the run has not begun; it waits for a");
  Report(Phase::kReady, 0);
  (void)Update(0);
  (void)Update(4);
  EXPECT_EQ(Said(Kind::kStop, 5), "stops after step 4 (0.004 s)");
  EXPECT_TRUE(clock_.grant().final);
  EXPECT_EQ(Said(Kind::kResume, 6), "failed: the run is ending at step 4 (0.004 s)");
  EXPECT_EQ(Said(Kind::kStop, 6), "failed: the run is ending at step 4 (0.004 s)");
  EXPECT_EQ(Said(Kind::kState, 6), "is ending at step 4 (0.004 s)");
  controller_.Abort("a fault", At(7));
  EXPECT_EQ(Said(Kind::kState, 8), "failed: the run has failed: a fault");
}

TEST_F(RunControllerTest, ARestartOfAnUnknownNodeIsWrongInputAtAnyTime) {
  const auto restart = [&](const std::string& name) { return Do(Kind::kRestart, 0, 1, 0.0, name); };
  for (const bool begun : {false, true}) {
    if (begun) {
      Report(Phase::kReady, 0);
      (void)Update(0);
    }
    const auto unknown = restart("b");
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().exit_status(), 2);
    EXPECT_THAT(unknown.error(), IsError("launch.unknown_node", "restart: … 'b' … known are a"));
    const auto known = restart("a");
    ASSERT_FALSE(known.ok()) << "a run of one process";
    EXPECT_EQ(known.error().exit_status(), 1);
  }
}

TEST(NamedNodeTest, TheNearestNameIsGiven) {
  const Roster roster = Roster::Create(kMs, 8,
                                       {{"ego", "t", Role::kStepped, 1, 0, 0, {"x"}, {}},
                                        {"driver", "t", Role::kStepped, 1, 0, 0, {"x"}, {}}})
                            .value();
  EXPECT_EQ(NamedNode(roster, "driver").value(), 1u);
  EXPECT_THAT(NamedNode(roster, "drivr").error(), IsError("launch.unknown_node", "restart: … 'drivr' … 'driver'"));
}

TEST_F(RunControllerTest, AStopBeforeTheFirstStepAborts) {
  EXPECT_EQ(Said(Kind::kStop, 0), "stopped before the first step");
  EXPECT_TRUE(clock_.grant().abort);
}

TEST_F(RunControllerTest, TheLogTellsWhenEachStepWasGrantedAndWhatWasDone) {
  Report(Phase::kReady, 0);
  (void)Update(40);
  (void)Update(43);
  ASSERT_TRUE(Do(Kind::kMark, 43, 1, 0.0, "a deer").ok());
  (void)Said(Kind::kPause, 44);
  (void)Said(Kind::kStep, 50);
  (void)Update(51);
  (void)Said(Kind::kStop, 60);
  controller_.CloseLog(At(61));
  const auto batch = controller_.log().Take(At(61).monotonic_ns);
  ASSERT_TRUE(batch.has_value());
  EXPECT_TRUE(batch->last);
  EXPECT_EQ(batch->walls, (std::vector<WallTime>{{-1, 0, At(40).utc_ns, 0, 0, 1.0, false},
                                                 {0, 3, At(43).utc_ns, 3 * kMs, 0, 1.0, false},
                                                 {3, 4, At(51).utc_ns, 11 * kMs, 0, 1.0, true}}));
  std::string told;
  for (const Remark& remark : batch->remarks)
    told += std::string(RemarkName(remark.kind)) + std::to_string(remark.step) + remark.text + " ";
  EXPECT_EQ(told, "start-1 mark3a deer pause3 step31 stop4 end4 ");
  EXPECT_EQ(batch->remarks[1].number, 2u);
  EXPECT_EQ(batch->remarks[1].utc_ns, At(43).utc_ns);
  EXPECT_EQ(batch->remarks[1].monotonic_ns, 3 * kMs);
  EXPECT_FALSE(controller_.log().Take(At(9999).monotonic_ns).has_value()) << "nothing follows the last";
}

TEST_F(RunControllerTest, AFaultClosesTheLog) {
  Report(Phase::kReady, 0);
  (void)Update(0);
  controller_.Abort("node 'a' was killed", At(5));
  controller_.Abort("what follows from it", At(6));
  controller_.CloseLog(At(7));
  const auto batch = controller_.log().Take(At(7).monotonic_ns).value();
  ASSERT_EQ(batch.remarks.size(), 2u);
  EXPECT_EQ(batch.remarks[1].kind, RemarkKind::kFault);
  EXPECT_EQ(batch.remarks[1].text, "node 'a' was killed");
  EXPECT_TRUE(batch.last);
}

TEST_F(RunControllerTest, AtTheLastStepTimeIsNotLateAnyMore) {
  Clock clock(roster_, 3);
  RunController controller(clock, Pacer(kMs, 1.0));
  lockstep::Report report;
  report.phase = Phase::kReady;
  ASSERT_TRUE(clock.Take(report).ok());
  for (int t = 0; t <= 3; ++t) (void)controller.Update(At(t));
  EXPECT_TRUE(clock.grant().final);
  (void)controller.Update(At(500));
  EXPECT_EQ(controller.pacer().slipped_ns(), 0) << "closing files takes time and is nobody's lateness";
  EXPECT_EQ(controller.NextDueIn(At(500)), 0);
}

// Of a PC that slept only one clock tells; of a process that was stopped all do.
TEST_F(RunControllerTest, ARunInRealTimeIsPausedWhereItSlept) {
  Report(Phase::kReady, 0);
  EXPECT_EQ(Update(0), 0);
  EXPECT_EQ(Update(5), 5);
  Wall awake = At(6);
  awake.awake_and_asleep_ns = 40'000 * kMs;
  (void)controller_.Update(At(5));
  const Step stands = controller_.Update(awake).through;
  EXPECT_TRUE(controller_.pacer().paused());
  EXPECT_EQ(controller_.TakeWarning(),
            "this PC slept, or the clock was stopped, for 40 s: the run is paused at step 5 (0.005 s)");
  EXPECT_EQ(controller_.TakeWarning(), "") << "once";
  EXPECT_EQ(controller_.Update(awake).through, stands);
  EXPECT_EQ(Said(Kind::kResume, 6).substr(0, 17), "runs in real time");
  EXPECT_GT(Update(9), stands);
  EXPECT_EQ(Update(9 + 9'999), Update(9 + 9'999)) << "a clock that was held up for less goes on";
  EXPECT_FALSE(controller_.pacer().paused());
  (void)Update(9 + 9'999 + 10'000);
  EXPECT_TRUE(controller_.pacer().paused());
}

TEST_F(RunControllerTest, ARunAsFastAsItCanGoesOnWhereItSlept) {
  Report(Phase::kReady, 0);
  (void)Update(0);
  (void)Said(Kind::kPace, 1, 1, 0.0);
  (void)Update(2);
  (void)Update(60'000);
  EXPECT_FALSE(controller_.pacer().paused());
  EXPECT_EQ(controller_.TakeWarning(), "");
}

}  // namespace
}  // namespace rodeira::lockstep
