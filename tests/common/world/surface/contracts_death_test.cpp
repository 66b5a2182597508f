// SPDX-License-Identifier: Apache-2.0
// Promises of callers: a reference line has two points, a grid as many heights as rows and sections, a reach is above
// 0.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "common/world/surface/crg_reference_line.hpp"
#include "common/world/surface/crg_smooth.hpp"
#include "common/world/surface/crg_surface.hpp"

namespace rodeira::surface {
namespace {

// Three rows of two sections, all level.
CrgShape Level() {
  return {CrgReferenceLine(0.0, 1.0, {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}),
          {-1.0, 1.0},
          std::vector<double>(6, 0.0),
          std::vector<double>(3, 0.0),
          std::vector<double>(3, 0.0),
          {}};
}

TEST(ContractsDeathTest, AReferenceLineHasTwoPointsAndAStep) {
  EXPECT_DEATH(CrgReferenceLine(0.0, 1.0, {{0.0, 0.0}}), "points_.size\\(\\) >= 2 && step_m_ > 0.0");
  EXPECT_DEATH(CrgReferenceLine(0.0, 0.0, {{0.0, 0.0}, {1.0, 0.0}}), "points_.size\\(\\) >= 2 && step_m_ > 0.0");
}

TEST(ContractsDeathTest, AGridHasTwoSectionsAndARowForEachPointOfItsLine) {
  EXPECT_EQ(CrgSurface(Level()).rows(), 3U);
  CrgShape one_section = Level(), two_rows = Level(), five_heights = Level(), two_bankings = Level();
  one_section.v_m.pop_back();
  two_rows.line_z_m.pop_back();
  five_heights.heights.pop_back();
  two_bankings.banking.pop_back();
  EXPECT_DEATH(CrgSurface(std::move(one_section)), "sections >= 2");
  EXPECT_DEATH(CrgSurface(std::move(two_rows)), "rows\\(\\) == shape_.line.points_W");
  EXPECT_DEATH(CrgSurface(std::move(five_heights)), "shape_.heights.size\\(\\)");
  EXPECT_DEATH(CrgSurface(std::move(two_bankings)), "shape_.banking.size\\(\\)");
}

TEST(ContractsDeathTest, AGridIsSmoothedOverAReach) {
  const CrgSurface level(Level());
  EXPECT_EQ(Smoothed(level, 0.5).At(1.0, 0.0).z_m, 0.0);
  for (const double reach_m : {0.0, -1.0}) EXPECT_DEATH((void)Smoothed(level, reach_m), "reach_m > 0.0");
}

}  // namespace
}  // namespace rodeira::surface
