// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace rodeira::base {
namespace {

// However many they are, and however little there is to do: each once, round after round, and all done when Share comes
// back.
TEST(ThreadPool, DoesEachPartOnceAndWaitsForAll) {
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const std::size_t count : {0u, 1u, 2u, 6u, 7u, 1000u}) {
      std::vector<int> done(count, 0);
      for (int round = 1; round <= 200; ++round) {
        pool.ParallelFor(count, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) ++done[i];
        });
        ASSERT_EQ(done, std::vector<int>(count, round)) << threads << " threads, " << count;
      }
    }
  }
}

TEST(ThreadPool, AnExceptionReachesTheCallerAndThePoolGoesOn) {
  ThreadPool pool(4);
  for (std::size_t at = 0; at < 8; ++at) {
    std::atomic<int> others = 0;
    const auto work = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (i == at) throw std::runtime_error("part " + std::to_string(at));
        ++others;
      }
    };
    try {
      pool.ParallelFor(8, work);
      FAIL() << at;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "part " + std::to_string(at));
    }
    EXPECT_GE(others, 6) << "the other parts are done when it is thrown";
    std::atomic<int> done = 0;
    pool.ParallelFor(8, [&](std::size_t begin, std::size_t end) { done += static_cast<int>(end - begin); });
    EXPECT_EQ(done, 8);
  }
}

}  // namespace
}  // namespace rodeira::base
