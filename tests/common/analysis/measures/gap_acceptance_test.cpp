// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/gap_acceptance.hpp"

#include <gtest/gtest.h>

#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// Drivers of one critical gap of 5 s: all rejected ones are shorter, all accepted ones longer.
TEST(GapAcceptance, DriversOfOneCriticalGap) {
  std::vector<GapDecision> drivers;
  std::vector<double> accepted, rejected;
  for (int i = 1; i <= 40; ++i) {
    drivers.push_back({5.0 + 0.01 * i, 5.0 - 0.01 * (41 - i)});
    accepted.push_back(drivers.back().accepted_s);
    rejected.push_back(drivers.back().largest_rejected_s);
  }
  EXPECT_NEAR(*RaffCriticalGap(accepted, rejected).value, 5.0, 0.011);
  EXPECT_NEAR(*TroutbeckCriticalGap(drivers).value, 5.0, 0.011);
  EXPECT_EQ(InconsistentDrivers(drivers), 0u);
}

// Critical gaps that are lognormal (median 4.2 s, sigma 0.25) among gaps offered in steps of 0.5 s: the estimate finds
// their mean, exp(mu + sigma^2 / 2).
TEST(GapAcceptance, MaximumLikelihoodFindsTheMean) {
  std::vector<GapDecision> drivers;
  int k = 0;
  for (const double z : NormalNumbers(400, 0.25)) {
    const double critical = 4.2 * std::exp(z), offset = 0.05 * (k++ % 10);
    const double below = std::floor((critical - offset) / 0.5) * 0.5 + offset;
    drivers.push_back({below + 0.5, below});
  }
  EXPECT_NEAR(*TroutbeckCriticalGap(drivers).value, 4.2 * std::exp(0.5 * 0.25 * 0.25), 0.03);
}

TEST(GapAcceptance, InconsistentDriversAreCountedAndNothingIsMissing) {
  const std::vector<GapDecision> drivers{{4.0, 6.0}, {6.0, 4.0}, {5.5, 4.5}};
  EXPECT_EQ(InconsistentDrivers(drivers), 1u);
  const Measure m = TroutbeckCriticalGap(drivers);
  EXPECT_EQ(m.n, 2u);
  EXPECT_EQ(m.options[1], (UsedOption{"inconsistent_drivers", "1"}));
  EXPECT_FALSE(RaffCriticalGap(std::vector<double>{5.0}, {}).value);
  EXPECT_FALSE(TroutbeckCriticalGap(std::vector<GapDecision>{{5.0, 0.0}}).value);
}

}  // namespace
}  // namespace rodeira::measures
