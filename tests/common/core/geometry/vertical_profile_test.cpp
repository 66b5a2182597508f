// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/vertical_profile.hpp"

#include <gtest/gtest.h>

namespace rodeira::geometry {
namespace {

TEST(VerticalProfile, IsTheTextbookParabola) {
  // +4 % to -2 % over 120 m at s = 300, z = 100: K = L / dg = 2000 m. The highway textbooks' offset from the vertex is
  // e = dg L / 8 = 0.9 m, and the crest lies g1 K = 80 m after the curve's beginning at 240 m.
  const VerticalProfile profile({{0.0, 88.0, 0.0}, {300.0, 100.0, 120.0}, {700.0, 92.0, 0.0}});
  EXPECT_NEAR(profile.Evaluate(0.0).z_m, 88.0, 1e-12);
  EXPECT_NEAR(profile.Evaluate(100.0).z_m, 92.0, 1e-12);
  EXPECT_NEAR(profile.Evaluate(300.0).z_m, 100.0 - 0.9, 1e-12);
  EXPECT_NEAR(profile.Evaluate(300.0).curvature_1pm, -1.0 / 2000.0, 1e-15);
  EXPECT_NEAR(profile.Evaluate(320.0).grade, 0.0, 1e-15);
  EXPECT_NEAR(profile.Evaluate(320.0).z_m, 100.0 - 0.04 * 60.0 + 0.04 * 80.0 / 2.0, 1e-12);
  EXPECT_NEAR(profile.Evaluate(500.0).z_m, 96.0, 1e-12);
  EXPECT_NEAR(profile.Evaluate(500.0).grade, -0.02, 1e-15);
  EXPECT_EQ(profile.Evaluate(500.0).curvature_1pm, 0.0);
}

TEST(VerticalProfile, HeightAndGradeAreContinuous) {
  const VerticalProfile profile(
      {{0.0, 0.0, 0.0}, {100.0, 5.0, 80.0}, {180.0, 5.0, 80.0}, {300.0, -7.0, 20.0}, {400.0, 3.0, 0.0}});
  ProfilePoint before = profile.Evaluate(0.0);
  for (double s = 0.01; s < 400.0; s += 0.01) {
    const ProfilePoint now = profile.Evaluate(s);
    EXPECT_NEAR(now.z_m - before.z_m, 0.01 * 0.5 * (now.grade + before.grade), 1e-7) << s;
    EXPECT_NEAR(now.grade, before.grade, 1e-4 + 0.01 * 0.2 / 20.0) << s;
    before = now;
  }
}

TEST(VerticalProfile, OnePointIsLevelAndGradesGoOn) {
  const VerticalProfile level({{50.0, 12.0, 0.0}});
  EXPECT_EQ(level.Evaluate(-10.0).z_m, 12.0);
  EXPECT_EQ(level.Evaluate(900.0).grade, 0.0);
  const VerticalProfile slope({{0.0, 1.0, 0.0}, {10.0, 2.0, 0.0}});
  EXPECT_NEAR(slope.Evaluate(30.0).z_m, 4.0, 1e-14);
}

}  // namespace
}  // namespace rodeira::geometry
