// SPDX-License-Identifier: Apache-2.0
// The slip-curve tyre: through its points, smooth, of one sign, on an ellipse where it slips both ways.
#include <gtest/gtest.h>

#include <cmath>

#include "common/vehicle/dynamics/tyre.hpp"

namespace rodeira::dynamics {
namespace {

const SlipCurve kCurve{.extremum_slip = 0.1, .extremum_value = 1.1, .asymptote_slip = 0.5, .asymptote_value = 0.7};
const SlipCurveSettings kTyre{
    kCurve, {.extremum_slip = 0.14, .extremum_value = 0.9, .asymptote_slip = 0.6, .asymptote_value = 0.8}};

TEST(SlipCurve, GoesThroughItsPointsAndIsFlatBeyond) {
  EXPECT_EQ(Evaluate(kCurve, 0.0), 0.0);
  EXPECT_NEAR(Evaluate(kCurve, 0.1), 1.1, 1e-12);
  EXPECT_NEAR(Evaluate(kCurve, 0.5), 0.7, 1e-12);
  EXPECT_EQ(Evaluate(kCurve, 7.0), 0.7);
  EXPECT_EQ(Evaluate(kCurve, -0.3), -Evaluate(kCurve, 0.3));
  // Level at the extremum and at the asymptote, without a corner anywhere: the slope changes by its curvature only.
  const double h = 1e-6;
  double before = (Evaluate(kCurve, h) - Evaluate(kCurve, 0.0)) / h;
  for (double slip = 1e-4; slip < 0.7; slip += 1e-4) {
    const double slope = (Evaluate(kCurve, slip + h) - Evaluate(kCurve, slip)) / h;
    EXPECT_LT(std::fabs(slope - before), 1e-4 * 2.0 * 1.1 / 0.01 * 1.01 + 1e-4) << slip;
    EXPECT_LE(slip < 0.1 - 2e-4 ? -slope : slip > 0.1 ? slope : 0.0, 1e-9) << slip;
    before = slope;
  }
}

TEST(SlipCurve, StiffnessIsTheSlopeAndFrictionScalesThePeakOnly) {
  const double load = 3000.0, h = 1e-7;
  EXPECT_NEAR(SteadyForces(kTyre, {h, 0.0, 0.0}, load, 1.0).longitudinal_N / h, LongitudinalStiffness(kTyre, load),
              1e-4 * LongitudinalStiffness(kTyre, load));
  EXPECT_NEAR(-SteadyForces(kTyre, {0.0, h, 0.0}, load, 0.3).lateral_N / h, CorneringStiffness(kTyre, load),
              1e-4 * CorneringStiffness(kTyre, load));
  EXPECT_NEAR(LongitudinalStiffness(kTyre, load), 2 * 1.1 / 0.1 * load, 1e-9);
  for (const double friction : {1.0, 0.3}) {
    double most = 0.0;
    for (double slip = 0.0; slip < 2.0; slip += 1e-4)
      most = std::max(most, SteadyForces(kTyre, {slip, 0.0, 0.0}, load, friction).longitudinal_N);
    EXPECT_NEAR(most, LongitudinalPeak(kTyre, load, friction), 1e-3);
    EXPECT_NEAR(most, friction * 1.1 * load, 1e-3);
  }
  EXPECT_EQ(SteadyForces(kTyre, {0.1, 0.1, 0.0}, load, 0.0).longitudinal_N, 0.0);
  EXPECT_EQ(SteadyForces(kTyre, {0.1, 0.1, 0.0}, -1.0, 1.0).lateral_N, 0.0);
}

TEST(SlipCurve, BothWaysTogetherStayOnTheEllipse) {
  const double load = 3000.0;
  double most = 0.0;
  for (double kappa = -1.0; kappa <= 1.0; kappa += 0.01) {
    for (double alpha = -1.0; alpha <= 1.0; alpha += 0.01) {
      const TyreForces f = SteadyForces(kTyre, {kappa, alpha, 0.0}, load, 0.8);
      EXPECT_GE(f.longitudinal_N * kappa, 0.0);
      EXPECT_LE(f.lateral_N * alpha, 0.0);
      most = std::max(most, std::hypot(f.longitudinal_N / LongitudinalPeak(kTyre, load, 0.8),
                                       f.lateral_N / LateralPeak(kTyre, load, 0.8)));
    }
  }
  EXPECT_LE(most, 1.0 + 1e-12);
  EXPECT_GT(most, 0.99);
}

// The relaxing tyre of the Magic Formula carries the curve as well: steadily it is the table, and what holds a car is
// found again.
TEST(SlipCurve, TheSteadyTransientIsTheTableAndBearsWhatItIsSetTo) {
  TyreSettings settings;
  settings.slip_curve = kTyre;
  Tyre tyre;
  TyreMotion motion;
  motion.vx_mps = 20.0;
  motion.vsx_mps = 0.03 * 20.0;
  motion.vsy_mps = 0.05 * 20.0;
  for (int i = 0; i < 4000; ++i) tyre.Advance(settings, motion, 3000.0, 0.9, 0.001);
  const TyreForces table = SteadyForces(kTyre, {-0.03, 0.05, 0.0}, 3000.0, 0.9);
  const TyreForces now = tyre.Forces(settings, motion, 3000.0, 0.9);
  EXPECT_NEAR(now.longitudinal_N, table.longitudinal_N, 1e-6);
  EXPECT_NEAR(now.lateral_N, table.lateral_N, 1e-6);
  tyre.SetToBear(settings, {700.0, -400.0}, 3000.0, 0.9);
  const TyreForces held = tyre.Forces(settings, {}, 3000.0, 0.9);
  EXPECT_NEAR(held.longitudinal_N, 700.0, 1e-6);
  EXPECT_NEAR(held.lateral_N, -400.0, 1e-6);
}

}  // namespace
}  // namespace rodeira::dynamics
