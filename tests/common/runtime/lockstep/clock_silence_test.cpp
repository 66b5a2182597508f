// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/clock_silence.hpp"

#include <gtest/gtest.h>

namespace rodeira::lockstep {
namespace {

constexpr std::int64_t kLimit_ms = 3000, kLook_ms = 25, kGap_ms = 300;

// Looks every 25 ms in (from, through]; the first time at which the clock counts as silent, or -1.
std::int64_t FirstSilent(ClockSilence& silence, std::int64_t from, std::int64_t through, bool receives) {
  for (std::int64_t now = from + kLook_ms; now <= through; now += kLook_ms) {
    if (silence.IsSilent(now, receives)) return now;
  }
  return -1;
}

TEST(ClockSilence, AClockThatWasNeverHeardIsNotSilent) {
  ClockSilence silence(kLimit_ms, kGap_ms);
  EXPECT_EQ(FirstSilent(silence, 0, 60'000, true), -1);
}

TEST(ClockSilence, BeginsBehindTheLimitAfterTheLastMessage) {
  ClockSilence silence(kLimit_ms, kGap_ms);
  silence.Heard(100);
  EXPECT_EQ(FirstSilent(silence, 100, 2'000, true), -1);
  silence.Heard(2'010);
  EXPECT_EQ(FirstSilent(silence, 2'010, 60'000, true), 2'010 + kLimit_ms + kLook_ms);
}

TEST(ClockSilence, TimeInWhichNothingCouldBeReceivedIsNotCounted) {
  ClockSilence silence(kLimit_ms, kGap_ms);
  silence.Heard(0);
  EXPECT_EQ(FirstSilent(silence, 0, 1'000, true), -1);
  EXPECT_EQ(FirstSilent(silence, 1'000, 50'000, false), -1) << "a step of 49 s holds the receiving thread";
  EXPECT_EQ(FirstSilent(silence, 50'000, 60'000, true), 50'000 + kLimit_ms - 1'000 + kLook_ms);
}

TEST(ClockSilence, TimeInWhichTheProcessDidNotRunIsNotCounted) {
  ClockSilence silence(kLimit_ms, kGap_ms);
  silence.Heard(0);
  EXPECT_FALSE(silence.IsSilent(25, true));
  EXPECT_FALSE(silence.IsSilent(40'000, true)) << "stopped for 40 s";
  EXPECT_EQ(FirstSilent(silence, 40'000, 60'000, true), 40'000 + kLimit_ms);
}

// A limit of several restarts of the clock changes nothing of what counts as a stop of this process.
TEST(ClockSilence, AStopIsNotCountedWhateverTheLimitIs) {
  ClockSilence silence(3 * kLimit_ms, kGap_ms);
  silence.Heard(0);
  for (std::int64_t now = 0; now <= 40'000; now += kGap_ms + 100) EXPECT_FALSE(silence.IsSilent(now, true)) << now;
  EXPECT_EQ(FirstSilent(silence, 40'000, 60'000, true), 40'000 + 3 * kLimit_ms + kLook_ms);
}

}  // namespace
}  // namespace rodeira::lockstep
