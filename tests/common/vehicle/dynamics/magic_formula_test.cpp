// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/magic_formula.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/core/base/random.hpp"
#include "common/vehicle/dynamics/tir_file.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

const std::filesystem::path kTir =
    std::filesystem::path(SourceDir()) / "../shared/data/tyre/mfeval_MagicFormula61_Parameters.tir";

// Values of an independent implementation for a 255/55 tyre (facts page, Tyre).
TEST(MagicFormula, AgreesWithAnIndependentImplementationOfVersion61) {
  if (!std::filesystem::exists(kTir)) GTEST_SKIP() << "the tyre file " << kTir << " is not on this machine";
  const MagicFormulaSettings tyre = LoadTir(kTir).value();
  struct Row {
    double load, kappa, alpha, fx, fy;
  };
  for (const Row& row : {Row{6752, .05, 0, 7471.078083, 33.037361}, Row{6752, -.1, 0, -7388.505990, -116.438822},
                         Row{6752, 0, .05, 45.968645, -5353.919628}, Row{3376, 0, .05, 18.029842, -2855.968625}}) {
    const TyreForces forces = SteadyForces(tyre, {row.kappa, row.alpha, 0.0}, row.load, 1.0);
    EXPECT_NEAR(forces.longitudinal_N, row.fx, 1e-6) << row.kappa << " " << row.alpha;
    EXPECT_NEAR(forces.lateral_N, row.fy, 1e-6) << row.kappa << " " << row.alpha;
  }
}

TEST(MagicFormula, TheStiffnessIsTheSlopeAtTheOrigin) {
  const MagicFormulaSettings tyre = DefaultSettings().tyre[0].formula;
  constexpr double kProbe = 1e-6;
  for (const double load : {500.0, 2000.0, 3500.0, 7000.0}) {
    const double fx = SteadyForces(tyre, {kProbe, 0.0, 0.0}, load, 1.0).longitudinal_N -
                      SteadyForces(tyre, {-kProbe, 0.0, 0.0}, load, 1.0).longitudinal_N;
    const double fy = SteadyForces(tyre, {0.0, kProbe, 0.0}, load, 1.0).lateral_N -
                      SteadyForces(tyre, {0.0, -kProbe, 0.0}, load, 1.0).lateral_N;
    EXPECT_NEAR(fx / (2 * kProbe) / LongitudinalStiffness(tyre, load), 1.0, 1e-6);
    EXPECT_NEAR(-fy / (2 * kProbe) / CorneringStiffness(tyre, load), 1.0, 1e-6);
  }
}

TEST(MagicFormula, FrictionScalesThePeakAndLeavesTheSlope) {
  const MagicFormulaSettings tyre = DefaultSettings().tyre[0].formula;
  for (const double friction : {0.1, 0.5, 1.0}) {
    double most = 0.0;
    for (double alpha = 0.0; alpha < 1.0; alpha += 1e-4)
      most = std::max(most, -SteadyForces(tyre, {0.0, alpha, 0.0}, 3000.0, friction).lateral_N);
    EXPECT_NEAR(most / LateralPeak(tyre, 3000.0, friction), 1.0, 1e-3);
    EXPECT_NEAR(LateralPeak(tyre, 3000.0, friction), friction * LateralPeak(tyre, 3000.0, 1.0), 1e-9);
    EXPECT_NEAR(
        -SteadyForces(tyre, {0.0, 1e-6, 0.0}, 3000.0, friction).lateral_N * 1e6 / CorneringStiffness(tyre, 3000.0), 1.0,
        1e-4);
  }
}

// A version with x clamped at pi/2 would stay at the peak; the formula falls beyond it.
TEST(MagicFormula, TheForceFallsBeyondThePeak) {
  const MagicFormulaSettings tyre = DefaultSettings().tyre[0].formula;
  const double peak = LongitudinalPeak(tyre, 3000.0, 1.0);
  EXPECT_LT(std::fabs(SteadyForces(tyre, {-1.0, 0.0, 0.0}, 3000.0, 1.0).longitudinal_N), 0.9 * peak);
  EXPECT_GT(std::fabs(SteadyForces(tyre, {-1.0, 0.0, 0.0}, 3000.0, 1.0).longitudinal_N), 0.5 * peak);
}

RC_GTEST_PROP(MagicFormula, IsOddWithoutShiftsBoundedAndFinite, (std::uint32_t seed)) {
  const MagicFormulaSettings tyre = DefaultSettings().tyre[0].formula;
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what}, low, high);
  };
  const TyreSlip slip{draw(0, -3, 3), draw(1, -3, 3), 0.0};
  const double load = draw(2, -100, 15000);
  const double friction = draw(3, 0, 1.2);
  const TyreForces forces = SteadyForces(tyre, slip, load, friction);
  const TyreForces mirrored = SteadyForces(tyre, {-slip.kappa, -slip.tan_alpha, 0.0}, load, friction);
  RC_ASSERT(forces.longitudinal_N == -mirrored.longitudinal_N && forces.lateral_N == -mirrored.lateral_N);
  RC_ASSERT(std::fabs(forces.longitudinal_N) <= LongitudinalPeak(tyre, load, friction) * (1 + 1e-12));
  RC_ASSERT(std::fabs(forces.lateral_N) <= LateralPeak(tyre, load, friction) * (1 + 1e-12));
  RC_ASSERT(forces.longitudinal_N * slip.kappa >= 0.0 && forces.lateral_N * slip.tan_alpha <= 0.0);
}

// Steady transient = static table: kappa' = -vsx / |vx|, tan alpha' = vy / |vx|, forward and backward.
TEST(Tyre, TheSteadyTransientIsTheStaticTable) {
  const TyreSettings settings = DefaultSettings().tyre[0];
  for (const double vx : {20.0, -20.0}) {
    Tyre tyre;
    const TyreMotion motion{vx, 0.6, -0.8};
    for (int i = 0; i < 2000; ++i) tyre.Advance(settings, motion, 3000.0, 1.0, kStep_s);
    const TyreForces forces = tyre.Forces(settings, motion, 3000.0, 1.0);
    EXPECT_NEAR(tyre.slip(), -0.03, 1e-12);
    EXPECT_NEAR(tyre.slip_angle_tan(), -0.04, 1e-12);
    const TyreForces table = SteadyForces(settings.formula, {-0.03, -0.04, 0.0}, 3000.0, 1.0);
    EXPECT_NEAR(forces.longitudinal_N, table.longitudinal_N, 1e-6);
    EXPECT_NEAR(forces.lateral_N, table.lateral_N, 1e-6);
  }
}

// A step of slip builds up over the distance sigma: 1 - 1/e after it.
TEST(Tyre, TheRelaxationLengthIsADistance) {
  const TyreSettings settings = DefaultSettings().tyre[0];
  for (const double vx : {5.0, 40.0}) {
    Tyre tyre;
    const TyreMotion motion{vx, 0.0, 0.01 * vx};
    const double dt = settings.relaxation_lateral_m / vx / 1000.0;
    for (int i = 0; i < 1000; ++i) tyre.Advance(settings, motion, 3000.0, 1.0, dt);
    (void)tyre.Forces(settings, motion, 3000.0, 1.0);
    EXPECT_NEAR(tyre.slip_angle_tan() / 0.01, 1.0 - std::exp(-1.0), 1e-3);
  }
}

TEST(Tyre, SetToBearBearsWhatFrictionAllows) {
  const TyreSettings settings = DefaultSettings().tyre[0];
  Tyre tyre;
  tyre.SetToBear(settings, {1000.0, -700.0}, 3000.0, 1.0);
  const TyreForces forces = tyre.Forces(settings, {}, 3000.0, 1.0);
  EXPECT_NEAR(forces.longitudinal_N, 1000.0, 1e-3);
  EXPECT_NEAR(forces.lateral_N, -700.0, 1e-3);
  tyre.SetToBear(settings, {5000.0, 0.0}, 3000.0, 0.2);
  EXPECT_LE(tyre.Forces(settings, {}, 3000.0, 0.2).longitudinal_N, LongitudinalPeak(settings.formula, 3000.0, 0.2));
}

}  // namespace
}  // namespace rodeira::dynamics
