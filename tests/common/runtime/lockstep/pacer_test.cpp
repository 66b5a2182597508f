// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pacer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr Step kFar = 1'000'000;

// As the clock does: what the pace and the nodes allow is granted.
Step Grant(Pacer& pacer, std::int64_t now_ns, Step window_limit) {
  const Step through = std::min(pacer.Limit(now_ns, window_limit), window_limit);
  pacer.Granted(now_ns, through);
  return through;
}

TEST(Pacer, RealTimeGrantsAStepAMillisecond) {
  Pacer pacer(kMs, 1.0);
  EXPECT_EQ(pacer.Limit(5 * kMs, kFar), 0) << "the first call is time zero";
  EXPECT_EQ(pacer.Limit(6 * kMs - 1, kFar), 0);
  EXPECT_EQ(pacer.NextDueIn(5 * kMs + kMs / 4), 3 * kMs / 4);
  EXPECT_EQ(pacer.Limit(6 * kMs, kFar), 1);
  EXPECT_EQ(pacer.Limit(1005 * kMs, kFar), 1000);
  EXPECT_EQ(pacer.slipped_ns(), 0);
}

TEST(Pacer, SlowMotionAndTimeLapse) {
  Pacer slow(kMs, 0.5);
  (void)slow.Limit(0, kFar);
  EXPECT_EQ(slow.Limit(100 * kMs, kFar), 50);
  Pacer fast(kMs, 4.0);
  (void)fast.Limit(0, kFar);
  EXPECT_EQ(fast.Limit(100 * kMs, kFar), 400);
  Pacer free(kMs, 0.0);
  EXPECT_EQ(free.Limit(0, kFar), std::numeric_limits<Step>::max());
}

TEST(Pacer, LateItSlipsAndNeverRaces) {
  Pacer pacer(kMs, 1.0);
  (void)pacer.Limit(0, 20);
  EXPECT_EQ(pacer.Limit(100 * kMs, 20), 20) << "the nodes were slow: 80 ms are given up";
  EXPECT_EQ(pacer.slipped_ns(), 80 * kMs);
  EXPECT_EQ(pacer.Limit(101 * kMs, 1000), 21) << "from here on time runs at its pace, without catching up";
  EXPECT_EQ(pacer.Limit(150 * kMs, 1000), 70);
  EXPECT_EQ(pacer.slips(), 1u);
}

TEST(Pacer, PauseStopsTimeAndResumeGoesOnFromThere) {
  Pacer pacer(kMs, 1.0);
  (void)Grant(pacer, 0, kFar);
  EXPECT_EQ(Grant(pacer, 10 * kMs, kFar), 10);
  pacer.Pause(10 * kMs);
  EXPECT_EQ(Grant(pacer, 500 * kMs, kFar), 10);
  EXPECT_EQ(pacer.NextDueIn(500 * kMs), 0);
  pacer.Resume(500 * kMs);
  EXPECT_EQ(Grant(pacer, 505 * kMs, kFar), 15);
  pacer.SetPace(505 * kMs, 2.0);
  EXPECT_EQ(Grant(pacer, 510 * kMs, kFar), 25);
  EXPECT_EQ(pacer.PausedNs(510 * kMs), 490 * kMs);
  EXPECT_EQ(pacer.slipped_ns(), 0) << "a pause is not late";
}

TEST(Pacer, APauseHoldsWhatIsGrantedAtAnyPace) {
  for (const double pace : {0.0, 1.0}) {
    Pacer pacer(kMs, pace, 0);
    (void)Grant(pacer, 0, 7);
    const Step held = Grant(pacer, 20 * kMs, 7);
    EXPECT_EQ(held, 7);
    pacer.Pause(20 * kMs);
    EXPECT_EQ(pacer.Limit(90 * kMs, kFar), 7);
    pacer.AllowSteps(3);
    EXPECT_EQ(Grant(pacer, 91 * kMs, kFar), 10);
    EXPECT_EQ(Grant(pacer, 99 * kMs, kFar), 10);
    pacer.AllowSteps(1000);
    EXPECT_EQ(Grant(pacer, 100 * kMs, 30), 30) << "the nodes' window holds for single steps too";
    pacer.Pause(100 * kMs);
    EXPECT_EQ(Grant(pacer, 101 * kMs, kFar), 30) << "a second pause ends what was left of them";
    pacer.Resume(200 * kMs);
    EXPECT_EQ(pacer.Limit(205 * kMs, kFar), pace > 0.0 ? 35 : std::numeric_limits<Step>::max());
  }
}

TEST(Pacer, ANewPaceGoesOnFromWhatIsGranted) {
  Pacer pacer(kMs, 0.0);
  EXPECT_EQ(Grant(pacer, 0, 500), 500) << "as fast as it can";
  pacer.SetPace(3 * kMs, 1.0);
  EXPECT_EQ(Grant(pacer, 13 * kMs, kFar), 510) << "real time from there, not from the beginning";
  pacer.SetPace(13 * kMs, 0.25);
  EXPECT_EQ(Grant(pacer, 53 * kMs, kFar), 520);
  EXPECT_EQ(pacer.slipped_ns(), 0);
}

TEST(Pacer, LatenessIsMeasuredAgainstWhatWasDue) {
  Pacer pacer(kMs, 1.0);
  (void)Grant(pacer, 0, kFar);
  for (int k = 1; k <= 10; ++k) (void)Grant(pacer, k * kMs + kMs / 4, kFar);
  EXPECT_EQ(pacer.lateness().steps, 11u);
  EXPECT_EQ(pacer.lateness().late, 0u) << "a quarter of a step is not late";
  EXPECT_EQ(pacer.lateness().worst_ns, kMs / 4);
  EXPECT_EQ(pacer.lateness().total_ns, 10 * kMs / 4);
  // The clock slept: 11 to 14 come at 14.25 ms; they were due at 11, 12, 13 and 14.
  (void)Grant(pacer, 14 * kMs + kMs / 4, kFar);
  EXPECT_EQ(pacer.lateness().late, 3u);
  EXPECT_EQ(pacer.lateness().worst_ns, 3 * kMs + kMs / 4);
  EXPECT_EQ(pacer.late_ns(), kMs / 4) << "of the newest";
}

TEST(Pacer, StepsThatWaitForSlowNodesAreLateBySoMuch) {
  Pacer pacer(kMs, 1.0);
  (void)Grant(pacer, 0, 5);
  EXPECT_EQ(Grant(pacer, 5 * kMs, 5), 5);
  const auto before = pacer.lateness();
  // For 20 ms the nodes report nothing; the clock looks every 2 ms.
  for (int t = 7; t <= 25; t += 2) EXPECT_EQ(Grant(pacer, t * kMs, 5), 5);
  EXPECT_EQ(pacer.slipped_ns(), 20 * kMs);
  EXPECT_EQ(Grant(pacer, 26 * kMs, 10), 6) << "late, and no race to catch up";
  EXPECT_EQ(pacer.late_ns(), 20 * kMs) << "step 6 was due at 6 ms and came at 26";
  EXPECT_EQ(pacer.lateness().steps, before.steps + 1);
  EXPECT_EQ(pacer.lateness().worst_ns, 20 * kMs);
  EXPECT_EQ(Grant(pacer, 27 * kMs, 10), 7);
  EXPECT_EQ(pacer.late_ns(), 0) << "what is behind is due later by what was given up";
}

// A node that is started again pulls the window below what was granted. Time stands meanwhile, whatever came before: a
// pause, a new pace, a restarted clock; and goes on from what was granted at once when all are there
// again.
TEST(Pacer, WhileANodeComputesAgainTimeStandsAndNoMoreIsGivenUpThanPassed) {
  for (const char* before : {"nothing", "a pause", "a new pace", "another clock"}) {
    SCOPED_TRACE(before);
    Pacer pacer(kMs, 0.5);
    (void)Grant(pacer, 0, kFar);
    EXPECT_EQ(Grant(pacer, 1000 * kMs, kFar), 500);
    if (before == std::string_view("a pause")) {
      pacer.Pause(1000 * kMs);
      pacer.Resume(1000 * kMs);
    }
    if (before == std::string_view("a new pace")) pacer.SetPace(1000 * kMs, 0.5);
    if (before == std::string_view("another clock")) {
      pacer = Pacer(kMs, 0.5);
      pacer.ContinueFrom(1000 * kMs, 500);
    }
    for (std::int64_t t = 1001; t <= 3000; ++t) EXPECT_LE(Grant(pacer, t * kMs, 300), 500);
    EXPECT_NEAR(static_cast<double>(pacer.slipped_ns()), 2000.0 * kMs, 2.0 * kMs) << "what passed, and that once";
    EXPECT_NEAR(static_cast<double>(Grant(pacer, 3100 * kMs, kFar)), 550.0, 1.0);
    EXPECT_NEAR(static_cast<double>(Grant(pacer, 4000 * kMs, kFar)), 1000.0, 1.0);
    EXPECT_NEAR(static_cast<double>(pacer.slipped_ns()), 2000.0 * kMs, 2.0 * kMs);
  }
}

TEST(Pacer, NoStepIsLateAtFullSpeed) {
  Pacer pacer(kMs, 0.0);
  for (int k = 0; k < 10; ++k) (void)Grant(pacer, k * 50 * kMs, 20 * k);
  EXPECT_EQ(pacer.lateness().steps, 0u);
  EXPECT_EQ(pacer.lateness().mean_ns(), 0.0);
}

}  // namespace
}  // namespace rodeira::lockstep
