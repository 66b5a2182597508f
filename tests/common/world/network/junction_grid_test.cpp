// SPDX-License-Identifier: Apache-2.0
// The heights of a junction's own: what OpenDRIVE 1.8 says of its grid, against polynomials; the way from a road onto
// it.
#include "common/world/network/junction_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/core/base/random.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::network {
namespace {

using Polynomial = std::function<double(double, double)>;  // of s and t, m

geometry::PlanAxis Line(double curvature_1pm = 0.0) {
  geometry::PlanElement element;
  element.length_m = 20.0;
  element.start_W = {100.0, -50.0};
  element.heading_rad = 0.7;
  element.curvature_start_1pm = element.curvature_end_1pm = curvature_1pm;
  return *geometry::PlanAxis::Make({element});
}

constexpr double kStart_m = 2.0, kSpacing_m = 3.0;

JunctionGrid Grid(int rows, int left, int right, const Polynomial& z, double curvature_1pm = 0.0) {
  std::vector<JunctionGridRow> all;
  for (int i = 0; i < rows; ++i) {
    const double s = kStart_m + kSpacing_m * i;
    JunctionGridRow row{z(s, 0.0), {}, {}};
    for (int k = 1; k <= left; ++k) row.left_m.push_back(z(s, kSpacing_m * k));
    for (int k = 1; k <= right; ++k) row.right_m.push_back(z(s, -kSpacing_m * k));
    all.push_back(row);
  }
  return *JunctionGrid::Make(Line(curvature_1pm), kStart_m, kSpacing_m, all);
}

Eigen::Vector2d At(const geometry::PlanAxis& line, double s, double t) {
  const geometry::PlanPoint at = line.Evaluate(s);
  return at.p_W + t * at.left_W();
}

TEST(JunctionGrid, IsACubicInBothDirectionsWhereFourHeightsLie) {
  const Polynomial z = [](double s, double t) {
    return 3.0 + 0.1 * s - 0.2 * t + 0.03 * s * t - 0.004 * s * s * t + 0.001 * s * s * s - 0.0007 * t * t * t +
           1e-5 * s * s * s * t * t * t;
  };
  for (const double curvature : {0.0, 0.02}) {
    const JunctionGrid grid = Grid(5, 3, 2, z, curvature);
    const geometry::PlanAxis line = Line(curvature);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const double s = base::RandomUniform({i, 1}, kStart_m + kSpacing_m, kStart_m + 3.0 * kSpacing_m),
                   t = base::RandomUniform({i, 2}, -kSpacing_m, 2.0 * kSpacing_m);
      EXPECT_NEAR(grid.At(At(line, s, t)).z_m, z(s, t), 1e-10) << s << " " << t;
    }
  }
}

TEST(JunctionGrid, IsStraightWhereThereAreNoFour) {
  const Polynomial z = [](double s, double t) { return 5.0 + 0.3 * s - 0.1 * t + 0.02 * s * t; };
  const JunctionGrid grid = Grid(2, 1, 1, z);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double s = base::RandomUniform({i, 1}, kStart_m, kStart_m + kSpacing_m),
                 t = base::RandomUniform({i, 2}, -kSpacing_m, kSpacing_m);
    const Eigen::Vector2d p = At(Line(), s, t);
    EXPECT_TRUE(grid.Covers(p));
    EXPECT_NEAR(grid.At(p).z_m, z(s, t), 1e-12);
  }
  // Beyond its squares as on their edge.
  EXPECT_FALSE(grid.Covers(At(Line(), kStart_m - 0.01, 0.0)));
  EXPECT_FALSE(grid.Covers(At(Line(), kStart_m, kSpacing_m + 0.01)));
  EXPECT_NEAR(grid.At(At(Line(), 0.0, 1.0)).z_m, z(kStart_m, 1.0), 1e-12);
}

// Rows of any lengths: some squares have all their neighbours, some have not.
JunctionGrid Ragged() {
  std::vector<JunctionGridRow> rows;
  for (std::uint64_t i = 0; i < 7; ++i) {
    const auto heights = [&](std::uint64_t side, std::uint64_t count) {
      std::vector<double> z;
      for (std::uint64_t k = 0; k < count; ++k) z.push_back(base::RandomUniform({i, side, k}, 0.0, 0.5));
      return z;
    };
    rows.push_back({base::RandomUniform({i, 9}, 0.0, 0.5), heights(1, 1 + i % 3), heights(2, 2 + i % 2)});
  }
  return *JunctionGrid::Make(Line(0.01), 0.0, kSpacing_m, rows);
}

TEST(JunctionGrid, HasNoStepBetweenItsSquares) {
  const JunctionGrid grid = Ragged();
  const geometry::PlanAxis line = Line(0.01);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const bool across = i % 2 == 0;
    const double lineward = static_cast<double>(1 + i / 2 % 5), other = base::RandomUniform({i, 3}, 0.0, 1.0);
    const double s = across ? kSpacing_m * lineward : kSpacing_m * (lineward + other),
                 t = across ? kSpacing_m * (2.0 * other - 1.0) : 0.0;
    const double one = grid.At(At(line, s - (across ? 1e-9 : 0.0), t - (across ? 0.0 : 1e-9))).z_m;
    const double two = grid.At(At(line, s + (across ? 1e-9 : 0.0), t + (across ? 0.0 : 1e-9))).z_m;
    EXPECT_NEAR(one, two, 1e-8) << s << " " << t;
  }
}

TEST(JunctionGrid, ItsSlopesAreTheDerivatives) {
  const JunctionGrid grid = Ragged();
  const geometry::PlanAxis line = Line(0.01);
  constexpr double kStep_m = 1e-5;
  for (std::uint64_t i = 0; i < 500; ++i) {
    // Not where squares meet: there slopes change.
    const double s = kSpacing_m * (static_cast<double>(i % 6) + base::RandomUniform({i, 1}, 0.1, 0.9)),
                 t = kSpacing_m * (static_cast<double>(i % 2) - base::RandomUniform({i, 2}, 0.1, 0.9));
    const Eigen::Vector2d p = At(line, s, t), x(kStep_m, 0.0), y(0.0, kStep_m);
    const GroundHeight at = grid.At(p);
    EXPECT_NEAR(at.slope_x, (grid.At(p + x).z_m - grid.At(p - x).z_m) / (2.0 * kStep_m), 1e-8);
    EXPECT_NEAR(at.slope_y, (grid.At(p + y).z_m - grid.At(p - y).z_m) / (2.0 * kStep_m), 1e-8);
  }
}

TEST(JunctionGrid, WithoutASquareThereIsNone) {
  EXPECT_FALSE(JunctionGrid::Make(Line(), 0.0, 1.0, {{1.0, {1.0}, {}}}));
  EXPECT_FALSE(JunctionGrid::Make(Line(), 0.0, 1.0, {{1.0, {1.0}, {}}, {1.0, {}, {1.0}}}));
  EXPECT_FALSE(JunctionGrid::Make(Line(), 0.0, 0.0, {{1.0, {1.0}, {}}, {1.0, {1.0}, {}}}));
}

}  // namespace
}  // namespace rodeira::network
