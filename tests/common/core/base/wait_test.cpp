// SPDX-License-Identifier: Apache-2.0
// What waits for what since when.
#include "common/core/base/wait.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "common/core/base/crash_trace.hpp"

namespace rodeira::base {
namespace {

using namespace std::chrono_literals;
using ::testing::StartsWith;

TEST(Wait, TheLongestIsNamed) {
  EXPECT_EQ(LongestWait(0ms), "");
  {
    const WaitNote first("the road server's world");
    std::thread([] {
      const WaitNote second("the clock");
      EXPECT_THAT(LongestWait(0ms), StartsWith("waits for the road server's world since 0."));
    }).join();
    EXPECT_THAT(LongestWait(0ms), StartsWith("waits for the road server's world since 0."));
    EXPECT_EQ(LongestWait(1h), "") << "what is brief is not worth a word";
  }
  EXPECT_EQ(LongestWait(0ms), "");
}

// Nodes that share a process: each has the waits of the threads that work for it.
TEST(Wait, EachNodeHasItsOwn) {
  const NodeCall road("road");
  const WaitNote first("its world");
  std::thread([] {
    const NodeCall ego("ego");
    const WaitNote second("the clock's first grant");
    EXPECT_THAT(LongestWait(0ms, "road"), StartsWith("waits for its world since 0."));
    EXPECT_THAT(LongestWait(0ms, "ego"), StartsWith("waits for the clock's first grant since 0."));
    EXPECT_EQ(LongestWait(0ms, "driver"), "");
    EXPECT_EQ(LongestWait(0ms), "") << "these threads work for nodes";
  }).join();
  EXPECT_EQ(LongestWait(0ms, "ego"), "");
}

// Notes end in any order.
TEST(Wait, EachNoteTakesItselfAway) {
  auto first = std::make_unique<WaitNote>("a");
  auto second = std::make_unique<WaitNote>("b");
  auto third = std::make_unique<WaitNote>("c");
  second.reset();
  EXPECT_THAT(LongestWait(0ms), StartsWith("waits for a "));
  first.reset();
  EXPECT_THAT(LongestWait(0ms), StartsWith("waits for c "));
  third.reset();
  EXPECT_EQ(LongestWait(0ms), "");
}

TEST(Wait, EndsAtItsLimitOrWithItsPredicate) {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::unique_lock lock(mutex);
  EXPECT_FALSE(WaitFor(changed, lock, 1ms, "nothing", [&] { return done; }));
  std::thread other([&] {
    const std::lock_guard guard(mutex);
    done = true;
    changed.notify_all();
  });
  EXPECT_TRUE(WaitFor(changed, lock, 1h, "the other thread", [&] { return done; }));
  lock.unlock();
  other.join();
}

}  // namespace
}  // namespace rodeira::base
