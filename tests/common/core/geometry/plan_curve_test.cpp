// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/plan_curve.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/clothoid.hpp"

namespace rodeira::geometry {
namespace {

// Uniform from low to high, in steps of one; times the unit.
double Draw(int low, int high, double unit) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1)) * unit;
}

// Lines, arcs and clothoids at random, radii from 20 m, so that the curve also meets itself now and then.
PlanCurve AnyCurve() {
  std::vector<PlanPiece> pieces;
  const int count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i) {
    const double k0 = Draw(-50, 50, 0.001), k1 = Draw(-50, 50, 0.001);
    const double length = Draw(1, 1200, 0.1);
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        pieces.push_back({length, 0.0, 0.0});
        break;
      case 1:
        pieces.push_back({length, k0, k0});
        break;
      default:
        pieces.push_back({length, k0, k1});
        break;
    }
  }
  return PlanCurve({Draw(-5000, 5000, 1.0), Draw(-5000, 5000, 1.0)}, Draw(-314, 314, 0.01), pieces, 25.0);
}

// The nearest of many points of the curve: no projection can be farther away than that.
double NearestSample(const PlanCurve& curve, const Eigen::Vector2d& p) {
  double best = (curve.Evaluate(0.0).p_W - p).norm();
  const int count = static_cast<int>(curve.length_m() / 0.05) + 1;
  for (int i = 1; i <= count; ++i) best = std::min(best, (curve.Evaluate(curve.length_m() * i / count).p_W - p).norm());
  return best;
}

TEST(PlanCurve, FollowsItsPieces) {
  const std::vector<PlanPiece> pieces = {
      {120.0, 0.0, 0.0}, {30.0, 0.0, 1.0 / 45.0}, {60.0, 1.0 / 45.0, 1.0 / 45.0}, {30.0, 1.0 / 45.0, -1.0 / 90.0}};
  const PlanCurve curve({10.0, 20.0}, 0.5, pieces);
  EXPECT_DOUBLE_EQ(curve.length_m(), 240.0);
  Eigen::Vector2d start(10.0, 20.0);
  double heading = 0.5, begin = 0.0;
  for (const PlanPiece& piece : pieces) {
    const double rate = (piece.curvature_end_1pm - piece.curvature_start_1pm) / piece.length_m;
    for (double s = 0.0; s <= piece.length_m; s += piece.length_m / 37.0) {
      const Eigen::Vector2d d = ClothoidIntegral(piece.curvature_start_1pm, rate, s);
      const Eigen::Vector2d expected = start + Eigen::Vector2d(std::cos(heading) * d.x() - std::sin(heading) * d.y(),
                                                               std::sin(heading) * d.x() + std::cos(heading) * d.y());
      const PlanPoint point = curve.Evaluate(begin + s);
      EXPECT_LT((point.p_W - expected).norm(), 1e-12) << begin + s;
      EXPECT_NEAR(point.heading_rad, heading + piece.curvature_start_1pm * s + 0.5 * rate * s * s, 1e-14);
      EXPECT_NEAR(point.tangent_W.x(), std::cos(point.heading_rad), 1e-14);
      EXPECT_NEAR(point.tangent_W.y(), std::sin(point.heading_rad), 1e-14);
    }
    start = curve.Evaluate(begin + piece.length_m).p_W;
    heading += 0.5 * (piece.curvature_start_1pm + piece.curvature_end_1pm) * piece.length_m;
    begin += piece.length_m;
  }
  EXPECT_EQ(curve.Evaluate(-5.0).p_W, curve.Evaluate(0.0).p_W);
  EXPECT_EQ(curve.Evaluate(1e9).p_W, curve.Evaluate(curve.length_m()).p_W);
}

TEST(PlanCurve, ProjectsOntoACircleAsTheClosedFormSays) {
  const double radius = 40.0;
  const PlanCurve curve({0.0, 0.0}, 0.0, {{1.5 * kPi * radius, 1.0 / radius, 1.0 / radius}}, 20.0);
  for (int i = 0; i < 2000; ++i) {  // the centre is (0, 40); the quarter from the west to the south is open
    const double angle = base::RandomUniform({7, std::uint64_t(i)}, 0.01, 1.5 * kPi - 0.01);
    const double distance = base::RandomUniform({8, std::uint64_t(i)}, 0.5, 300.0);
    const Foot foot = curve.Project(distance * std::sin(angle), radius - distance * std::cos(angle));
    EXPECT_NEAR(foot.s_m, radius * angle, 1e-9 * radius / std::min(distance, radius)) << distance;
    EXPECT_NEAR(foot.t_m, radius - distance, 1e-10);
    EXPECT_EQ(foot.beyond_m, 0.0);
  }
}

TEST(PlanCurve, BeyondTheEndsTheFootIsTheEnd) {
  const PlanCurve curve({0.0, 0.0}, 0.0, {{100.0, 0.0, 0.0}}, 20.0);
  const Foot before = curve.Project(-3.0, 2.0);
  EXPECT_EQ(before.s_m, 0.0);
  EXPECT_DOUBLE_EQ(before.beyond_m, -3.0);
  EXPECT_DOUBLE_EQ(before.t_m, 2.0);
  const Foot after = curve.Project(500.0, -7.0);
  EXPECT_EQ(after.s_m, 100.0);
  EXPECT_NEAR(after.beyond_m, 400.0, 1e-10);
  EXPECT_NEAR(after.t_m, -7.0, 1e-10);
}

TEST(PlanCurve, FindsTheFootBeforeTheDistanceFallsAgain) {
  // Seen from near its centre of curvature a tightening bend has a nearest point, then a farthest, then comes nearer
  // again: here at s = 2 m, about 4.4 m and the end, all within one panel.
  const PlanCurve curve({0.0, 0.0}, 0.3, {{5.0, 0.03, 0.045}}, 10.0);
  const PlanPoint at = curve.Evaluate(2.0);
  const Eigen::Vector2d p = at.p_W + 0.9 / at.curvature_1pm * at.left_W();
  const auto distance = [&](double s) { return (curve.Evaluate(s).p_W - p).norm(); };
  ASSERT_TRUE(distance(2.0) < distance(4.4) && distance(4.4) > distance(5.0) && distance(2.0) < distance(5.0));
  const Foot foot = curve.Project(p.x(), p.y());
  EXPECT_NEAR(foot.s_m, 2.0, 1e-9);
  EXPECT_NEAR(foot.t_m, 0.9 / at.curvature_1pm, 1e-12);
}

// About the centre of curvature the distance hardly changes along the curve: two minima lie close together, or a
// minimum and the end, or all points are equally near. Each foot against the nearest of points 5 mm apart.
TEST(PlanCurve, AboutTheCentreOfCurvatureNoNearerPointIsMissed) {
  const auto draw = [](std::uint64_t stream, int i, double low, double high) {
    return base::RandomUniform({stream, static_cast<std::uint64_t>(i)}, low, high);
  };
  for (int i = 0; i < 20000; ++i) {
    const double k0 = draw(1, i, 0.004, 0.05), k1 = i % 3 == 0 ? k0 : k0 * draw(2, i, 0.7, 1.4);
    const PlanCurve curve({0.0, 0.0}, 0.0, {{draw(3, i, 1.0, 8.0), k0, k1}}, 25.0);
    const double s = draw(4, i, 0.0, 1.0) * curve.length_m();
    const PlanPoint at = curve.Evaluate(s);
    const double off = std::pow(10.0, draw(5, i, -12.0, -0.7));  // of the radius
    const double way = draw(6, i, -kPi, kPi);
    const Eigen::Vector2d p =
        at.p_W + (at.left_W() * (1.0 + off * std::cos(way)) + off * std::sin(way) * at.tangent_W) / at.curvature_1pm;
    const Foot foot = curve.Project(p.x(), p.y());
    double nearest = foot.distance_m;
    const int count = static_cast<int>(curve.length_m() / 0.005) + 1;
    for (int k = 0; k <= count; ++k)
      nearest = std::min(nearest, (curve.Evaluate(curve.length_m() * k / count).p_W - p).norm());
    ASSERT_LE(foot.distance_m, nearest + 1e-12 / at.curvature_1pm) << i;
    const bool at_an_end = foot.s_m == 0.0 || foot.s_m == curve.length_m();
    ASSERT_LT(at_an_end ? 0.0 : std::fabs((p - foot.at.p_W).dot(foot.at.tangent_W)), 1e-8) << i;
  }
}

RC_GTEST_PROP(PlanCurve, TheFootIsTheNearestPointOfAll, ()) {
  const PlanCurve curve = AnyCurve();
  for (int i = 0; i < 30; ++i) {
    const double s = Draw(0, 1000, 0.001) * curve.length_m();
    const PlanPoint at = curve.Evaluate(s);
    // To the side, near and far; or about the centre of curvature, where the distance hardly changes along the curve.
    double t = Draw(-2000, 2000, *rc::gen::element(0.001, 0.01, 0.1));
    if (i % 5 == 4 && at.curvature_1pm != 0.0) t = Draw(950, 1050, 0.001) / at.curvature_1pm;
    const Eigen::Vector2d p = at.p_W + t * at.left_W() + Draw(-300, 300, *rc::gen::element(0.0, 0.1)) * at.tangent_W;
    const Foot foot = curve.Project(p.x(), p.y());
    RC_ASSERT(std::fabs((foot.at.p_W - p).norm() - foot.distance_m) < 1e-9);
    RC_ASSERT((curve.Evaluate(foot.s_m).p_W - foot.at.p_W).norm() < 1e-9);
    RC_ASSERT(foot.distance_m <= NearestSample(curve, p) + 1e-9);
    // Not at an end: the line to the point is square to the curve.
    if (foot.beyond_m != 0.0) continue;
    RC_ASSERT(std::fabs(std::fabs(foot.t_m) - foot.distance_m) < 1e-7);
    RC_ASSERT((foot.at.p_W + foot.t_m * foot.at.left_W() - p).norm() < 1e-7);
  }
}

RC_GTEST_PROP(PlanCurve, ComesBackWhereItCameFromWhileUnique, ()) {
  const PlanCurve curve = AnyCurve();
  int unique = 0;
  for (int i = 0; i < 10; ++i) {
    const double s = Draw(1, 999, 0.001) * curve.length_m();
    const PlanPoint at = curve.Evaluate(s);
    const double t = Draw(-240, 240, 0.1);
    const Eigen::Vector2d p = at.p_W + t * at.left_W();
    const Foot foot = curve.Project(p.x(), p.y());
    // Elsewhere the curve comes nearer: the property above.
    if (std::fabs(t) - foot.distance_m > 1e-9 || std::fabs(foot.s_m - s) > 1.0 || at.curvature_1pm * t > 0.9) continue;
    RC_ASSERT(std::fabs(foot.s_m - s) < 1e-8);
    RC_ASSERT(std::fabs(foot.t_m - t) < 1e-9);
    ++unique;
  }
  RC_PRE(unique > 0);
}

RC_GTEST_PROP(PlanCurve, OutOfReachMeansFartherThanTheReach, ()) {
  const PlanCurve curve = AnyCurve();
  for (int i = 0; i < 40; ++i) {
    const PlanPoint at = curve.Evaluate(Draw(0, 1000, 0.001) * curve.length_m());
    const Eigen::Vector2d p = at.p_W + Draw(-500, 500, 0.1) * at.left_W() + Draw(-50, 50, 0.1) * at.tangent_W;
    const double distance = curve.Project(p.x(), p.y()).distance_m;
    if (!curve.MayReach(p.x(), p.y())) RC_ASSERT(distance > 25.0);
    if (distance > 25.0 + 4.0 * 4.0) RC_ASSERT(!curve.MayReach(p.x(), p.y()));  // and it is not the lazy answer
  }
}

}  // namespace
}  // namespace rodeira::geometry
