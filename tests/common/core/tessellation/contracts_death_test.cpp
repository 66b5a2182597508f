// SPDX-License-Identifier: Apache-2.0
// The promise of a caller of the triangulation: a square of a size that its arithmetic holds.
#include <gtest/gtest.h>

#include <cstdint>

#include "common/core/tessellation/triangulation.hpp"

namespace rodeira::tessellation {
namespace {

TEST(ContractsDeathTest, ASquareHasASizeThatItsArithmeticHolds) {
  EXPECT_EQ(Triangulation(GridPoint::kMost).triangles().size(), 2U);
  for (const std::int32_t size : {0, -1, GridPoint::kMost + 1})
    EXPECT_DEATH(Triangulation{size}, "size > 0 && size <= GridPoint::kMost");
}

}  // namespace
}  // namespace rodeira::tessellation
