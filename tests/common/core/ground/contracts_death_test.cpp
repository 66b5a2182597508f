// SPDX-License-Identifier: Apache-2.0
// Promises of callers: as many points as queries.
#include <gtest/gtest.h>

#include <array>

#include "common/core/ground/ground.hpp"

namespace rodeira::ground {
namespace {

TEST(ContractsDeathTest, ThereAreAsManyPointsAsQueries) {
  PlaneGround plane;
  std::array<GroundQuery, 3> queries;
  std::array<GroundPoint, 2> points;
  EXPECT_DEATH(plane.Query(queries, points), "queries.size\\(\\) == points.size\\(\\)");
}

TEST(ContractsDeathTest, APatchHasRowsAndAsManyPoints) {
  PlaneGround plane;
  std::array<GroundPoint, 4> points;
  GroundPatch patch;
  patch.along = patch.across = 2;
  plane.Patch(patch, points);
  EXPECT_TRUE(points[3].inside);
  patch.across = 3;
  EXPECT_DEATH(plane.Patch(patch, points), "patch.size");
  patch.across = 0;
  EXPECT_DEATH(plane.Patch(patch, {}), "patch.across >= 1");
}

}  // namespace
}  // namespace rodeira::ground
