// SPDX-License-Identifier: Apache-2.0
// The steps of each source: evenly spaced, or the gaps are named.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "common/data/record/audit.hpp"

namespace rodeira::record {
namespace {

TEST(StepAudit, EvenlySpacedSourcesAreWhole) {
  StepAudit audit;
  for (std::uint64_t step = 0; step <= 1000; step += 10) {
    audit.Add("vehicle/state", 3, step);
    if (step % 50 == 0) audit.Add("traffic/state", 4, step);
  }
  const auto found = audit.Finish();
  ASSERT_EQ(found.size(), 2u);
  const SourceAudit& vehicle = found.at({"vehicle/state", 3});
  EXPECT_TRUE(vehicle.whole());
  EXPECT_EQ(vehicle.first_step, 0u);
  EXPECT_EQ(vehicle.last_step, 1000u);
  EXPECT_EQ(vehicle.count, 101u);
  EXPECT_EQ(vehicle.period_steps, 10u);
  EXPECT_EQ(found.at({"traffic/state", 4}).period_steps, 50u);
}

TEST(StepAudit, NamesGapsRepetitionsAndStepsBack) {
  StepAudit audit;
  for (const std::uint64_t step : {0, 10, 20, 50, 60, 60, 40, 75}) audit.Add("t", 1, step);
  const SourceAudit found = audit.Finish().at({"t", 1});
  EXPECT_FALSE(found.whole());
  EXPECT_EQ(found.period_steps, 10u);
  EXPECT_EQ(found.gaps, (std::vector<StepGap>{{20, 50}, {60, 75}}));
  EXPECT_EQ(found.missing, 3u);  // 30 and 40; 70
  EXPECT_EQ(found.repeated, 1u);
  EXPECT_EQ(found.backward, 1u);
  EXPECT_EQ(found.count, 8u);
}

TEST(StepAudit, ADeclaredPeriodCounts) {
  StepAudit audit;
  audit.Declare("t", 1, 5);
  audit.Add("t", 1, 0);
  audit.Add("t", 1, 10);
  const SourceAudit found = audit.Finish().at({"t", 1});
  EXPECT_EQ(found.missing, 1u);
  EXPECT_EQ(found.gaps, (std::vector<StepGap>{{0, 10}}));
}

TEST(StepAudit, ASourceThatWasDeclaredAndNeverCameHasNone) {
  StepAudit audit;
  audit.Declare("t", 1, 5);
  EXPECT_EQ(audit.Finish().at({"t", 1}).count, 0u);
}

RC_GTEST_PROP(StepAudit, MissingIsWhatWasTakenAway, ()) {
  const auto period = *rc::gen::inRange<std::uint64_t>(1, 20);
  const auto count = *rc::gen::inRange<std::uint64_t>(4, 300);
  const auto drawn = *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(1, count - 1));
  const std::set<std::uint64_t> gone(drawn.begin(), drawn.end());
  StepAudit audit;
  audit.Declare("t", 1, period);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!gone.contains(i)) audit.Add("t", 1, i * period);
  }
  const SourceAudit found = audit.Finish().at({"t", 1});
  RC_ASSERT(found.missing == gone.size());
  RC_ASSERT(found.count == count - gone.size());
  RC_ASSERT(found.whole() == gone.empty());
}

}  // namespace
}  // namespace rodeira::record
