// SPDX-License-Identifier: Apache-2.0
// Chains of points: exact moves, offsets against closed forms (polygons, a parabola), what is refused.
#include "common/core/geometry/polyline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/polyline_crossings.hpp"
#include "common/core/geometry/polyline_offset.hpp"

namespace rodeira::geometry {
namespace {

using ::testing::HasSubstr;

Polyline Line(std::initializer_list<Eigen::Vector3d> points) { return {std::vector<Eigen::Vector3d>(points), true}; }

// A gentle road: bends of at least some 12 m.
Polyline Wavy(std::uint64_t seed, int points = 200) {
  Polyline line;
  Eigen::Vector3d p(100.0, 50.0, 7.0);
  double heading = base::RandomUniform({seed, 1}, -3.0, 3.0);
  for (int i = 0; i < points; ++i) {
    line.points_W.push_back(p);
    heading += 0.08 * std::sin(0.11 * i + base::RandomUniform({seed, 2}, 0.0, 6.0));
    p += Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.05);
  }
  return line;
}

double Distance(const Polyline& a, const Polyline& b) {
  EXPECT_EQ(a.points_W.size(), b.points_W.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.points_W.size(); ++i) worst = std::max(worst, (a.points_W[i] - b.points_W[i]).norm());
  return worst;
}

TEST(Polyline, MovesAreWhatTheySay) {
  const Polyline line = Line({{1, 2, 3}, {4, 6, 5}});
  EXPECT_EQ(StationsOf(line), (std::vector<double>{0.0, 5.0}));
  EXPECT_EQ(Distance(Translated(line, {10, -1, 0.5}), Line({{11, 1, 3.5}, {14, 5, 5.5}})), 0.0);
  EXPECT_NEAR(Distance(Rotated(line, 0.5 * kPi, {1, 2}), Line({{1, 2, 3}, {-3, 5, 5}})), 0.0, 1e-15);
  EXPECT_EQ(Distance(Scaled(line, 2.0, 0.5, {1, 2, 3}), Line({{1, 2, 3}, {7, 10, 4}})), 0.0);
  EXPECT_EQ(Distance(Reversed(line), Line({{4, 6, 5}, {1, 2, 3}})), 0.0);
}

RC_GTEST_PROP(Polyline, EveryMoveHasItsWayBack, (std::uint64_t seed)) {
  const Polyline line = Wavy(seed);
  const Eigen::Vector3d by(base::RandomUniform({seed, 3}, -1e3, 1e3), base::RandomUniform({seed, 4}, -1e3, 1e3),
                           base::RandomUniform({seed, 5}, -1e3, 1e3));
  const double angle = base::RandomUniform({seed, 6}, -3.0, 3.0), factor = base::RandomUniform({seed, 7}, 0.1, 10.0);
  RC_ASSERT(Distance(Translated(Translated(line, by), -by), line) < 1e-11);
  RC_ASSERT(Distance(Rotated(Rotated(line, angle, by.head<2>()), -angle, by.head<2>()), line) < 1e-10);
  RC_ASSERT(Distance(Scaled(Scaled(line, factor, 2.0, by), 1.0 / factor, 0.5, by), line) < 1e-10);
  RC_ASSERT(std::fabs(StationsOf(Rotated(line, angle, {0, 0})).back() - StationsOf(line).back()) < 1e-10);
  RC_ASSERT(std::fabs(StationsOf(Scaled(line, factor, 1.0, {0, 0, 0})).back() - factor * StationsOf(line).back()) <
            1e-9);
}

TEST(Polyline, IsJoinedEndToBeginning) {
  const Polyline a = Line({{0, 0, 0}, {10, 0, 1}}), b = Line({{10.01, 0, 1}, {20, 0, 2}}),
                 far = Line({{25, 0, 2}, {30, 0, 2}});
  const std::vector<std::string> names = {"a.csv", "b.csv", "c.csv"};
  const auto join = [&names](std::vector<Polyline> lines, const JoinRules& rules) {
    return Joined(lines, std::span(names).first(lines.size()), rules);
  };
  EXPECT_EQ(Distance(join({a, b}, {}).value(), Line({{0, 0, 0}, {10, 0, 1}, {20, 0, 2}})), 0.0);
  EXPECT_EQ(join({a, b}, {0.001, false, false}).error().message,
            "'b.csv' begins 0.01 m from where 'a.csv' ends; at most 0.001 m were expected");
  EXPECT_THAT(join({a, Reversed(b)}, {}).error().message, HasSubstr("(its end lies there: --turn turns it round)"));
  EXPECT_EQ(Distance(join({a, Reversed(b)}, {0.05, false, true}).value(), join({a, b}, {}).value()), 0.0);
  EXPECT_THAT(join({a, b, far}, {}).error().message, HasSubstr("'c.csv' begins 5 m from where 'b.csv' ends"));
  EXPECT_EQ(Distance(join({a, b, far}, {0.05, true, false}).value(),
                     Line({{0, 0, 0}, {10, 0, 1}, {20, 0, 2}, {25, 0, 2}, {30, 0, 2}})),
            0.0);
  Polyline flat = b;
  flat.has_z = false;
  EXPECT_THAT(join({a, flat}, {}).error().message, HasSubstr("do not both have heights"));
}

TEST(PolylineCsv, ReadsWhatItWritesToTheBit) {
  const Polyline line = Wavy(5);
  const auto again = ReadPolyline(PolylineCsv(line), "line.csv");
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_EQ(Distance(again.value(), line), 0.0);
  const auto flat = ReadPolyline("# a comment\n\n y_m , x_m\r\n2, 1\r\n+4,-3.5e0\n", "flat.csv");
  ASSERT_TRUE(flat.ok()) << flat.error().Text();
  EXPECT_FALSE(flat.value().has_z);
  EXPECT_EQ(PolylineCsv(flat.value()), "x_m,y_m\n1,2\n-3.5,4\n");
}

TEST(PolylineCsv, WhatIsWrongIsSaidWithItsLine) {
  const auto refusal = [](std::string_view text) {
    const auto line = ReadPolyline(text, "line.csv");
    EXPECT_FALSE(line.ok()) << text;
    return line.ok() ? "" : line.error().Text();
  };
  EXPECT_EQ(refusal(""), "line.csv: the file is empty; a line 'x_m,y_m,z_m' and a point a line were expected");
  EXPECT_THAT(refusal("x,y\n1,2\n"), HasSubstr("line.csv:1: column 'x' is unknown; known are x_m, y_m, z_m"));
  EXPECT_THAT(refusal("x_m,z_m\n1,2\n"), HasSubstr("line.csv:1: column 'y_m' is missing"));
  EXPECT_THAT(refusal("x_m,y_m,x_m\n1,2,3\n"), HasSubstr("column 'x_m' is there twice"));
  EXPECT_THAT(refusal("x_m,y_m\n1,2\n3\n"), HasSubstr("line.csv:3: 1 values were found; 2 were expected"));
  EXPECT_THAT(refusal("x_m,y_m\n1,2\n\n3,4,5\n"), HasSubstr("line.csv:4: 3 values were found; 2 were expected"));
  EXPECT_THAT(refusal("x_m,y_m\n1,two\n"),
              HasSubstr("line.csv:2: 'y_m' is 'two'; a number of at most 1e9 was expected"));
  EXPECT_THAT(refusal("x_m,y_m\n1,1e10\n"), HasSubstr("'y_m' is '1e10'"));
  EXPECT_THAT(refusal("x_m,y_m\n1,nan\n"), HasSubstr("'y_m' is 'nan'"));
  EXPECT_THAT(refusal("x_m,y_m\n1;2\n"), HasSubstr("1 values were found"));
  EXPECT_THAT(refusal("x_m,y_m,z_m\n1,2,3\n1,2,4\n"), HasSubstr("line.csv:3: the point (1, 2) is that of line 2"));
  EXPECT_THAT(refusal("x_m,y_m\n1,2\n"), HasSubstr("line.csv: the file has 1 points; at least 2 were expected"));
}

TEST(Mitre, FollowsTheRuleOfTheSeed) {
  // East, then north: at the corner the vectors to both neighbours are (-1, 0) and (0, 1); their sum lies on the mitre.
  const Polyline corner = Line({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}});
  const std::vector<Eigen::Vector2d> wide = MitreVectors(corner, Mitre::kKeepWidth),
                                     plain = MitreVectors(corner, Mitre::kKeepLength);
  EXPECT_EQ(wide[0], Eigen::Vector2d(0, 1));  // the ends: the perpendicular
  EXPECT_EQ(wide[2], Eigen::Vector2d(-1, 0));
  EXPECT_NEAR((wide[1] - Eigen::Vector2d(-1, 1)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((plain[1] - Eigen::Vector2d(-1, 1) / std::sqrt(2.0)).norm(), 0.0, 1e-15);
  // East, then south: the sum points to the right and is turned.
  EXPECT_NEAR(
      (MitreVectors(Line({{0, 0, 0}, {10, 0, 0}, {10, -10, 0}}), Mitre::kKeepWidth)[1] - Eigen::Vector2d(1, 1)).norm(),
      0.0, 1e-15);
  // Collinear: the sum is zero, the perpendicular is used.
  EXPECT_EQ(MitreVectors(Line({{0, 0, 0}, {10, 0, 0}, {30, 0, 0}}), Mitre::kKeepWidth)[1], Eigen::Vector2d(0, 1));
}

TEST(Offset, OfARegularPolygonIsARegularPolygon) {
  constexpr int corners = 36;
  Polyline ring;
  for (int i = 0; i <= corners; ++i) {
    ring.points_W.emplace_back(50.0 * std::cos(2.0 * kPi * i / corners), 50.0 * std::sin(2.0 * kPi * i / corners), 3.0);
  }
  ASSERT_TRUE(ring.closed());
  for (const double left : {5.0, -20.0, 49.0}) {  // counter-clockwise: left is inward
    const OffsetLine offset = Offset(ring, left);
    EXPECT_TRUE(offset.faults.empty());
    ASSERT_EQ(offset.line.points_W.size(), ring.points_W.size());
    for (const Eigen::Vector3d& p : offset.line.points_W) {
      EXPECT_NEAR(p.head<2>().norm(), 50.0 - left / std::cos(kPi / corners), 1e-12);
      EXPECT_EQ(p.z(), 3.0);
    }
    const OffsetLine kept = Offset(ring, left, Mitre::kKeepLength);
    ASSERT_EQ(kept.line.points_W.size(), ring.points_W.size());
    for (const Eigen::Vector3d& p : kept.line.points_W) {
      EXPECT_NEAR(p.head<2>().norm(), 50.0 - left, 1e-12);
    }
  }
  const OffsetLine folded = Offset(ring, 51.0);
  ASSERT_FALSE(folded.faults.empty());
  EXPECT_EQ(folded.faults[0].kind, OffsetFault::Kind::kCusp);
  EXPECT_EQ(folded.faults[0].from_m, 0.0);
  EXPECT_NEAR(folded.faults[0].to_m, 36.0 * 100.0 * std::sin(kPi / 36.0), 1e-9);
}

RC_GTEST_PROP(Offset, KeepsItsDistanceFromEverySegmentAndHasItsWayBack, (std::uint64_t seed)) {
  const Polyline line = Wavy(seed);
  for (const double left : {3.5, -6.0}) {
    const OffsetLine offset = Offset(line, left);
    RC_ASSERT(offset.faults.empty());
    for (std::size_t i = 0; i + 1 < line.points_W.size(); ++i) {
      const Eigen::Vector2d along = (line.points_W[i + 1] - line.points_W[i]).head<2>().normalized();
      for (const std::size_t k : {i, i + 1}) {
        const Eigen::Vector2d from = (offset.line.points_W[k] - line.points_W[i]).head<2>();
        RC_ASSERT(std::fabs(along.x() * from.y() - along.y() * from.x() - left) < 1e-10);
      }
    }
    RC_ASSERT(Distance(Offset(offset.line, -left).line, line) < 1e-9);
  }
}

// The strip between the lines on both sides faces up: left and right of each node, right and left of the next run
// counter-clockwise seen from above, by either rule, in bends to both sides.
RC_GTEST_PROP(Offset, TheStripBetweenBothSidesFacesUp, (std::uint64_t seed)) {
  const Polyline line = Wavy(seed);
  for (const Mitre mitre : {Mitre::kKeepWidth, Mitre::kKeepLength}) {
    const OffsetLine left = Offset(line, 3.5, mitre), right = Offset(line, -3.5, mitre);
    RC_ASSERT(left.faults.empty() && right.faults.empty());
    for (std::size_t i = 0; i + 1 < line.points_W.size(); ++i) {
      const std::array<Eigen::Vector2d, 4> p = {left.line.points_W[i].head<2>(), right.line.points_W[i].head<2>(),
                                                right.line.points_W[i + 1].head<2>(),
                                                left.line.points_W[i + 1].head<2>()};
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d a = p[(k + 1) % 4] - p[k], b = p[(k + 2) % 4] - p[(k + 1) % 4];
        RC_ASSERT(a.x() * b.y() - a.y() * b.x() > 0.0);
      }
    }
  }
}

TEST(Offset, OfAParabolaFoldsWhereItsRadiusIsSmaller) {
  // y = x^2 / 2 has the radius (1 + x^2)^(3/2): an offset by 2 to the left folds for |x| < sqrt(2^(2/3) - 1), with
  // stations follow from the arc length (x sqrt(1 + x^2) + asinh x) / 2.
  Polyline parabola;
  for (int i = -6000; i <= 6000; ++i) parabola.points_W.emplace_back(5e-4 * i, 0.5 * 25e-8 * i * i, 0.0);
  const auto length = [](double x) { return 0.5 * (x * std::sqrt(1.0 + x * x) + std::asinh(x)); };
  const double fold = std::sqrt(std::cbrt(4.0) - 1.0);
  const OffsetLine offset = Offset(parabola, 2.0);
  ASSERT_EQ(offset.faults.size(), 1u);
  EXPECT_EQ(offset.faults[0].kind, OffsetFault::Kind::kCusp);
  EXPECT_NEAR(offset.faults[0].from_m, length(3.0) - length(fold), 2e-3);
  EXPECT_NEAR(offset.faults[0].to_m, length(3.0) + length(fold), 2e-3);
  EXPECT_THAT(FaultText(offset.faults[0], 2.0), HasSubstr("the offset by 2 m to the left folds between stations"));
  EXPECT_TRUE(Offset(parabola, 0.99).faults.empty());
  EXPECT_TRUE(Offset(parabola, -5.0).faults.empty());
}

// From `begin` on a circle about `centre`, counted counter-clockwise (negative: clockwise), without its first point.
void AddArc(Polyline& line, const Eigen::Vector2d& centre, double from_rad, double angle_rad) {
  const double radius = (line.points_W.back().head<2>() - centre).norm();
  for (int i = 1; i <= 400; ++i) {
    const double angle = from_rad + angle_rad * i / 400.0;
    line.points_W.emplace_back(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), 0.0);
  }
}

TEST(Offset, WherePartsComeNearItCrossesItself) {
  // 100 m to the east, round to the west, south, and by a right-hand bend of 20 m about (20, 26) to the west again, 6 m
  // beside the beginning. 4 m to the left the outside of that bend (24 m) cuts y = 4 at x = 20 + sqrt(24^2 - 22^2).
  Polyline line = Line({{0, 0, 0}, {100, 0, 0}});
  AddArc(line, {100, 30}, -0.5 * kPi, kPi);  // radius 30, to (100, 60) westward
  line.points_W.emplace_back(70.0, 60.0, 0.0);
  AddArc(line, {70, 30}, 0.5 * kPi, 0.5 * kPi);  // to (40, 30) southward
  line.points_W.emplace_back(40.0, 26.0, 0.0);
  AddArc(line, {20, 26}, 0.0, -0.5 * kPi);  // to (20, 6) westward
  line.points_W.emplace_back(0.0, 6.0, 0.0);
  EXPECT_TRUE(Offset(line, 2.9).faults.empty());
  EXPECT_TRUE(Offset(line, -4.0).faults.empty());
  const OffsetLine offset = Offset(line, 4.0);
  ASSERT_EQ(offset.faults.size(), 1u);
  EXPECT_EQ(offset.faults[0].kind, OffsetFault::Kind::kCrossing);
  EXPECT_NEAR(offset.faults[0].from_m, 20.0 + std::sqrt(24.0 * 24.0 - 22.0 * 22.0), 1e-2);
  EXPECT_GT(offset.faults[0].to_m, StationsOf(line).back() - 60.0);
  EXPECT_THAT(FaultText(offset.faults[0], 4.0), HasSubstr("crosses itself: stations 29.5"));
}

TEST(Offset, ALineThatCrossesItselfAnywayIsNoFault) {
  Polyline loop = Line({{-50, 0, 0}, {50, 0, 0}});
  AddArc(loop, {50, 30}, -0.5 * kPi, 1.5 * kPi);  // to (20, 30) southward
  loop.points_W.emplace_back(20.0, -50.0, 0.0);
  EXPECT_EQ(CrossingsOf(loop, StationsOf(loop)).size(), 1u);
  EXPECT_TRUE(Offset(loop, 3.0).faults.empty());
  EXPECT_TRUE(Offset(loop, -3.0).faults.empty());
}

TEST(Offset, ALineThatTurnsBackHasNoMitre) {
  const OffsetLine offset = Offset(Line({{0, 0, 0}, {10, 0, 0}, {0, 0.5, 0}}), -1.0);
  ASSERT_FALSE(offset.faults.empty());
  EXPECT_EQ(offset.faults.back().kind, OffsetFault::Kind::kSharp);
  EXPECT_THAT(FaultText(offset.faults.back(), -1.0),
              HasSubstr("turns back by more than 160 degrees at station 10.000 m"));
}

TEST(Crossings, AreThoseOfAllPairs) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Polyline line;
    for (std::uint64_t i = 0; i < 40; ++i) {
      line.points_W.emplace_back(base::RandomUniform({seed, i, 1}, 0.0, 10.0),
                                 base::RandomUniform({seed, i, 2}, 0.0, 10.0 * (seed % 3)), 0.0);
    }
    const std::vector<double> stations = StationsOf(line);
    std::size_t expected = 0;
    for (std::size_t i = 0; i + 1 < 40; ++i) {
      for (std::size_t k = i + 2; k + 1 < 40; ++k) {
        const auto side = [&](std::size_t a, std::size_t b, std::size_t p) {
          const Eigen::Vector2d along = (line.points_W[b] - line.points_W[a]).head<2>(),
                                to = (line.points_W[p] - line.points_W[a]).head<2>();
          return along.x() * to.y() - along.y() * to.x() > 0.0;
        };
        expected += side(i, i + 1, k) != side(i, i + 1, k + 1) && side(k, k + 1, i) != side(k, k + 1, i + 1);
      }
    }
    if (seed % 3 == 0) expected = 0;  // all on one line: parallel segments do not cross
    EXPECT_EQ(CrossingsOf(line, stations).size(), expected) << seed;
  }
}

}  // namespace
}  // namespace rodeira::geometry
