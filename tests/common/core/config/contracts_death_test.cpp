// SPDX-License-Identifier: Apache-2.0
// Promises of callers: indices of lists, declarations of keys.
#include <gtest/gtest.h>

#include "common/core/config/config.hpp"
#include "common/core/config/schema.hpp"

namespace rodeira::config {
namespace {

TEST(ContractsDeathTest, AnIndexIsLessThanTheSizeOfTheList) {
  const auto file = File::Parse("list: [1, two, [3], {four: 4}]", "list.yaml");
  ASSERT_TRUE(file.ok());
  const List list = file.value().root().Items("list");
  ASSERT_EQ(list.size(), 4u);
  EXPECT_DEATH((void)list.Number(4), "index < size");
  EXPECT_DEATH((void)list.Text(4), "index < size");
  EXPECT_DEATH((void)list.Numbers(4), "index < size");
  EXPECT_DEATH((void)list.At(4), "index < size");
  EXPECT_EQ(list.Place(4), "list.yaml");
}

TEST(ContractsDeathTest, ADefaultIsAllowedItself) {
  EXPECT_DEATH((void)NumberKey("width_m", {0.0, 1.0}, 1.5, "Width."), "default_value");
  EXPECT_DEATH((void)IntegerKey("lanes", 1, 2, 3, "Lanes."), "default_value");
  EXPECT_DEATH((void)WordKey("side", {"left", "right"}, "up", "Side."), "words");
  EXPECT_DEATH((void)Counted(2, 1, ListKey("axes", NumberItem({}), "Axes.")), "low <= high");
}

}  // namespace
}  // namespace rodeira::config
