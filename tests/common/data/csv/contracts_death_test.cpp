// SPDX-License-Identifier: Apache-2.0
// The promise of a caller: a column of a .mat file takes values of its kind alone.
#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

#include "common/core/base/temporary_folder.hpp"
#include "common/data/csv/spilled_column.hpp"

namespace rodeira::csv {
namespace {

TEST(ContractsDeathTest, AColumnTakesValuesOfItsKind) {
  const auto folder = base::TemporaryFolder::Make("contracts");
  ASSERT_TRUE(folder.ok()) << folder.error().Text();
  auto spill = SpillFile::Create(folder.value().path());
  ASSERT_TRUE(spill.ok()) << spill.error().Text();
  SpilledColumn numbers("a", SpilledColumn::Kind::kNumbers), texts("b", SpilledColumn::Kind::kTexts);
  EXPECT_TRUE(numbers.Add(0.5, spill.value()).ok());
  EXPECT_TRUE(texts.Add(std::string_view("x"), spill.value()).ok());
  EXPECT_DEATH((void)texts.Add(0.5, spill.value()), "kNumbers");
  EXPECT_DEATH((void)numbers.Add(std::uint64_t{1}, spill.value()), "kWhole");
  EXPECT_DEATH((void)numbers.Add(std::string_view("x"), spill.value()), "kTexts");
}

}  // namespace
}  // namespace rodeira::csv
