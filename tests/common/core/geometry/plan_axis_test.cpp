// SPDX-License-Identifier: Apache-2.0
// Reference lines of lines, arcs, clothoids and cubics: closed forms, an integration of another kind, dense sampling.
#include "common/core/geometry/plan_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::geometry {
namespace {

using Complex = std::complex<long double>;

PlanElement Clothoid(double length, double k0, double k1) {
  PlanElement element;
  element.start_W = {12.0, -7.0};
  element.heading_rad = 0.7;
  element.length_m = length;
  element.curvature_start_1pm = k0;
  element.curvature_end_1pm = k1;
  return element;
}

// Tanh-free check: Gauss-Legendre would share our rule's idea, so Simpson's rule in 80 bits with many steps,
// extrapolated.
Complex Integral(const PlanElement& e, long double s) {
  const auto f = [&](long double x) {
    const long double rate = (static_cast<long double>(e.curvature_end_1pm) - e.curvature_start_1pm) / e.length_m;
    return std::polar(1.0L, e.heading_rad + (e.curvature_start_1pm + rate * x / 2) * x);
  };
  const auto simpson = [&](int n) {
    const long double h = s / n;
    Complex sum = f(0) + f(s);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0L : 2.0L) * f(i * h);
    return sum * h / 3.0L;
  };
  const int n =
      2 * static_cast<int>(50 + 20 * s * std::max(std::fabs(e.curvature_start_1pm), std::fabs(e.curvature_end_1pm)));
  const Complex once = simpson(8 * n), twice = simpson(16 * n);
  return twice + (twice - once) / 15.0L;
}

TEST(PlanAxis, ClothoidsToAKilometreAndATenthOfCurvature) {
  // The promise: 1e-9 m and 1e-12 rad for lengths to 1 km and |k| <= 0.1, for every change of curvature, down to zero.
  for (const double length : {1.0, 60.0, 1000.0}) {
    for (const double k0 : {0.0, 0.1, -0.05, 0.01}) {
      for (const double change : {0.0, 1e-16, 1e-12, -1e-9, 1e-6, 1e-4, -0.02, -0.1}) {
        const double k1 = k0 + change;
        if (std::fabs(k1) > 0.1) continue;
        const PlanElement element = Clothoid(length, k0, k1);
        const auto axis = PlanAxis::Make({element});
        ASSERT_TRUE(axis);
        for (const double part : {0.13, 0.5, 0.999, 1.0}) {
          const double s = part * length;
          const PlanPoint at = axis->Evaluate(s);
          const Complex moved = Integral(element, s);
          EXPECT_NEAR(at.p_W.x(), static_cast<double>(12.0L + moved.real()), 1e-9)
              << length << " " << k0 << " " << change;
          EXPECT_NEAR(at.p_W.y(), static_cast<double>(-7.0L + moved.imag()), 1e-9)
              << length << " " << k0 << " " << change;
          const long double rate = (static_cast<long double>(k1) - k0) / length;
          const auto heading = static_cast<double>(0.7L + (k0 + rate * s / 2) * s);
          EXPECT_NEAR(at.heading_rad, heading, 1e-12);
          EXPECT_NEAR(WrapAngle(std::atan2(at.tangent_W.y(), at.tangent_W.x()) - heading), 0.0, 1e-12);
        }
        EXPECT_NEAR((PlanAxis::End(element).p_W - axis->Evaluate(length).p_W).norm(), 0.0, 1e-10);
      }
    }
  }
}

// A cubic that is exactly a parabola v = c u^2, with a known length: (x sqrt(1 + x^2) + asinh x) / (4 c), x = 2 c u.
TEST(PlanAxis, AGraphGoesByItsOwnLength) {
  PlanElement element;
  element.kind = PlanElement::Kind::kCubic;
  element.u = {0.0, 1.0, 0.0, 0.0};
  element.v = {0.0, 0.0, 0.01, 0.0};
  const auto length = [](double u) {
    const double x = 0.02 * u;
    return (x * std::sqrt(1.0 + x * x) + std::asinh(x)) / 0.04;
  };
  element.length_m = length(80.0);
  element.p_end = GraphEnd(element);
  EXPECT_NEAR(element.p_end, 80.0, 1e-9);
  const auto axis = PlanAxis::Make({element});
  ASSERT_TRUE(axis);
  for (double u = 0.0; u <= 80.0; u += 0.37) {
    const PlanPoint at = axis->Evaluate(length(u));
    EXPECT_NEAR(at.p_W.x(), u, 1e-10);
    EXPECT_NEAR(at.p_W.y(), 0.01 * u * u, 1e-10);
    EXPECT_NEAR(at.heading_rad, std::atan(0.02 * u), 1e-12);
    EXPECT_NEAR(at.curvature_1pm, 0.02 * std::pow(1.0 + 4e-4 * u * u, -1.5), 1e-12);
  }
}

TEST(PlanAxis, ACubicThatIsALineIsALine) {
  PlanElement element;
  element.kind = PlanElement::Kind::kCubic;
  element.heading_rad = kPi / 2;
  element.u = {1.0, 50.0, 0.0, 0.0};
  element.v = {-2.0, 0.0, 0.0, 0.0};
  element.length_m = 50.0;
  const auto axis = PlanAxis::Make({element});
  ASSERT_TRUE(axis);
  EXPECT_NEAR((axis->Evaluate(20.0).p_W - Eigen::Vector2d(2.0, 21.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(axis->Evaluate(20.0).curvature_1pm, 0.0);
}

TEST(PlanAxis, ACuspIsRefused) {
  PlanElement element;  // u = p^2, v = p^3 about p = 0.5
  element.kind = PlanElement::Kind::kCubic;
  element.u = {0.25, -1.0, 1.0, 0.0};
  element.v = {-0.125, 0.75, -1.5, 1.0};
  element.length_m = 1.0;
  EXPECT_FALSE(PlanAxis::Make({element}).has_value());
}

TEST(PlanAxis, EndlessTurnsAreRefused) { EXPECT_FALSE(PlanAxis::Make({Clothoid(1e6, 1e3, 1e3)}).has_value()); }

std::vector<PlanElement> OfEveryKind() {
  PlanElement cubic = Clothoid(1.0, 0.0, 0.0);
  cubic.kind = PlanElement::Kind::kCubic;
  cubic.u = {0.0, 60.0, 10.0, -5.0};
  cubic.v = {0.0, 0.0, 40.0, -25.0};
  cubic.length_m = CubicLength(cubic, 1.0);
  return {Clothoid(300.0, 0.0, 0.0),    Clothoid(90.0, 0.03, 0.03),  Clothoid(250.0, -0.004, -0.004),
          Clothoid(80.0, 0.002, -0.05), Clothoid(500.0, 1e-8, 1e-8), cubic};
}

TEST(PlanAxis, TheFootIsTheNearestPoint) {
  std::uint64_t number = 0;
  for (const PlanElement& element : OfEveryKind()) {
    const auto axis = PlanAxis::Make({element});
    ASSERT_TRUE(axis);
    for (int i = 0; i < 300; ++i) {
      ++number;
      const PlanPoint about = axis->Evaluate(base::RandomUniform({number, 1}, 0.0, element.length_m));
      const Eigen::Vector2d p = about.p_W + Eigen::Vector2d(base::RandomUniform({number, 2}, -25.0, 25.0),
                                                            base::RandomUniform({number, 3}, -25.0, 25.0));
      double nearest = 1e9;
      for (const AxisPanel& panel : axis->panels()) {
        const AxisFoot foot = axis->Foot(panel, p);
        const PlanPoint at = axis->At(panel, foot.u_m);
        // (t, beyond) lead from the foot to the point.
        EXPECT_NEAR((at.p_W + foot.t_m * at.left_W() + foot.beyond_m * at.tangent_W - p).norm(), 0.0, 1e-9);
        nearest = std::min(nearest, (at.p_W - p).norm());
      }
      double sampled = 1e9;
      for (double s = 0.0; s <= element.length_m; s += 0.02)
        sampled = std::min(sampled, (axis->Evaluate(s).p_W - p).norm());
      EXPECT_LE(nearest, sampled + 1e-9);
      EXPECT_GE(nearest, sampled - 0.02);
    }
  }
}

TEST(PlanAxis, PanelsJoinAndStationsAreLengths) {
  for (const PlanElement& element : OfEveryKind()) {
    const auto axis = PlanAxis::Make({element});
    const auto& panels = axis->panels();
    for (std::size_t i = 0; i + 1 < panels.size(); ++i) {
      const PlanPoint end = axis->At(panels[i], panels[i].half_m),
                      begin = axis->At(panels[i + 1], -panels[i + 1].half_m);
      EXPECT_NEAR((end.p_W - begin.p_W).norm(), 0.0, 1e-10);
      EXPECT_NEAR(end.heading_rad, begin.heading_rad, 1e-11);
      EXPECT_NEAR(panels[i].end_s_m(), panels[i + 1].begin_s_m(), 1e-9);
    }
    EXPECT_NEAR(panels.back().end_s_m(), element.length_m, 1e-9);
    const double h = 1e-4;
    for (double s = h; s < element.length_m - h; s += element.length_m / 97.0) {
      EXPECT_NEAR((axis->Evaluate(s + h).p_W - axis->Evaluate(s - h).p_W).norm() / (2.0 * h), 1.0, 1e-8) << s;
    }
    // The chord of a panel stays within its bulge.
    for (const AxisPanel& panel : panels) {
      const Eigen::Vector2d a = axis->At(panel, -panel.half_m).p_W, b = axis->At(panel, panel.half_m).p_W;
      for (double part = -1.0; part <= 1.0; part += 0.125) {
        const Eigen::Vector2d p = axis->At(panel, part * panel.half_m).p_W;
        const double u = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        EXPECT_LE((p - a - u * (b - a)).norm(), axis->Bulge(panel) + 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::geometry
