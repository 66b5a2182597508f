// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/mean_deviation.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

const std::vector<LaneChangeSign> kSigns{{150.0, 3.5}, {300.0, 0.0}};

// The basic path: it begins 30 m before the sign and is 10 m long.
TEST(MeanDeviation, TheReferenceIsStraightWithRamps) {
  for (const auto& [s, t] :
       {std::pair{0.0, 0.0}, {120.0, 0.0}, {125.0, 1.75}, {130.0, 3.5}, {269.0, 3.5}, {275.0, 1.75}, {400.0, 0.0}}) {
    EXPECT_NEAR(ReferenceAt(s, kSigns, {}), t, 1e-12) << s;
  }
}

// Without a change the deviation is the reference's area, 3.5 m times 150 m, over the stretch of 400 m. The samples are
// 7 m apart, so that the corners lie between them.
TEST(MeanDeviation, StayingInTheLaneIsTheAreaOfTheReference) {
  const auto s = Sampled(60.0, 1.0, [](double t) { return 7.0 * t; });
  const std::vector<double> stays(s.size(), 0.0);
  EXPECT_NEAR(*MeanDeviation(s, stays, 0.0, 400.0, kSigns, {}).value, 3.5 * 150.0 / 400.0, 1e-9);
  // 0.4 m to the left of the reference everywhere but there: |0.4 - 3.5|, with the ramps crossing it.
  const std::vector<double> left(s.size(), 0.4);
  double area = 0.0;
  for (int i = 0; i < 400'000; ++i) area += 0.001 * std::abs(0.4 - ReferenceAt(0.001 * (i + 0.5), kSigns, {}));
  EXPECT_NEAR(*MeanDeviation(s, left, 0.0, 400.0, kSigns, {}).value, area / 400.0, 1e-6);
}

// A wait does not count: the mean is over distance.
TEST(MeanDeviation, AWaitDoesNotCount) {
  std::vector<double> s, t;
  for (int i = 0; i <= 100; ++i) {
    for (int k = 0; k < (i == 30 ? 1000 : 1); ++k) {
      s.push_back(4.0 * i);
      t.push_back(0.01 * i);
    }
  }
  EXPECT_NEAR(*MeanDeviation(s, t, 0.0, 100.0, kSigns, {}).value, 0.125, 1e-9);
}

TEST(MeanDeviation, WrongLanesAreCounted) {
  const auto s = Sampled(60.0, 1.0, [](double t) { return 7.0 * t; });
  const std::vector<double> stays(s.size(), 0.0);
  EXPECT_EQ(*CorrectChanges(s, stays, kSigns, 1.75, 20.0).value, 0.5);
  EXPECT_FALSE(CorrectChanges(Series(s).first(5), Series(stays).first(5), kSigns, 1.75, 20.0).value);
  EXPECT_FALSE(MeanDeviation(s, stays, 1000.0, 2000.0, kSigns, {}).value);
}

}  // namespace
}  // namespace rodeira::measures
