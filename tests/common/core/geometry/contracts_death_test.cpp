// SPDX-License-Identifier: Apache-2.0
// Promises of callers: what curves, profiles and tables are made of.
#include <gtest/gtest.h>

#include <limits>

#include "common/core/geometry/clothoid.hpp"
#include "common/core/geometry/clothoid_panel.hpp"
#include "common/core/geometry/cubic.hpp"
#include "common/core/geometry/near_grid.hpp"
#include "common/core/geometry/plan_axis.hpp"
#include "common/core/geometry/plan_curve.hpp"
#include "common/core/geometry/polyline.hpp"
#include "common/core/geometry/vertical_profile.hpp"

namespace rodeira::geometry {
namespace {

TEST(ContractsDeathTest, APlanHasPiecesWithALength) {
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  EXPECT_DEATH(PlanCurve(origin, 0.0, {}), "!pieces_.empty\\(\\)");
  EXPECT_DEATH(PlanCurve(origin, 0.0, {{0.0, 0.0, 0.0}}), "piece.length_m > 0");
  EXPECT_DEATH(PlanCurve(origin, 0.0, {{10.0, 0.0, 0.0}}, 0.0), "!pieces_.empty\\(\\) && reach_m > 0");
  EXPECT_DEATH(NearGrid({}, 1.0), "chords");
}

TEST(ContractsDeathTest, AnAxisHasElementsWithALengthAndAFiniteTurn) {
  const PlanElement line{.length_m = 10.0};
  EXPECT_TRUE(PlanAxis::Make({line}).has_value());
  EXPECT_DEATH((void)PlanAxis::Make({}), "!elements.empty\\(\\)");
  EXPECT_DEATH((void)PlanAxis::Make({line, PlanElement()}), "element.length_m > 0.0");
  EXPECT_FALSE(CutClothoid({}, 1e-4, 100.0).empty());
  EXPECT_DEATH((void)CutClothoid({}, 1e6, 1e5), "count < 1e7");
}

TEST(ContractsDeathTest, PointsOfAProfileAscend) {
  EXPECT_DEATH(VerticalProfile({}), "!points_.empty\\(\\)");
  EXPECT_DEATH(VerticalProfile({{5.0, 1.0, 0.0}, {5.0, 2.0, 0.0}, {9.0, 2.0, 0.0}}), "s_m > ");
  EXPECT_DEATH(VerticalProfile({{0.0, 1.0, 0.0}, {5.0, 2.0, -1.0}, {9.0, 2.0, 0.0}}), "parabola_m >= 0");
}

TEST(ContractsDeathTest, RecordsOfCubicsAscend) {
  EXPECT_DEATH(CubicTable({{5.0, 0.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0, 0.0}}), "is_sorted");
}

TEST(ContractsDeathTest, AClothoidTurnsAFiniteNumberOfTimes) {
  EXPECT_DEATH((void)ClothoidIntegral(1e8, 0.0, 1.0), "panels");
  EXPECT_DEATH((void)ClothoidIntegral(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0), "panels");
}

TEST(ContractsDeathTest, LinesAreScaledByPositiveFactorsAndJoinedByName) {
  EXPECT_DEATH((void)Scaled({}, 0.0, 1.0, Eigen::Vector3d::Zero()), "plan_factor > 0");
  EXPECT_DEATH((void)Joined({}, {}, {}), "lines");
}

}  // namespace
}  // namespace rodeira::geometry
