// SPDX-License-Identifier: Apache-2.0
// Tyre files of other programs: each kind is read, computed by its own equations, or refused in a sentence.
#include "common/vehicle/dynamics/tyre_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "common/vehicle/dynamics/aligning_moment.hpp"
#include "common/vehicle/dynamics/tir_file.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// A PAC2002 file of our own, with the keys of that format: no FITTYP, IP, IP_NOM, LIP, LKYG.
const std::string kPac2002 =
    "[UNITS]\nLENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\n[MODEL]\nPROPERTY_FILE_FORMAT = 'PAC2002'\n"
    "USE_MODE = 14\nTYRESIDE = 'LEFT'\n[DIMENSION]\nUNLOADED_RADIUS = 0.33\n[VERTICAL]\nFNOMIN = 4200\n"
    "[VERTICAL_FORCE_RANGE]\nFZMIN = 100\nFZMAX = 9500\n[SCALING_COEFFICIENTS]\nLMUX = 1\nLKX = 1\nLKYG = 1\nLIP = 1\n"
    "LMUY = 1\nLKY = 1\nLKG = 1\n[TIRE_CONDITIONS]\nIP = 230000\nIP_NOM = 230000\n"
    "[LONGITUDINAL_COEFFICIENTS]\nPCX1 = 1.62\nPDX1 = 1.15\nPDX2 = -0.06\nPEX1 = 0.3\nPKX1 = 23\nPKX2 = 0.4\n"
    "PPX1 = -0.35\nPPX3 = -0.1\nRBX1 = 12.4\nRBX2 = -10.8\nRCX1 = 1.09\n"
    "[LATERAL_COEFFICIENTS]\nPCY1 = 1.32\nPDY1 = 1.03\nPDY2 = -0.12\nPEY1 = -0.9\nPKY1 = -17.5\nPKY2 = 1.6\n"
    "PHY3 = 0.03\nPVY3 = -0.2\nRBY1 = 8\nRBY2 = 9\nRCY1 = 1.04\nRVY1 = 0.05\nRVY4 = 12\nRVY5 = 1.9\nRVY6 = -10\n";

std::string Changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TyreFile Read(const std::string& text) {
  auto file = ParseTyreFile(text, "t.tir");
  EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().Text());
  return file.ok() ? std::move(file).value() : TyreFile();
}

std::string Refusal(const std::string& text) {
  const auto file = ParseTyreFile(text, "t.tir");
  EXPECT_FALSE(file.ok());
  if (file.ok()) return "";
  EXPECT_EQ(file.error().exit_status(), 2);
  return file.error().Text();
}

TyreForces ForcesOf(const TyreFile& file, const TyreSlip& slip, double load_N) {
  TyreSettings tyre;
  tyre.formula = file.formula;
  tyre.model = file.model;
  return SteadyForces(tyre, slip, load_N, 1.0);
}

const TyreSlip kSlips[] = {{0.03, 0.05, 0.02}, {-0.1, 0.02, -0.04}, {0.0, -0.1, 0.0}, {0.2, 0.1, 0.05}};

void ExpectSameForces(const TyreFile& a, const TyreFile& b, double load_N) {
  for (const TyreSlip& slip : kSlips) {
    const TyreForces of_a = ForcesOf(a, slip, load_N), of_b = ForcesOf(b, slip, load_N);
    EXPECT_NEAR(of_a.longitudinal_N, of_b.longitudinal_N, 1e-9) << slip.kappa;
    EXPECT_NEAR(of_a.lateral_N, of_b.lateral_N, 1e-9) << slip.tan_alpha;
  }
}

// Its equations are those of 5.2 (Adams/Tire, PAC2002): the same file with FITTYP 6 is the same tyre.
TEST(TyreFile, Pac2002IsToldByItsFormat) {
  const TyreFile pac = Read(kPac2002);
  EXPECT_EQ(pac.kind, "PAC2002");
  EXPECT_EQ(pac.formula.version, MagicFormulaVersion::k52);
  EXPECT_THAT(pac.warnings, testing::IsEmpty());
  ExpectSameForces(pac, Read(Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 6")), 3900.0);
  EXPECT_EQ(Read(Changed(kPac2002, "USE_MODE", "FITTYP = 5\nUSE_MODE")).kind, "PAC2002");
}

// dpi = (IP - IP_NOM LIP) / (IP_NOM LIP); Kx is Fz PKX1 (1 + PPX1 dpi + …) at the nominal load.
TEST(TyreFile, Pac2002HasItsOwnNamesOfPressure) {
  const TyreFile soft = Read(Changed(kPac2002, "IP = 230000", "IP = 184000"));
  EXPECT_NEAR(LongitudinalStiffness(soft.formula, 4200.0), 4200.0 * 23.0 * (1.0 + 0.35 * 0.2), 1e-6);
  const TyreFile scaled = Read(Changed(Changed(kPac2002, "IP = 230000", "IP = 184000"), "LIP = 1", "LIP = 0.8"));
  EXPECT_NEAR(LongitudinalStiffness(scaled.formula, 4200.0), 4200.0 * 23.0, 1e-6);
}

// With FE_METHOD 'YES' the combined force stays within the ellipse of the peaks, and each pure curve is what it was.
TEST(TyreFile, FrictionEllipseBoundsCombinedSlip) {
  const TyreFile pac = Read(kPac2002), ellipse = Read(Changed(kPac2002, "USE_MODE", "FE_METHOD = 'YES'\nUSE_MODE"));
  const double load_N = 4200.0, px = LongitudinalPeak(ellipse.formula, load_N, 1.0),
               py = LateralPeak(ellipse.formula, load_N, 1.0);
  for (double slip = -0.9; slip <= 0.9; slip += 0.15) {
    EXPECT_NEAR(ForcesOf(ellipse, {slip, 0.0, 0.0}, load_N).longitudinal_N,
                ForcesOf(pac, {slip, 0.0, 0.0}, load_N).longitudinal_N, 1e-6);
    EXPECT_NEAR(ForcesOf(ellipse, {0.0, slip, 0.0}, load_N).lateral_N,
                ForcesOf(pac, {0.0, slip, 0.0}, load_N).lateral_N, 1e-6);
    for (double alpha = -0.4; alpha <= 0.4; alpha += 0.1) {
      const TyreForces f = ForcesOf(ellipse, {slip, alpha, 0.0}, load_N);
      EXPECT_LE(std::hypot(f.longitudinal_N / px, f.lateral_N / py), 1.0 + 1e-9) << slip << " " << alpha;
    }
  }
}

// D sin(C atan(K x / (C D) …)) is the same for -D, and sin(PKY4 …) is odd in PKY4.
TEST(TyreFile, SignsThatMakeTheSameCurveAreRead) {
  const TyreFile pac = Read(kPac2002);
  const TyreFile flipped =
      Read(Changed(Changed(Changed(kPac2002, "PDY1 = 1.03\nPDY2 = -0.12", "PDY1 = -1.03\nPDY2 = 0.12"), "RVY1 = 0.05",
                           "RVY1 = -0.05"),
                   "PDX1 = 1.15\nPDX2 = -0.06", "PDX1 = -1.15\nPDX2 = 0.06"));
  ExpectSameForces(pac, flipped, 5000.0);
  EXPECT_THAT(flipped.warnings, Contains(HasSubstr("PDY1 is negative")));
  const std::string new_kind = Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 61");
  ExpectSameForces(Read(Changed(new_kind, "PKY1 = -17.5", "PKY1 = -17.5\nPKY4 = 1.8")),
                   Read(Changed(new_kind, "PKY1 = -17.5", "PKY1 = 17.5\nPKY4 = -1.8")), 3000.0);
  EXPECT_THAT(Refusal(Changed(kPac2002, "PKY1 = -17.5", "PKY1 = 17.5")),
              HasSubstr("the cornering stiffness at FNOMIN, by PKY1, PKY2 and PKY4, is"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "PKX1 = 23", "PKX1 = -23")), HasSubstr("the slip stiffness at FNOMIN"));
}

TEST(TyreFile, APressureThatIsMissingIsTheNominalOne) {
  const std::string new_kind = Changed(Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 61"),
                                       "IP = 230000\nIP_NOM = 230000", "NOMPRES = 250000");
  const TyreFile file = Read(new_kind);
  EXPECT_EQ(file.formula.inflpres, 250000.0);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("there is no INFLPRES: the tyre is at its nominal pressure")));
  const TyreFile empty = Read(Changed(new_kind, "NOMPRES = 250000", "INFLPRES =   $ left empty\nNOMPRES = 250000"));
  ExpectSameForces(file, empty, 4000.0);
  EXPECT_THAT(empty.warnings, Contains(HasSubstr("values that are left empty count as absent: INFLPRES")));
  const TyreFile only = Read(Changed(new_kind, "NOMPRES = 250000", "INFLPRES = 210000"));
  EXPECT_EQ(only.formula.nompres, 210000.0);
}

TEST(TyreFile, EachFitTypeSaysWhatItIsComputedBy) {
  const auto of = [](const std::string& type) {
    return Read(Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = " + type));
  };
  EXPECT_THAT(of("5").warnings, Contains(HasSubstr("FITTYP 5: computed by the equations of 5.2")));
  EXPECT_THAT(of("51").warnings, Contains(HasSubstr("FITTYP 51: computed by the equations of 5.2")));
  for (const char* type : {"52", "6", "21"}) EXPECT_EQ(of(type).kind, "Magic Formula 5.2") << type;
  EXPECT_THAT(of("52").warnings, Not(Contains(HasSubstr("FITTYP"))));
  EXPECT_THAT(of("62").warnings, Contains(HasSubstr("FITTYP 62: the forces of 6.2 are those of 6.1")));
  const TyreFile old =
      Read(Changed(Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 60"), "IP = 230000", "IP = 150000"));
  EXPECT_EQ(old.formula.inflpres, old.formula.nompres) << "6.0 knows no pressure";
  EXPECT_THAT(old.warnings, Contains(HasSubstr("FITTYP 60")));
}

TEST(TyreFile, WhatIsNotKnownIsPassedOverUnlessItIsMisspelt) {
  const TyreFile file = Read(Changed(kPac2002, "LMUX = 1", "LMUX = 1\nLQZW = 1\nLFYV9 = 2"));
  EXPECT_THAT(file.warnings, Contains(HasSubstr("passed over")));
  EXPECT_THAT(Refusal(Changed(kPac2002, "PDX2 = -0.06", "PDXX2 = -0.06")), HasSubstr("did you mean 'PDX2'?"));
  EXPECT_THAT(Read(Changed(kPac2002, "'LEFT'", "'UNKNOWN'")).warnings, Contains(HasSubstr("TYRESIDE is 'UNKNOWN'")));
  EXPECT_EQ(Read(Changed(kPac2002, "'LEFT'", "'UNKNOWN'")).formula.measured_on, TyreSide::kEither);
  EXPECT_THAT(Read(Changed(kPac2002, "RBY1 = 8\n", "")).warnings, Contains(HasSubstr("these are missing: RBY1")));
}

TEST(TyreFile, OtherFilesAreRefusedInASentence) {
  EXPECT_THAT(Refusal(Changed(kPac2002, "'PAC2002'", "'PAC_MC'")),
              HasSubstr("t.tir:6: PROPERTY_FILE_FORMAT = PAC_MC is a "
                        "motorcycle's tyre; a car's tyre"));
  for (const char* of_motorcycle : {"'MF_MC'", "'MF-MCTYRE'", "'PAC_MC2'"})
    EXPECT_THAT(Refusal(Changed(kPac2002, "'PAC2002'", std::string(of_motorcycle) + "\nFITTYP = 61")),
                HasSubstr("motorcycle's tyre"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "USE_MODE = 14", "MC_CONTOUR_A = 0.5")), HasSubstr("t.tir:7: MC_CONTOUR_A"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "'PAC2002'", "'FTIRE'")),
              HasSubstr("t.tir:6: PROPERTY_FILE_FORMAT is 'FTIRE'"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "'PAC2002'", "'HOUSE'")), HasSubstr("is 'HOUSE', and there is no FITTYP"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "PDY2 = -0.12", "PDY2 = nan")), HasSubstr("'PDY2' is 'nan'; a number"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "PDY2 = -0.12", "PDY1 = 1")), HasSubstr("'PDY1' is given in line"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "FZMAX = 9500", "FZMAX = 1e12")), HasSubstr("t.tir:15: 'FZMAX' is 1e+12 N"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "FZMIN = 100", "FZMIN = 10000")), HasSubstr("a range of loads was expected"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "FZMAX = 9500", "FZMAX = 200")), HasSubstr("that reaches the nominal load"));
  EXPECT_THAT(Refusal(Changed(kPac2002, "FNOMIN = 4200", "FNOMIN = 1e9")), HasSubstr("t.tir:12: 'FNOMIN'"));
  EXPECT_THAT(Refusal("nominal load 4000\n% by hand\n"), HasSubstr("this is no tyre property file (.tir)"));
  EXPECT_THAT(Refusal("{\"Template\": \"RigidTire\"}"), HasSubstr("\"Template\" is 'RigidTire'; 'FialaTire' or"));
}

const std::string kFiala =
    "[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = 'degree'\n[MODEL]\nPROPERTY_FILE_FORMAT = 'FIALA'\n[PARAMETER]\n"
    "VERTICAL_STIFFNESS = 310\nCSLIP = 80000\nCALPHA = 900\nUMIN = 0.7\nUMAX = 0.95\n";

// Against the model's definition (E. Fiala 1954; Adams/Tire): stiffness, the end of adhesion, and full sliding.
// Numbers of another unit or a slip of the pen: forces that no tyre has are refused at their line, those of no road
// vehicle are warned of.
TEST(TyreFile, ValuesThatNoTyreHasAreRefusedAtTheirLine) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return Refusal(Changed(kPac2002, from, to));
  };
  EXPECT_THAT(refused("PDX1 = 1.15", "PDX1 = 1e9"), HasSubstr("t.tir:29: 'PDX1'"));
  EXPECT_THAT(refused("LMUX = 1", "LMUX = 1e9"), HasSubstr("t.tir:29: 'PDX1'"));
  EXPECT_THAT(refused("UNLOADED_RADIUS = 0.33", "UNLOADED_RADIUS = 5e6"), HasSubstr("t.tir:10: 'UNLOADED_RADIUS'"));
  EXPECT_THAT(refused("FNOMIN = 4200", "FNOMIN = 1e-9"), HasSubstr("t.tir:12: 'FNOMIN'"));
  EXPECT_THAT(refused("FZMAX = 9500", "FZMAX = 1e12"), HasSubstr("t.tir:15: 'FZMAX'"));
  EXPECT_THAT(refused("PKX1 = 23", "PKX1 = 23e6"), HasSubstr("t.tir:32: 'PKX1'"));
  EXPECT_THAT(refused("PPX1 = -0.35", "PVX1 = 1e9"), HasSubstr("t.tir:34: 'PVX1'"));
  EXPECT_THAT(Read(kPac2002).warnings, Not(Contains(HasSubstr("usual of"))));
  const auto warned = [](const std::string& from, const std::string& to) {
    return Read(Changed(kPac2002, from, to)).warnings;
  };
  EXPECT_THAT(warned("PDX1 = 1.15", "PDX1 = 8"), Contains(HasSubstr("'PDX1' in line 29:")));
  EXPECT_THAT(warned("IP = 230000\nIP_NOM = 230000", "IP = 230\nIP_NOM = 230"),
              Contains(HasSubstr("'NOMPRES' in line 26:")));
  EXPECT_THAT(warned("PPX1 = -0.35", "PVX1 = 7"), Contains(HasSubstr("'PVX1' in line 34:")));
  EXPECT_THAT(warned("UNLOADED_RADIUS = 0.33", "UNLOADED_RADIUS = 2"), Contains(HasSubstr("in line 10:")));
}

TEST(TyreFile, FialaIsReadInItsUnitsAndSlidesAtItsFriction) {
  const TyreFile file = Read(kFiala);
  EXPECT_EQ(file.kind, "Fiala");
  const double calpha = 900.0 * 180.0 / M_PI, load_N = 3500.0;
  EXPECT_NEAR(-ForcesOf(file, {0.0, 1e-6, 0.0}, load_N).lateral_N / 1e-6, calpha, 1.0);
  EXPECT_NEAR(ForcesOf(file, {1e-6, 0.0, 0.0}, load_N).longitudinal_N / 1e-6, 80000.0, 1e-3);
  EXPECT_NEAR(ForcesOf(file, {0.0, -1.0, 0.0}, load_N).lateral_N, 0.7 * load_N, 1e-9);
  // kappa = -0.3: U = 0.95 - 0.25 * 0.3 = 0.875; F = U Fz - (U Fz)^2 / (4 CSLIP 0.3).
  const double bears = 0.875 * load_N;
  EXPECT_NEAR(ForcesOf(file, {-0.3, 0.0, 0.0}, load_N).longitudinal_N, -(bears - bears * bears / (1.2 * 80000.0)),
              1e-9);
  EXPECT_THAT(Refusal(Changed(kFiala, "UMIN = 0.7", "UMIN = 1.7")), HasSubstr("t.tir:11: 'UMIN' is 1.7"));
  EXPECT_THAT(Refusal(Changed(kFiala, "CSLIP = 80000\n", "")), HasSubstr("a Fiala tyre with 'CSLIP' was expected"));
}

const std::string kTmeasy =
    "{\n  \"Name\": \"ours\", // a comment\n\t\"Template\": \"TMeasyTire\",\n  \"Design\": {\"Width [m]\": 0.2},\n"
    "  \"Parameters\": {\n    \"Vertical\": {\"Nominal Vertical Force [N]\": 3000, \"Tire Vertical Damping [Ns/m]\": "
    "1},\n"
    "    \"Longitudinal\": {\"Initial Slopes dFx/dsx [N]\": [90000, 170000], \"Maximum Fx Load [N]\": [3250, 6000],\n"
    "      \"Sliding Fx Load [N]\": [3000, 5500], \"Slip sx at Maximum Fx\": [0.09, 0.1],\n"
    "      \"Slip sx where sliding begins\": [0.4, 0.5]},\n"
    "    \"Lateral\": {\"Initial Slopes dFy/dsy [N]\": [65000, 100000], \"Maximum Fy Load [N]\": [3100, 5300],\n"
    "      \"Sliding Fy Load [N]\": [3050, 5200], \"Slip sy at Maximum Fy\": [0.18, 0.24],\n"
    "      \"Slip sy where sliding begins\": [0.6, 0.8]}}}\n";

// At the two loads that the file names the curves pass through what it says (Rill, Road Vehicle Dynamics, 3.3).
TEST(TyreFile, TmeasyPassesThroughWhatItsFileSays) {
  const TyreFile file = Read(kTmeasy);
  EXPECT_EQ(file.kind, "TMeasy");
  EXPECT_EQ(file.nominal_N, 3000.0);
  const auto along = [&](double sx, double load_N) {
    return ForcesOf(file, {sx / (1.0 - sx), 0.0, 0.0}, load_N).longitudinal_N;  // driven: kappa / (1 + kappa) = sx
  };
  const auto across = [&](double sy, double load_N) { return -ForcesOf(file, {0.0, sy, 0.0}, load_N).lateral_N; };
  EXPECT_NEAR(along(0.09, 3000.0), 3250.0, 1e-9);
  EXPECT_NEAR(along(0.1, 6000.0), 6000.0, 1e-9);
  EXPECT_NEAR(along(0.4, 3000.0), 3000.0, 1e-9);
  EXPECT_NEAR(across(0.18, 3000.0), 3100.0, 1e-9);
  EXPECT_NEAR(across(0.24, 6000.0), 5300.0, 1e-9);
  EXPECT_NEAR(across(0.9, 6000.0), 5200.0, 1e-9);
  EXPECT_NEAR(across(1e-6, 3000.0) / 1e-6, 65000.0, 1.0);
  // Halfway between: 2 F1 - F2 / 2 - (F1 - F2 / 2) q at q = 1.5, and the slip at the maximum in the middle.
  EXPECT_NEAR(across(0.21, 4500.0), 1.5 * (2.0 * 3100.0 - 2650.0 - (3100.0 - 2650.0) * 1.5), 1e-9);
  const TyreForces locked = ForcesOf(file, {-1.0, 0.0, 0.0}, 3000.0);
  EXPECT_NEAR(locked.longitudinal_N, -3000.0, 1e-6) << "a locked wheel slides";
  EXPECT_THAT(Refusal(Changed(kTmeasy, "[0.4, 0.5]", "[0.05, 0.5]")),
              HasSubstr("t.tir:9: 'Slip sx where sliding begins'"));
  EXPECT_THAT(Refusal(Changed(kTmeasy, "Maximum Fx Load", "Largest Fx Load")), HasSubstr("Maximum Fx Load [N]"));
}

// Half the payload of load index 91 (615 kg, ETRTO) is its nominal load; the friction there is the author's 1.1292.
TEST(TyreFile, TmeasyWithoutParametersIsAUsualTyreOfItsPayload) {
  const TyreFile file = Read("{\"Template\": \"TMeasyTire\", \"Vehicle Type\": \"Passenger\", \"Load Index\": 91}");
  EXPECT_NEAR(file.nominal_N, 0.5 * 615.0 * 9.81, 1e-9);
  TyreSettings tyre;
  tyre.model = file.model;
  EXPECT_NEAR(LongitudinalPeak(tyre, file.nominal_N, 1.0) / file.nominal_N, 1.1292, 1e-9);
  EXPECT_THAT(file.warnings, Contains(HasSubstr("those of a usual passenger car tyre that bears 6033 N were taken")));
}

// At no slip and the nominal load the trail is t = QDZ1 R0, and the moment grows by t |K| with the slip angle; without
// trail there is the residual moment Fz R0 QDZ6 cos(atan(QBZ9 SHf)) (Pacejka, (4.E42), (4.E47)). With SSZ1 a
// longitudinal force turns by its arm.
TEST(TyreFile, TheAligningMomentIsTrailResidualAndArm) {
  const std::string text =
      Changed(Changed(kPac2002, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 61"), "PHY3 = 0.03\nPVY3 = -0.2\n", "");
  const auto with = [&](const std::string& coefficients) {
    const TyreFile file = Read(text + "[ALIGNING_COEFFICIENTS]\nQBZ1 = 9\nQCZ1 = 1.1\nQBZ9 = 12\n" + coefficients);
    EXPECT_TRUE(file.aligning.has_value());
    return file;
  };
  const auto moment = [](const TyreFile& file, const TyreSlip& slip) {
    return AligningMoment(file.formula, *file.aligning, slip, 4200.0, 1.0);
  };
  const TyreFile trail = with("QDZ1 = 0.1\n");
  const double slope = (moment(trail, {0.0, 1e-6, 0.0}) - moment(trail, {0.0, -1e-6, 0.0})) / 2e-6;
  EXPECT_NEAR(slope, 0.1 * 0.33 * CorneringStiffness(trail.formula, 4200.0), 1e-3);
  EXPECT_LT(moment(trail, {0.0, 0.5, 0.0}), 0.2 * moment(trail, {0.0, 0.07, 0.0})) << "the trail goes before the force";
  const TyreFile residual = with("QDZ1 = 0\nQDZ6 = 0.004\n");
  EXPECT_NEAR(moment(residual, {}), 4200.0 * 0.33 * 0.004, 1e-9);
  const TyreFile arm = with("QDZ1 = 0\nSSZ1 = 0.02\n");
  EXPECT_NEAR(moment(arm, {0.05, 0.0, 0.0}), 0.02 * 0.33 * ForcesOf(arm, {0.05, 0.0, 0.0}, 4200.0).longitudinal_N,
              1e-9);
  TyreFile mirrored = residual;
  mirrored.formula.mirrored = true;
  EXPECT_EQ(moment(mirrored, {}), -moment(residual, {}));
  EXPECT_FALSE(Read(kPac2002).aligning.has_value());
}

// Public PAC2002 files that other programs' users have; the forces are an implementation's of its own (the case's
// page).
TEST(TyreFile, PublicFilesAreRead) {
  const auto folder = std::filesystem::path(SourceDir()) / "../shared/data/cases/vehicle/tir";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the tyre file " << folder << " is not on this machine";
  const auto pacejka = LoadTyreFile(folder / "chrono__HMMWV_pacejka.tir");
  ASSERT_TRUE(pacejka.ok()) << pacejka.error().Text();
  const TyreForces combined = ForcesOf(pacejka.value(), {0.02, 0.05, 0.05}, 4000.0);
  EXPECT_NEAR(combined.longitudinal_N, 1307.252, 1e-3);
  EXPECT_NEAR(combined.lateral_N, -3033.499, 1e-3);
  const auto goodyear = LoadTyreFile(folder / "chrono__335_65R22_5_G275MSA_95psi.tir");
  ASSERT_TRUE(goodyear.ok()) << goodyear.error().Text();
  EXPECT_NEAR(ForcesOf(goodyear.value(), {0.0, 0.05, 0.0}, 20000.0).lateral_N, -6629.9, 0.05);
  EXPECT_TRUE(LoadTyreFile(folder / "chrono__HMMWV_Pac02Tire.tir").ok());
}

}  // namespace
}  // namespace rodeira::dynamics
