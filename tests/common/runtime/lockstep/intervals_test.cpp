// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/intervals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace rodeira::lockstep {
namespace {

TEST(Intervals, OfNothingIsNothing) {
  const Intervals none;
  EXPECT_EQ(none.count(), 0u);
  EXPECT_EQ(none.Quantile(0.5), 0);
}

// Against the sorted lengths themselves.
RC_GTEST_PROP(Intervals, AQuantileIsAtMostAnEighthTooLong, ()) {
  auto lengths = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::int64_t>>(
      rc::gen::oneOf(rc::gen::inRange<std::int64_t>(0, 40), rc::gen::inRange<std::int64_t>(0, 100'000),
                     rc::gen::inRange<std::int64_t>(0, std::numeric_limits<std::int64_t>::max()))));
  const double share = static_cast<double>(*rc::gen::inRange(1, 101)) / 100.0;
  Intervals intervals;
  for (const std::int64_t length : lengths) intervals.Add(length);
  std::sort(lengths.begin(), lengths.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(lengths.size()) - 1e-9));
  const std::int64_t exact = lengths[std::max<std::size_t>(rank, 1) - 1];
  RC_ASSERT(intervals.count() == lengths.size());
  RC_ASSERT(intervals.Quantile(share) >= exact);
  RC_ASSERT(static_cast<double>(intervals.Quantile(share)) <= 1.125 * static_cast<double>(exact));
}

}  // namespace
}  // namespace rodeira::lockstep
