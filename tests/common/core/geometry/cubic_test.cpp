// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/cubic.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/core/base/random.hpp"

namespace rodeira::geometry {
namespace {

TEST(CubicTable, EachRecordHoldsUntilTheNext) {
  const CubicTable table({{0.0, 1.0, 0.0, 0.0, 0.0}, {10.0, 2.0, 0.5, 0.0, 0.0}, {10.0, 3.0, 0.5, 0.25, 0.125}});
  EXPECT_EQ(table.Value(-5.0), 1.0);
  EXPECT_EQ(table.Value(9.999), 1.0);
  EXPECT_EQ(table.Value(10.0), 3.0);  // of two at one place the last
  const CubicPoint at = table.Evaluate(12.0);
  EXPECT_EQ(at.value, 3.0 + 1.0 + 1.0 + 1.0);
  EXPECT_EQ(at.slope, 0.5 + 2.0 * 0.25 * 2.0 + 3.0 * 0.125 * 4.0);
  EXPECT_EQ(at.bend, 0.5 + 6.0 * 0.125 * 2.0);
  EXPECT_EQ(CubicTable().Value(3.0), 0.0);
  EXPECT_FALSE(table.zero());
  EXPECT_TRUE(CubicTable({{0.0, 0.0, 0.0, 0.0, 0.0}}).zero());
}

TEST(CubicTable, TheLastRecordThatBeginsNoLaterIsInForce) {
  for (std::uint64_t n = 0; n < 300; ++n) {
    std::vector<Cubic> records;
    double from = base::RandomUniform({n, 1}, -5.0, 5.0);
    for (std::uint64_t i = 0; i <= n % 40; ++i) {
      records.push_back({from, static_cast<double>(i), 0.0, 0.0, 0.0});
      if (base::RandomBits({n, i, 2}) % 4 != 0) from += base::RandomUniform({n, i, 3}, 0.0, 2.0);
    }
    const CubicTable table(records);
    const auto expect_in_force = [&](double x) {
      const auto later = std::find_if(records.begin() + 1, records.end(), [x](const Cubic& r) { return x < r.from; });
      EXPECT_EQ(table.Value(x), (later - 1)->a) << n << ", " << x;
    };
    for (const Cubic& record : records) {
      for (const double off : {-1e-9, 0.0, 1e-9}) expect_in_force(record.from + off);
    }
    expect_in_force(records.front().from - 10.0), expect_in_force(records.back().from + 10.0);
  }
}

TEST(CubicTable, BoundsHoldWhatSamplesFind) {
  for (std::uint64_t n = 0; n < 400; ++n) {
    std::vector<Cubic> records;
    for (std::uint64_t i = 0; i < 1 + n % 4; ++i) {
      const auto draw = [&](std::uint64_t k) { return base::RandomUniform({n, i, k}, -1.0, 1.0); };
      records.push_back(
          {3.0 * static_cast<double>(i), draw(0), draw(1), n % 3 == 0 ? 0.0 : draw(2), n % 2 == 0 ? 0.0 : draw(3)});
    }
    const CubicTable table(records);
    const double low = base::RandomUniform({n, 100}, -1.0, 6.0), high = low + base::RandomUniform({n, 101}, 0.0, 8.0);
    double smallest, largest;
    table.Bounds(low, high, smallest, largest);
    double least = table.Value(low), most = least;
    for (int i = 0; i <= 4000; ++i) {
      const double value = table.Value(low + (high - low) * i / 4000);
      least = std::min(least, value), most = std::max(most, value);
    }
    EXPECT_LE(smallest, least + 1e-9) << n;
    EXPECT_GE(largest, most - 1e-9) << n;
    EXPECT_GE(smallest, least - 0.4) << n;  // at a jump between records the left limit counts too
    if (records.size() == 1) {
      EXPECT_NEAR(smallest, least, 1e-3 * (1.0 + most - least)) << n;
      EXPECT_NEAR(largest, most, 1e-3 * (1.0 + most - least)) << n;
    }
  }
}

}  // namespace
}  // namespace rodeira::geometry
