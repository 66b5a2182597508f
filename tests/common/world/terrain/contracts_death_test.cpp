// SPDX-License-Identifier: Apache-2.0
// Promises of callers: an elevation grid has two posts a way at least, an extent, and a height for each post.
#include <gtest/gtest.h>

#include <vector>

#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::terrain {
namespace {

TEST(ContractsDeathTest, AGridHasAnExtentAndAHeightForEachPost) {
  const std::vector<float> four(4, 1.0F);
  EXPECT_TRUE(ElevationGrid({2, 2, 0.0, 0.0, 1.0, 1.0}, four).At(0.5, 0.5).inside);
  EXPECT_DEATH(ElevationGrid({1, 4, 0.0, 0.0, 1.0, 1.0}, four), "frame_.columns >= 2");
  EXPECT_DEATH(ElevationGrid({4, 1, 0.0, 0.0, 1.0, 1.0}, four), "frame_.rows >= 2");
  EXPECT_DEATH(ElevationGrid({2, 2, 0.0, 0.0, 0.0, 1.0}, four), "frame_.east_m > frame_.west_m");
  EXPECT_DEATH(ElevationGrid({2, 2, 0.0, 1.0, 1.0, 0.0}, four), "frame_.north_m > frame_.south_m");
  EXPECT_DEATH(ElevationGrid({2, 3, 0.0, 0.0, 1.0, 1.0}, four), "heights_m_.size\\(\\)");
}

}  // namespace
}  // namespace rodeira::terrain
