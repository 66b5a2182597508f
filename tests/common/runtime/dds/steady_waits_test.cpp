// SPDX-License-Identifier: Apache-2.0
// Waits until a moment of the system time, as Fast DDS asks for them, last as long on the monotonic clock.
#include "common/runtime/dds/steady_waits.hpp"

#include <errno.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <semaphore.h>
#include <time.h>

#include <chrono>

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;

timespec SystemTimeIn(std::chrono::milliseconds from_now) {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  const auto ns = std::chrono::nanoseconds(from_now).count() + time.tv_nsec;
  time.tv_sec += ns / 1'000'000'000;
  time.tv_nsec = ns % 1'000'000'000;
  if (time.tv_nsec < 0) time.tv_sec -= 1, time.tv_nsec += 1'000'000'000;
  return time;
}

class SteadyWaits : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::sem_init(&semaphore_, 0, 0), 0); }
  void TearDown() override { ::sem_destroy(&semaphore_); }
  // How long a wait for what does not come lasts.
  std::chrono::nanoseconds Wait(std::chrono::milliseconds limit) {
    const timespec until = SystemTimeIn(limit);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(::sem_timedwait(&semaphore_, &until), -1);
    EXPECT_EQ(errno, ETIMEDOUT);
    return std::chrono::steady_clock::now() - begin;
  }
  sem_t semaphore_;
};

TEST_F(SteadyWaits, AreTheOnesOfTheWholeProgram) { EXPECT_TRUE(SharedWaitsAreSteady()); }

TEST_F(SteadyWaits, LastAsLongAsAskedFor) {
  EXPECT_GE(Wait(100ms), 99ms);
  const timespec until = SystemTimeIn(60'000ms);
  ASSERT_EQ(::sem_post(&semaphore_), 0);
  EXPECT_EQ(::sem_timedwait(&semaphore_, &until), 0) << "what is there is taken";
}

// A moment that has passed, or one that a jump of the system time has put years away, holds up no wait for long.
TEST_F(SteadyWaits, AreBoundedWhateverTheSystemTimeIs) {
  constexpr auto kYear = std::chrono::milliseconds(std::chrono::hours(24 * 365));
  (void)Wait(-66 * kYear);
  const auto lasted = Wait(74 * kYear);
  EXPECT_GE(lasted, 1999ms);
  EXPECT_LE(lasted, 60s) << "not years";
}

TEST_F(SteadyWaits, MutexesToo) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  const timespec years = SystemTimeIn(std::chrono::hours(24 * 365 * 74));
  ASSERT_EQ(::pthread_mutex_timedlock(&mutex, &years), 0);
  EXPECT_EQ(::pthread_mutex_timedlock(&mutex, &years), ETIMEDOUT);
  EXPECT_EQ(::pthread_mutex_unlock(&mutex), 0);
}

}  // namespace
}  // namespace rodeira::dds
