// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/lighting/sun_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

constexpr double kSide_m = 100.0;
constexpr int kSide_px = 2048;

// Parallel rays: whatever lies on one of them has one place on the map, and the nearer to the sun, the less deep.
TEST(SunView, WhatStandsBeforeTheSunCoversWhatLiesBehind) {
  const Vector3d to_sun = Vector3d(0.4, -0.7, 0.5).normalized();
  const SunView view = MakeSunView(to_sun, {1200.0, -800.0, 55.0}, kSide_m, kSide_px);
  for (std::uint64_t i = 0; i < 50; ++i) {
    const auto draw = [&](std::uint64_t what) { return 40.0 * (base::RandomUniform({i, what}) - 0.5); };
    const Vector3d p = Vector3d(1200.0, -800.0, 55.0) + Vector3d(draw(0), draw(1), draw(2));
    const Vector3d at = view.ToMap(p), nearer = view.ToMap(p + 7.0 * to_sun);
    EXPECT_LT((at - nearer).head<2>().norm(), 1e-9);
    EXPECT_NEAR(at.z() - nearer.z(), 7.0 / (2.0 * view.depth_m), 1e-12);
    EXPECT_TRUE((at.array() > 0.0).all() && (at.array() < 1.0).all());
  }
}

// However little the eye moves, what stands still keeps its place among the map's pixels.
TEST(SunView, MovesByWholePixels) {
  const Vector3d to_sun = Vector3d(-0.2, -0.5, 0.8).normalized(), tree(10.0, 3.0, 1.0);
  const Vector3d first = kSide_px * MakeSunView(to_sun, Vector3d::Zero(), kSide_m, kSide_px).ToMap(tree);
  double most = 0.0;
  for (int i = 1; i < 200; ++i) {
    const Vector3d moved =
        kSide_px * MakeSunView(to_sun, {0.013 * i, 0.007 * i, 0.0}, kSide_m, kSide_px).ToMap(tree) - first;
    for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(moved[axis], std::round(moved[axis]), 1e-6);
    most = std::max(most, moved.head<2>().norm());
  }
  EXPECT_GT(most, 20.0) << "it did move";
}

TEST(SunView, StandsUprightAlsoUnderASunOverhead) {
  const SunView view = MakeSunView(Vector3d::UnitZ(), Vector3d::Zero(), kSide_m, kSide_px);
  EXPECT_NEAR(view.right_W.norm(), 1.0, 1e-12);
  EXPECT_NEAR(view.up_W.dot(view.right_W), 0.0, 1e-12);
}

}  // namespace
}  // namespace rodeira::scene
