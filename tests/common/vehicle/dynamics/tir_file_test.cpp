// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/tir_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "common/core/base/random.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using testing::HasSubstr;
const std::filesystem::path kTyres = std::filesystem::path(SourceDir()) / "../shared/data/tyre";

// A file of our own, with what real ones have around the coefficients.
const std::string kGood =
    "[MDI_HEADER]\nFILE_TYPE ='tir'\n$----------units\n[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nANGLE = "
    "'radians'\nMASS = 'kg'\nTIME = 'second'\n"
    "[MODEL]\nFITTYP = 52 $Magic Formula Version number\n[SHAPE]\n{radial width}\n 1.0 0.0\n[INERTIA]\nMASS = 9.3\n"
    "[VERTICAL]\nFNOMIN = 4000\n[SCALING_COEFFICIENTS]\nLMUX = 1\nLGAY = +0.8\n[LONGITUDINAL_COEFFICIENTS]\nPCX1 = 1.6 "
    "$shape\nPDX1 = 1.1\nPKX1 = 2.1E1\n"
    "PVX1 = 0.01\n! a remark\n[LATERAL_COEFFICIENTS]\npcy1=1.3\nPDY1 = 1.0\nPDY2 = -.1\nPDY3 = -4\nPEY1 = -1\nPEY3 = "
    "0.2\nPEY4 = -3.1\nPKY1 = -18\nPKY2 = 1.8\nPKY3 = 0.6\n"
    "PHY1 = 0.003\nPHY2 = -0.001\nPHY3 = 0.04\nPVY1 = 0.02\nPVY3 = -0.3\nPVY4 = -0.2\nRBY1 = 8\nRBY2 = 6\nRBY3 = "
    "0.01\nRCY1 = 1.05\nRHY1 = 0.01\n"
    "RVY1 = 0.02\nRVY3 = -0.4\nRVY4 = 30\nRVY5 = 1.9\nRVY6 = 10\n\r\n";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string ProblemAfter(const std::string& from, const std::string& to) {
  const auto tyre = ParseTir(Replaced(kGood, from, to), "t.tir");
  if (tyre) return "";
  EXPECT_EQ(tyre.error().exit_status(), 2);
  return tyre.error().Text();
}

TEST(TirFile, TakesTheCoefficientsWhateverStandsAroundThem) {
  const auto tyre = ParseTir(kGood, "t.tir");
  ASSERT_TRUE(tyre.ok()) << tyre.error().Text();
  EXPECT_EQ(tyre.value().version, MagicFormulaVersion::k52);
  EXPECT_EQ(tyre.value().fnomin, 4000.0);
  EXPECT_EQ(tyre.value().lgay, 0.8);
  EXPECT_EQ(tyre.value().pkx1, 21.0);
  EXPECT_EQ(tyre.value().pcy1, 1.3);
  EXPECT_EQ(tyre.value().pdy2, -0.1);
  EXPECT_EQ(tyre.value().rvy6, 10.0);
  EXPECT_EQ(tyre.value().pky4, MagicFormulaSettings().pky4) << "version 5.2 has none: the default is what it means";
}

TEST(TirFile, RefusalsNamePlaceAndRemedy) {
  EXPECT_EQ(ProblemAfter("LMUX = 1\n", "LMUX = 0.9\n"), "");
  EXPECT_THAT(ProblemAfter("'newton'", "'pound_force'"),
              HasSubstr("t.tir:6: FORCE is given in 'pound_force'; 'newton' was expected"));
  EXPECT_THAT(
      ProblemAfter("FITTYP = 52", "FITTYP = 22"),
      HasSubstr("t.tir:11: FITTYP is 22; 5, 6, 21, 51, 52 (Magic Formula 5.2) or 60, 61, 62 (6.1) was expected"));
  EXPECT_THAT(ProblemAfter("PDY2 = -.1", "PDY2 = -.1x"), HasSubstr("'PDY2' is '-.1x'; a number was expected"));
  EXPECT_THAT(ProblemAfter("PDY2 = -.1", "PDY2 = nan"), HasSubstr("a number was expected"));
  EXPECT_THAT(ProblemAfter("PDY2 = -.1", "PDY1 = -.1"), HasSubstr("'PDY1' is given in line "));
  EXPECT_THAT(ProblemAfter("PDX1 = 1.1\n", ""), HasSubstr("'PDX1' was expected"));
  EXPECT_THAT(ProblemAfter("PKY1 = -18", "PKY1 = 18"), HasSubstr("a positive slip angle gives a force to the right"));
  EXPECT_THAT(ProblemAfter("FNOMIN = 4000", "FNOMIN = 0"), HasSubstr("'FNOMIN' is 0; more than 0 was expected"));
  EXPECT_THAT(ProblemAfter("PDY2 = -.1", "PDY22 = -.1"),
              HasSubstr("'PDY22' is no coefficient of the Magic Formula; did you mean 'PDY2'?"));
  EXPECT_THAT(ProblemAfter("LMUX = 1", "LMUXX = 1"),
              HasSubstr("t.tir:20: 'LMUXX' is no coefficient of the Magic Formula; did you mean 'LMUX'?"));
  EXPECT_EQ(ProblemAfter("LMUX = 1", "LTR = 1"), "") << "of moments, which nobody asks for here";
  EXPECT_EQ(ProblemAfter("MASS = 9.3", "WEIGHT = 9.3"), "") << "nothing of the forces";
  EXPECT_THAT(ProblemAfter("FITTYP = 52", "TYRESIDE = 'UP'\nFITTYP = 52"),
              HasSubstr("t.tir:11: TYRESIDE is 'UP'; 'LEFT' or 'RIGHT' was expected"));
  EXPECT_EQ(ParseTir("", "t.tir").error().exit_status(), 2);
  EXPECT_EQ(LoadTir("/no/such.tir").error().exit_status(), 2);
}

// Version 5.2 from the book's equations (4.E9) to (4.E67) as they stand there, written a second time.
TyreForces Version52(const MagicFormulaSettings& c, double kappa, double alpha, double gamma, double fz,
                     double friction) {
  const double fz0 = c.fnomin * c.lfzo, df = (fz - fz0) / fz0, gx = gamma * c.lgax, gy = gamma * c.lgay;
  const auto sgn = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  const double lmx = c.lmux * friction, lmy = c.lmuy * friction;
  const double kx = kappa + (c.phx1 + c.phx2 * df) * c.lhx;
  const double mux = (c.pdx1 + c.pdx2 * df) * (1 - c.pdx3 * gx * gx) * lmx;
  const double cx = c.pcx1 * c.lcx, dx = mux * fz;
  const double ex = std::min(1.0, (c.pex1 + c.pex2 * df + c.pex3 * df * df) * (1 - c.pex4 * sgn(kx)) * c.lex);
  const double bx = fz * (c.pkx1 + c.pkx2 * df) * std::exp(c.pkx3 * df) * c.lkx / (cx * dx);
  const double fx0 = dx * std::sin(cx * std::atan(bx * kx - ex * (bx * kx - std::atan(bx * kx)))) +
                     fz * (c.pvx1 + c.pvx2 * df) * c.lvx * lmx;
  const double ay = alpha + (c.phy1 + c.phy2 * df) * c.lhy + c.phy3 * gy;
  const double muy = (c.pdy1 + c.pdy2 * df) * (1 - c.pdy3 * gy * gy) * lmy;
  const double cy = c.pcy1 * c.lcy, dy = muy * fz;
  const double ey = std::min(1.0, (c.pey1 + c.pey2 * df) * (1 - (c.pey3 + c.pey4 * gy) * sgn(ay)) * c.ley);
  const double ky = c.pky1 * fz0 * std::sin(2 * std::atan(fz / (c.pky2 * fz0))) * (1 - c.pky3 * std::fabs(gy)) * c.lky;
  const double by = ky / (cy * dy);
  const double fy0 = dy * std::sin(cy * std::atan(by * ay - ey * (by * ay - std::atan(by * ay)))) +
                     fz * ((c.pvy1 + c.pvy2 * df) * c.lvy + (c.pvy3 + c.pvy4 * df) * gy) * lmy;
  const auto weight = [](double b, double shape, double e, double x) {
    return std::cos(shape * std::atan(b * x - e * (b * x - std::atan(b * x))));
  };
  const double bxa = c.rbx1 * std::cos(std::atan(c.rbx2 * kappa)) * c.lxal, exa = std::min(1.0, c.rex1 + c.rex2 * df);
  const double gxa = weight(bxa, c.rcx1, exa, alpha + c.rhx1) / weight(bxa, c.rcx1, exa, c.rhx1);
  const double byk = c.rby1 * std::cos(std::atan(c.rby2 * (alpha - c.rby3))) * c.lyka,
               eyk = std::min(1.0, c.rey1 + c.rey2 * df);
  const double shy = c.rhy1 + c.rhy2 * df;
  const double gyk = weight(byk, c.rcy1, eyk, kappa + shy) / weight(byk, c.rcy1, eyk, shy);
  const double svy = muy * fz * (c.rvy1 + c.rvy2 * df + c.rvy3 * gy) * std::cos(std::atan(c.rvy4 * alpha)) *
                     std::sin(c.rvy5 * std::atan(c.rvy6 * kappa)) * c.lvyka;
  return {fx0 * std::max(0.0, gxa), fy0 * std::max(0.0, gyk) + svy};
}

void ExpectVersion52(const MagicFormulaSettings& tyre, std::uint32_t seed) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what}, low, high);
  };
  const double kappa = draw(0, -0.3, 0.3), alpha = draw(1, -0.3, 0.3), gamma = draw(2, -0.1, 0.1),
               load = draw(3, 0.3, 1.5) * tyre.fnomin, friction = draw(4, 0.3, 1.0);
  const TyreForces found = SteadyForces(tyre, {kappa, alpha, gamma}, load, friction),
                   expected = Version52(tyre, kappa, alpha, gamma, load, friction);
  RC_ASSERT(std::fabs(found.longitudinal_N - expected.longitudinal_N) <= 1e-6);
  RC_ASSERT(std::fabs(found.lateral_N - expected.lateral_N) <= 1e-6);
}

RC_GTEST_PROP(TirFile, Version52IsTheBooksWithCamberAndCombinedSlip, (std::uint32_t seed)) {
  ExpectVersion52(ParseTir(kGood, "t.tir").value(), seed);
}

RC_GTEST_PROP(TirFile, ARealFileOfVersion52IsReadAndComputed, (std::uint32_t seed)) {
  const auto file = kTyres / "mfeval_MagicFormula52_Parameters.tir";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the tyre file " << file << " is not on this machine";
  static const auto tyre = LoadTir(file);
  RC_ASSERT(tyre.ok());
  RC_ASSERT(tyre.value().version == MagicFormulaVersion::k52);
  RC_ASSERT(tyre.value().phy3 == 0.006973);
  ExpectVersion52(tyre.value(), seed);
}

// On the other side of the car than it was measured on a tyre is its mirror image: conicity and ply steer push to the
// other side. A tyre without a side is the same on both.
TEST(TirFile, TheSideThatATyreWasMeasuredOnIsMirroredOnTheOther) {
  const auto wheels_of = [](const std::string& line) {
    TyreSettings tyre;
    tyre.formula = ParseTir(Replaced(kGood, "FITTYP = 52", line + "FITTYP = 52"), "t.tir").value();
    return OnWheels({tyre, tyre});
  };
  const auto force = [](const TyreSettings& tyre, const TyreSlip& slip) {
    return SteadyForces(tyre, slip, 3500.0, 0.9);
  };
  const TyreSlip slip{0.03, 0.04, 0.02}, image{0.03, -0.04, -0.02};
  const auto either = wheels_of(""), left = wheels_of("TYRESIDE = 'LEFT'\n"), right = wheels_of("TYRESIDE = RIGHT\n");
  const TyreForces as_measured = force(either[0], slip);
  EXPECT_GT(std::fabs(force(either[0], {}).lateral_N), 50.0) << "it has conicity";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(force(either[i], slip).lateral_N, as_measured.lateral_N);
    const bool is_left = i % 2 == 0;
    for (const auto& [tyres, same] : {std::pair(&left, is_left), std::pair(&right, !is_left)}) {
      const TyreForces mounted = force((*tyres)[i], same ? slip : image);
      EXPECT_EQ(mounted.longitudinal_N, as_measured.longitudinal_N);
      EXPECT_EQ(mounted.lateral_N, same ? as_measured.lateral_N : -as_measured.lateral_N);
    }
  }
}

// Camber thrust of version 5.2 at no slip, without the other shifts: dFy/dγ = K PHY3 + Fz PVY3, at the nominal load.
TEST(TirFile, CamberThrustHasItsSlopeInBothVersions) {
  MagicFormulaSettings tyre = ParseTir(kGood, "t.tir").value();
  tyre.lgay = 1.0;
  tyre.phy1 = tyre.phy2 = tyre.pvy1 = 0.0;
  constexpr double kProbe = 1e-6;
  const auto slope = [&] {
    return (SteadyForces(tyre, {0, 0, kProbe}, 4000, 1).lateral_N -
            SteadyForces(tyre, {0, 0, -kProbe}, 4000, 1).lateral_N) /
           (2 * kProbe);
  };
  const double k = -CorneringStiffness(tyre, 4000.0);
  EXPECT_NEAR(slope(), k * 0.04 - 4000.0 * 0.3, 0.01);
  tyre.version = MagicFormulaVersion::k61;  // there PKY6 is the slope
  tyre.pky6 = -0.9;
  EXPECT_NEAR(slope(), 4000.0 * -0.9, 0.01);
}

}  // namespace
}  // namespace rodeira::dynamics
