// SPDX-License-Identifier: Apache-2.0
// The clothoid's integral against published Fresnel values, closed forms, and an integration of another kind.
#include "common/core/geometry/clothoid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "common/core/geometry/angle.hpp"

namespace rodeira::geometry {
namespace {

using Complex = std::complex<long double>;

// Romberg's method in 80-bit arithmetic: trapezia and Richardson's extrapolation.
Complex Romberg(long double k0, long double k1, long double length) {
  const auto f = [&](long double s) { return std::polar(1.0L, (k0 + k1 * s / 2) * s); };
  constexpr int kLevels = 18;
  Complex table[kLevels][kLevels];
  long double h = length;
  table[0][0] = h / 2 * (f(0) + f(length));
  for (int i = 1; i < kLevels; ++i) {
    h /= 2;
    Complex sum = 0;
    for (long j = 1; j < (1L << i); j += 2) sum += f(j * h);
    table[i][0] = table[i - 1][0] / 2.0L + h * sum;
    long double power = 1;
    for (int m = 1; m <= i; ++m) {
      power *= 4;
      table[i][m] = table[i][m - 1] + (table[i][m - 1] - table[i - 1][m - 1]) / (power - 1);
    }
  }
  return table[kLevels - 1][9];
}

TEST(Clothoid, GivesThePublishedFresnelIntegrals) {
  // C(x) + i S(x) with the kernel exp(i pi t^2 / 2): k0 = 0, k1 = pi. Abramowitz and Stegun, table 7.7.
  struct Row {
    double x, c, s;
  };
  for (const Row row : {Row{0.5, 0.4923442, 0.0647324}, Row{1.0, 0.7798934, 0.4382591}, Row{2.0, 0.4882534, 0.3434157},
                        Row{5.0, 0.5636312, 0.4991914}}) {
    const Eigen::Vector2d end = ClothoidIntegral(0.0, kPi, row.x);
    EXPECT_NEAR(end.x(), row.c, 5.1e-8) << row.x;
    EXPECT_NEAR(end.y(), row.s, 5.1e-8) << row.x;
  }
  // C and S go to 1/2 as 1/2 + sin(pi x^2 / 2) / (pi x): at x = 100 the sine is 0 and the rest is of order x^-3.
  const Eigen::Vector2d far = ClothoidIntegral(0.0, kPi, 100.0);
  EXPECT_NEAR(far.x(), 0.5, 1e-6);
  EXPECT_NEAR(far.y(), 0.5 - 1.0 / (kPi * 100.0), 1e-6);
}

TEST(Clothoid, EndPointsAgreeWithAnotherIntegration) {
  for (const double k0 : {0.0, 0.002, -0.01, 0.033, -0.1}) {
    for (const double k_end : {0.0, 0.001, 0.01, -0.02, 0.05}) {
      for (const double length : {0.5, 17.0, 100.0, 300.0}) {
        const double k1 = (k_end - k0) / length;
        const Eigen::Vector2d end = ClothoidIntegral(k0, k1, length);
        const Complex other = Romberg(k0, k1, length);
        EXPECT_NEAR(end.x(), static_cast<double>(other.real()), 1e-11) << k0 << " " << k_end << " " << length;
        EXPECT_NEAR(end.y(), static_cast<double>(other.imag()), 1e-11) << k0 << " " << k_end << " " << length;
      }
    }
  }
}

TEST(Clothoid, TinyChangesOfCurvatureCancelNothing) {
  // Differences of Fresnel integrals are 96 m off here.
  const double k1 = (0.010000000001 - 0.01) / 100.0;
  const Complex other = Romberg(0.01L, k1, 100.0L);
  const Eigen::Vector2d end = ClothoidIntegral(0.01, k1, 100.0);
  EXPECT_NEAR(end.x(), static_cast<double>(other.real()), 1e-11);
  EXPECT_NEAR(end.y(), static_cast<double>(other.imag()), 1e-11);
  // And it is the arc of radius 100 m but for k1 L^3 / 6 = 1.7e-9 m.
  EXPECT_NEAR(end.x(), 100.0 * std::sin(1.0), 2e-9);
  EXPECT_NEAR(end.y(), 100.0 * (1.0 - std::cos(1.0)), 2e-9);
}

TEST(Clothoid, BecomesTheArcAndTheLine) {
  for (const double radius : {1.0, 30.0, -200.0, 1e5}) {
    for (const double length : {0.1, 10.0, 250.0}) {
      const Eigen::Vector2d end = ClothoidIntegral(1.0 / radius, 0.0, length);
      EXPECT_NEAR(end.x(), radius * std::sin(length / radius), 1e-10) << radius;
      EXPECT_NEAR(end.y(), 2.0 * radius * std::pow(std::sin(0.5 * length / radius), 2), 1e-10) << radius;
    }
  }
  EXPECT_NEAR(ClothoidIntegral(0.0, 0.0, 1234.5).x(), 1234.5, 1e-11);
  EXPECT_EQ(ClothoidIntegral(0.0, 0.0, 1234.5).y(), 0.0);
  EXPECT_EQ(ClothoidIntegral(0.02, 0.001, 0.0), Eigen::Vector2d::Zero());
}

TEST(Clothoid, RunsBackward) {
  // Back along the same curve: the start seen from s = 20 with the curvature there.
  const double k0 = 0.01, k1 = 0.0005, length = 20.0;
  const Eigen::Vector2d there = ClothoidIntegral(k0, k1, length);
  const Eigen::Vector2d back = ClothoidIntegral(k0 + k1 * length, k1, -length);
  const double heading = k0 * length + 0.5 * k1 * length * length;
  EXPECT_NEAR(there.x() + std::cos(heading) * back.x() - std::sin(heading) * back.y(), 0.0, 1e-13);
  EXPECT_NEAR(there.y() + std::sin(heading) * back.x() + std::cos(heading) * back.y(), 0.0, 1e-13);
}

}  // namespace
}  // namespace rodeira::geometry
