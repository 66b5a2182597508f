// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>

#include "common/core/base/random.hpp"

namespace rodeira::lockstep {
namespace {

TEST(Ring, IsADeque) {
  Ring<std::uint64_t> ring;
  std::deque<std::uint64_t> deque;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const std::uint64_t drawn = base::RandomBits({1, i});
    const bool grows = (i / 500) % 2 == 0;
    if (drawn % 10 == 0) {
      ring.resize(ring.size() + 3);
      deque.resize(deque.size() + 3);
    } else if (drawn % 3 == (grows ? 0 : 1) || drawn % 3 == 2) {
      if (!deque.empty()) ring.pop_front(), deque.pop_front();
    } else {
      ring.push_back(drawn);
      deque.push_back(drawn);
    }
    ASSERT_EQ(ring.size(), deque.size());
    if (!deque.empty()) {
      ASSERT_EQ(ring.front(), deque.front());
      ASSERT_EQ(ring.back(), deque.back());
      const std::size_t at = drawn % deque.size();
      ASSERT_EQ(ring[at], deque[at]);
    }
    if (i % 100 == 0) {
      ASSERT_TRUE(std::equal(ring.begin(), ring.end(), deque.begin(), deque.end()));
    }
  }
}

TEST(Ring, FindsByBisection) {
  Ring<int> ring;
  for (int i = 0; i < 13; ++i) ring.push_back(i);
  for (int i = 0; i < 5; ++i) ring.pop_front();
  for (int i = 13; i < 20; ++i) ring.push_back(i);
  EXPECT_EQ(*std::lower_bound(ring.begin(), ring.end(), 17), 17);
  EXPECT_EQ(std::lower_bound(ring.begin(), ring.end(), 99), ring.end());
}

TEST(Ring, LetsGoOfWhatIsTakenOut) {
  Ring<std::shared_ptr<int>> ring;
  const auto kept = std::make_shared<int>(1);
  for (int i = 0; i < 5; ++i) ring.push_back(kept);
  while (!ring.empty()) ring.pop_front();
  EXPECT_EQ(kept.use_count(), 1);
}

TEST(RingDeathTest, NothingIsTakenFromAnEmptyOneAndNoneGetsShorter) {
  Ring<int> ring;
  EXPECT_DEATH(ring.pop_front(), "size_ > 0");
  ring.push_back(1);
  EXPECT_DEATH(ring.resize(0), "size >= size_");
}

}  // namespace
}  // namespace rodeira::lockstep
