// SPDX-License-Identifier: Apache-2.0
// Cubics against closed forms: straight lines, parabolas, semi-cubical parabolas, circles' approximations; and against
// sums of chords.
#include "common/world/traffic_map/cubic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::traffic_map {
namespace {

using V = Eigen::Vector2d;

Cubic Drawn(std::uint64_t number) {
  Cubic cubic;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const std::uint64_t bits = base::RandomBits({7, number, 2 * i + static_cast<std::uint64_t>(axis)});
      cubic.p_W[i][axis] = 100.0 * static_cast<double>(bits >> 11) / 9007199254740992.0;
    }
  }
  return cubic;
}

// A quadratic Bézier curve raised to degree three.
Cubic Raised(const V& a, const V& b, const V& c) { return {{a, (a + 2.0 * b) / 3.0, (2.0 * b + c) / 3.0, c}}; }

TEST(Cubic, StraightLine) {
  const Cubic line{{V(1, 2), V(2, 2), V(7, 2), V(11, 2)}};
  EXPECT_NEAR(ArcLength(line, 0.0, 1.0), 10.0, 1e-12);
  EXPECT_EQ(line.Curvature(0.3), 0.0);
  EXPECT_EQ(line.Tangent(0.9), V(1, 0));
}

TEST(Cubic, SlopeAndBendAreTheDerivatives) {
  for (std::uint64_t n = 0; n < 50; ++n) {
    const Cubic c = Drawn(n);
    const double t = 0.1 + 0.8 * static_cast<double>(n) / 50.0, h = 1e-5;
    EXPECT_LT((c.Slope(t) - (c.At(t + h) - c.At(t - h)) / (2 * h)).norm(), 1e-6);
    EXPECT_LT((c.Bend(t) - (c.Slope(t + h) - c.Slope(t - h)) / (2 * h)).norm(), 1e-5);
  }
}

// y = x² from 0 to 1: length √5/2 + asinh(2)/4, curvature 2/(1 + 4x²)^1.5.
TEST(Cubic, Parabola) {
  const Cubic c = Raised(V(0, 0), V(0.5, 0), V(1, 1));
  EXPECT_NEAR(ArcLength(c, 0.0, 1.0), std::sqrt(5.0) / 2.0 + std::asinh(2.0) / 4.0, 1e-13);
  for (const double x : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(c.Curvature(x), 2.0 / std::pow(1.0 + 4.0 * x * x, 1.5), 1e-13);
  EXPECT_NEAR(c.Reversed().Curvature(0.25), -c.Curvature(0.75), 1e-13);  // the other way round it bends to the right
  EXPECT_NEAR(ArcLength(c, 0.0, 0.5), std::sqrt(2.0) / 4.0 + std::asinh(1.0) / 4.0, 1e-13);
}

// (t², t³): a cusp at 0, length (13√13 − 8)/27; the tangent there is the limit from within.
TEST(Cubic, CuspAtTheBeginning) {
  const Cubic c{{V(0, 0), V(0, 0), V(1.0 / 3.0, 0), V(1, 1)}};
  EXPECT_NEAR(ArcLength(c, 0.0, 1.0), (13.0 * std::sqrt(13.0) - 8.0) / 27.0, 1e-12);
  EXPECT_EQ(c.Tangent(0.0), V(1, 0));
  EXPECT_LT((c.Reversed().Tangent(1.0) - V(-1, 0)).norm(), 1e-12);
}

// (t² , t³) for t from −1 to 1, with the cusp within.
TEST(Cubic, CuspWithin) {
  // x = (2u − 1)², y = (2u − 1)³ in Bernstein form.
  const Cubic c{{V(1, -1), V(-1.0 / 3.0, 1), V(-1.0 / 3.0, -1), V(1, 1)}};
  EXPECT_NEAR(ArcLength(c, 0.0, 1.0), 2.0 * (13.0 * std::sqrt(13.0) - 8.0) / 27.0, 1e-9);
}

// A quarter circle's usual approximation is off by 2.73e-4 of the radius at most (Goldapp 1991), and outside the
// circle.
TEST(Cubic, QuarterCircle) {
  const double k = 4.0 / 3.0 * (std::sqrt(2.0) - 1.0);
  const Cubic c{{V(1, 0), V(1, k), V(k, 1), V(0, 1)}};
  double worst = 0.0;
  for (int i = 0; i <= 1000; ++i) worst = std::max(worst, std::abs(c.At(i / 1000.0).norm() - 1.0));
  EXPECT_NEAR(worst, 2.7253e-4, 1e-7);
  EXPECT_NEAR(ArcLength(c, 0.0, 1.0), std::acos(-1.0) / 2.0, 3e-4);
  EXPECT_NEAR(c.Curvature(0.5), 1.0, 0.01);
}

TEST(Cubic, LengthAgreesWithChords) {
  for (std::uint64_t n = 0; n < 40; ++n) {
    const Cubic c = Drawn(n);
    double chords[2] = {0.0, 0.0};
    for (int level = 0; level < 2; ++level) {
      const int steps = 4000 << level;
      for (int i = 0; i < steps; ++i)
        chords[level] += (c.At((i + 1.0) / steps) - c.At(static_cast<double>(i) / steps)).norm();
    }
    const double extrapolated = chords[1] + (chords[1] - chords[0]) / 3.0;
    EXPECT_NEAR(ArcLength(c, 0.0, 1.0), extrapolated, 1e-8 * extrapolated) << n;
    EXPECT_LE(ArcLength(c, 0.0, 1.0), c.PolygonLength());
  }
}

TEST(ArcTable, DistanceAndParameterAreInverse) {
  for (std::uint64_t n = 0; n < 40; ++n) {
    const Cubic c = Drawn(n);
    const ArcTable table(c);
    EXPECT_NEAR(table.length_m(), ArcLength(c, 0.0, 1.0), 1e-9 * table.length_m());
    for (int i = 0; i <= 20; ++i) {
      const double s = table.length_m() * i / 20.0;
      const double t = table.ParameterAt(s);
      EXPECT_NEAR(ArcLength(c, 0.0, t), s, 1e-9 * table.length_m());
      EXPECT_NEAR(table.DistanceAt(t), s, 1e-9 * table.length_m());
    }
    EXPECT_EQ(table.ParameterAt(-1.0), 0.0);
    EXPECT_EQ(table.ParameterAt(1e9), 1.0);
  }
}

TEST(Cubic, APointIsNoTrouble) {
  const Cubic point{{V(3, 4), V(3, 4), V(3, 4), V(3, 4)}};
  EXPECT_EQ(ArcLength(point, 0.0, 1.0), 0.0);
  EXPECT_EQ(point.Tangent(0.5), V(1, 0));
  EXPECT_EQ(point.Curvature(0.5), 0.0);
  EXPECT_EQ(ArcTable(point).ParameterAt(0.0), 0.0);
}

}  // namespace
}  // namespace rodeira::traffic_map
