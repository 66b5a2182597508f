// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/thread_pool.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace rodeira::base
