// SPDX-License-Identifier: Apache-2.0
// When vehicles of flows arrive: against the distributions' closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/traffic/demand/arrivals.hpp"
#include "tests/common/traffic/distance.hpp"

namespace rodeira::traffic {
namespace {

std::vector<double> Times(const FlowSettings& flow, std::uint64_t seed = 3, std::size_t most = 100000) {
  std::vector<double> times;
  std::int64_t at = 0;
  for (std::size_t i = 0; i < most; ++i) {
    at = NextArrival_ns(flow, seed, 5, i, at);
    if (at < 0) break;
    times.push_back(1e-9 * static_cast<double>(at));
  }
  return times;
}

std::vector<double> Gaps(const std::vector<double>& times) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back(times[i] - times[i - 1]);
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

// Gaps are exponential with mean 3600/q; numbers in minutes have a variance that is their mean.
TEST(Arrivals, PoissonGapsAreExponential) {
  FlowSettings flow;
  flow.per_h = {900.0};
  flow.to_s = 36000.0;
  const auto times = Times(flow);
  EXPECT_NEAR(static_cast<double>(times.size()), 9000.0, 4.0 * std::sqrt(9000.0));
  EXPECT_LT(Distance(Gaps(times), [](double gap) { return 1.0 - std::exp(-gap / 4.0); }), 1.63);
  std::vector<double> counts(600, 0.0);
  for (const double t : times) counts[std::min<std::size_t>(599, static_cast<std::size_t>(t / 60.0))] += 1.0;
  double mean = 0.0, square = 0.0;
  for (const double n : counts) mean += n / 600.0, square += n * n / 600.0;
  EXPECT_NEAR((square - mean * mean) / mean, 1.0, 4.0 * std::sqrt(2.0 / 600.0));
}

TEST(Arrivals, UniformGapsAreThoseOfTheSource) {
  FlowSettings flow;
  flow.arrivals = Arrivals::kUniform;
  const auto gaps = Gaps(Times(flow, 1, 5000));
  EXPECT_GE(gaps.front(), 3.0 - 1e-8);
  EXPECT_LE(gaps.back(), 8.0 + 1e-8);
  EXPECT_LT(Distance(gaps, [](double gap) { return (gap - 3.0) / 5.0; }), 1.63);
}

TEST(Arrivals, EvenGapsAreEqualAndBeginHalfAGapLate) {
  FlowSettings flow;
  flow.arrivals = Arrivals::kEven;
  flow.per_h = {720.0};
  flow.from_s = 100.0;
  flow.to_s = 200.0;
  const auto times = Times(flow);
  ASSERT_EQ(times.size(), 20u);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], 102.5 + 5.0 * static_cast<double>(i), 1e-6);
}

// Each hour its own number, and none where the hour says none.
TEST(Arrivals, EachHourHasItsOwn) {
  FlowSettings flow;
  flow.per_h = {300.0, 0.0, 1200.0};
  flow.to_s = 4.0 * 3600.0;
  std::vector<double> counts(4, 0.0);
  for (const double t : Times(flow)) counts[std::min<std::size_t>(3, static_cast<std::size_t>(t / 3600.0))] += 1.0;
  EXPECT_NEAR(counts[0], 300.0, 4.0 * std::sqrt(300.0));
  EXPECT_EQ(counts[1], 0.0);
  EXPECT_NEAR(counts[2], 1200.0, 4.0 * std::sqrt(1200.0));
  EXPECT_NEAR(counts[3], 1200.0, 4.0 * std::sqrt(1200.0)) << "the last one goes on";
  flow.arrivals = Arrivals::kEven;
  std::vector<double> even(4, 0.0);
  for (const double t : Times(flow)) even[std::min<std::size_t>(3, static_cast<std::size_t>(t / 3600.0))] += 1.0;
  EXPECT_EQ(even, (std::vector<double>{300.0, 0.0, 1200.0, 1200.0}));
}

TEST(Arrivals, SeedAndFlowDecide) {
  FlowSettings flow;
  flow.per_h = {100.0};
  EXPECT_EQ(NextArrival_ns(flow, 1, 2, 3, 4), NextArrival_ns(flow, 1, 2, 3, 4));
  EXPECT_NE(NextArrival_ns(flow, 1, 2, 3, 4), NextArrival_ns(flow, 2, 2, 3, 4));
  EXPECT_NE(NextArrival_ns(flow, 1, 2, 3, 4), NextArrival_ns(flow, 1, 3, 3, 4));
  EXPECT_NE(NextArrival_ns(flow, 1, 2, 3, 4), NextArrival_ns(flow, 1, 2, 4, 4));
}

}  // namespace
}  // namespace rodeira::traffic
