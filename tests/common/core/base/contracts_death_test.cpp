// SPDX-License-Identifier: Apache-2.0
// What a caller promises, and what follows if it does not: the program ends with the promise on standard error.
#include <gtest/gtest.h>

#include "common/core/base/assert.hpp"
#include "common/core/base/result.hpp"

namespace rodeira::base {
namespace {

TEST(ContractsDeathTest, AnAssertionNamesConditionAndPlace) {
  const int three = 3;
  RODEIRA_ASSERT(three == 3);
  EXPECT_EXIT(RODEIRA_ASSERT(three == 4), testing::KilledBySignal(SIGABRT),
              "contracts_death_test.cpp:[0-9]+.*three == 4|three == 4.*contracts_death_test.cpp:[0-9]+");
}

TEST(ContractsDeathTest, AResultHasAValueOrAnError) {
  const Result<int> good = 7, bad = Failed("file.cannot_open", "closed");
  Result<int> bad_variable = bad;
  EXPECT_EQ(good.value(), 7);
  EXPECT_EQ(bad.error().id.text(), "file.cannot_open");
  EXPECT_DEATH((void)good.error(), "failed: !ok\\(\\)");
  EXPECT_DEATH((void)bad.value(), "failed: ok\\(\\)");
  EXPECT_DEATH((void)bad_variable.value(), "failed: ok\\(\\)");
  EXPECT_DEATH((void)Result<int>(bad).value(), "failed: ok\\(\\)");
  EXPECT_DEATH((void)Status().error(), "has_value");
}

}  // namespace
}  // namespace rodeira::base
