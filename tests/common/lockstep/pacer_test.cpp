#include "common/lockstep/pacer.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr Step kFar = 1'000'000;

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
  (void)pacer.Limit(0, kFar);
  pacer.Pause(10 * kMs);
  EXPECT_EQ(pacer.Limit(500 * kMs, kFar), 10);
  pacer.Resume(500 * kMs);
  EXPECT_EQ(pacer.Limit(505 * kMs, kFar), 15);
  pacer.SetPace(505 * kMs, 2.0);
  EXPECT_EQ(pacer.Limit(510 * kMs, kFar), 25);
}

}  // namespace
}  // namespace rodeira::lockstep
