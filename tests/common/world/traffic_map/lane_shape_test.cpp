// SPDX-License-Identifier: Apache-2.0
// A lane's middle, width, bend and height against closed forms.
#include "common/world/traffic_map/lane_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rodeira::traffic_map {
namespace {

using V = Eigen::Vector2d;
const double kHalfPi = std::acos(0.0);

Cubic Straight(const V& a, const V& b) { return {{a, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0, b}}; }
// A quarter circle about the origin from (r, 0) to (0, r), off by at most 2.73e-4 r.
Cubic Quarter(double r) {
  const double k = 4.0 / 3.0 * (std::sqrt(2.0) - 1.0);
  return {{V(r, 0), V(r, k * r), V(k * r, r), V(0, r)}};
}

TEST(LaneShape, AWedgeOfStraightBorders) {
  // The left border rises from 1.5 to 2.5 m, the right one stays: the middle runs at y = x/40 from 0.
  const LaneShape lane({Straight(V(0, 1.5), V(20, 2.5)), {}}, {Straight(V(0, -1.5), V(20, -1.5)), {}});
  EXPECT_NEAR(lane.length_m(), std::hypot(20.0, 0.5), 1e-12);
  const LanePoint at = lane.At(0.5 * lane.length_m());
  EXPECT_LT((at.p_W - V(10.0, 0.25)).norm(), 1e-12);
  // From (10, 1/4) along the perpendicular (−1/40, 1) λ to y = 1.5 + x/20 and to y = −1.5.
  const double norm = std::hypot(1.0, 1.0 / 40.0);
  EXPECT_NEAR(at.left_m, 1.75 / (1.0 + 1.0 / 800.0) * norm, 1e-12);
  EXPECT_NEAR(at.right_m, -1.75 * norm, 1e-12);
  EXPECT_NEAR(at.width_m(), at.left_m - at.right_m, 0.0);
  // At the end the left border ends before the perpendicular; straight on it is 1.5 + x/20 still: λ = 2 / (1 + 1/800).
  EXPECT_NEAR(lane.At(lane.length_m()).left_m, 2.0 / (1.0 + 1.0 / 800.0) * norm, 1e-12);
}

TEST(LaneShape, AQuarterCircleToTheLeft) {
  const double radius = 40.0, half = 1.75;
  const LaneShape lane({Quarter(radius - half), {}}, {Quarter(radius + half), {}});
  EXPECT_NEAR(lane.length_m(), kHalfPi * radius, 3e-4 * radius * kHalfPi);
  for (int i = 0; i <= 50; ++i) {
    const LanePoint at = lane.At(lane.length_m() * i / 50.0);
    EXPECT_NEAR(at.p_W.norm(), radius, 2.8e-4 * radius);
    EXPECT_NEAR(at.left_m, half, 3e-4 * radius);
    EXPECT_NEAR(at.right_m, -half, 3e-4 * radius);
    EXPECT_NEAR(at.curvature_1pm, 1.0 / radius, 0.035 / radius);
    EXPECT_NEAR(std::atan2(at.p_W.y(), at.p_W.x()), kHalfPi * i / 50.0,
                3e-4);  // along it by distance, not by parameter
  }
}

TEST(LaneShape, Inverted) {
  const LaneShape there({Quarter(38), {}}, {Quarter(42), {}});
  const LaneShape back({Quarter(42).Reversed(), {}}, {Quarter(38).Reversed(), {}});
  const LanePoint a = there.At(10.0), b = back.At(back.length_m() - 10.0);
  EXPECT_LT((a.p_W - b.p_W).norm(), 1e-9);
  EXPECT_LT((a.tangent_W + b.tangent_W).norm(), 1e-9);
  EXPECT_NEAR(a.curvature_1pm, -b.curvature_1pm, 1e-12);
  EXPECT_NEAR(a.left_m, -b.right_m, 1e-9);
}

// z(t) = 6(3t² − 2t³) over x(t) = 120 t: the grade is 6·6t(1 − t)/120, 7.5 % in the middle.
TEST(LaneShape, Heights) {
  const std::array<double, 4> z = {0.0, 0.0, 6.0, 6.0};
  const LaneShape lane({Straight(V(0, 2), V(120, 2)), z}, {Straight(V(0, -2), V(120, -2)), z});
  for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const LanePoint at = lane.At(120.0 * t);
    EXPECT_NEAR(at.z_m, 6.0 * (3.0 * t * t - 2.0 * t * t * t), 1e-12);
    EXPECT_NEAR(at.grade, 36.0 * t * (1.0 - t) / 120.0, 1e-13);
  }
}

// More than a half turn: the perpendicular cuts the border twice, and the crossing beside the place is meant.
TEST(LaneShape, AHairpinHasItsOwnWidthEverywhere) {
  const Cubic inner{{V(0, 0), V(60, -20), V(60, 40), V(0, 20)}};
  const Cubic outer{{V(-1, -3), V(64.5, -25), V(64.5, 45), V(-1, 23)}};
  const LaneShape lane({inner, {}}, {outer, {}});
  for (int i = 0; i <= 100; ++i) {
    const LanePoint at = lane.At(lane.length_m() * i / 100.0);
    EXPECT_GT(at.width_m(), 2.0) << i;
    EXPECT_LT(at.width_m(), 6.0) << i;
  }
}

}  // namespace
}  // namespace rodeira::traffic_map
