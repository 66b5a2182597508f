// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace rodeira::dynamics {

// Pacejka's Magic Formula, version 6.1 (H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed., 2012, chapter 4.3), forces
// Fx and Fy with combined slip, camber and inflation pressure; turn slip and the moments are left out. Version 5.2 (the
// same book's 2nd ed., 2006, chapter 4.3) is the same with the newer coefficients at their defaults, but for the terms
// of camber: the side force is shifted by PHY3 instead of by PKY6 and PKY7, LGAX and LGAY scale the camber, and the
// vertical shift of Fy is scaled with friction itself. Names are those of the .tir files in lower case.
enum class MagicFormulaVersion { k61, k52 };

// The side of a car on which a tyre was measured: mounted on the other one it is its mirror image. kEither: no file
// says.
enum class TyreSide { kEither, kLeft, kRight };

// A tyre of the formula. Coefficients without a comment have no unit.
struct MagicFormulaSettings {
  MagicFormulaVersion version = MagicFormulaVersion::k61;
  TyreSide measured_on = TyreSide::kEither;
  bool mirrored = false;          // it is mounted on the other side
  bool friction_ellipse = false;  // PAC2002: combined slip by the friction ellipse, not by the r coefficients
  double fnomin = 4000.0;         // nominal load, N
  double fzmax = 20000.0;         // above it the formula is evaluated at this load, N
  double nompres = 220000.0;      // Pa
  double inflpres = 220000.0;     // Pa
  // Scale factors.
  double lfzo = 1.0, lcx = 1.0, lmux = 1.0, lex = 1.0, lkx = 1.0, lhx = 1.0, lvx = 1.0;
  double lcy = 1.0, lmuy = 1.0, ley = 1.0, lky = 1.0, lkyc = 1.0, lhy = 1.0, lvy = 1.0;
  double lxal = 1.0, lyka = 1.0, lvyka = 1.0;
  double lgax = 1.0, lgay = 1.0;  // 5.2 only
  // Longitudinal, pure and (r) combined.
  double pcx1 = 1.65, pdx1 = 1.0, pdx2 = 0.0, pdx3 = 0.0, pex1 = 0.0, pex2 = 0.0, pex3 = 0.0, pex4 = 0.0;
  double pkx1 = 20.0, pkx2 = 0.0, pkx3 = 0.0, phx1 = 0.0, phx2 = 0.0, pvx1 = 0.0, pvx2 = 0.0;
  double ppx1 = 0.0, ppx2 = 0.0, ppx3 = 0.0, ppx4 = 0.0;
  double rbx1 = 12.0, rbx2 = 10.0, rbx3 = 0.0, rcx1 = 1.0, rex1 = 0.0, rex2 = 0.0, rhx1 = 0.0;
  // Lateral, pure and (r) combined. pky1 is negative: a positive slip angle gives a force to the right.
  double pcy1 = 1.3, pdy1 = 1.0, pdy2 = 0.0, pdy3 = 0.0, pey1 = 0.0, pey2 = 0.0, pey3 = 0.0, pey4 = 0.0, pey5 = 0.0;
  double pky1 = -18.0, pky2 = 1.5, pky3 = 0.0, pky4 = 2.0, pky5 = 0.0, pky6 = 0.0, pky7 = 0.0;
  double phy1 = 0.0, phy2 = 0.0, phy3 = 0.0 /* 5.2 only */, pvy1 = 0.0, pvy2 = 0.0, pvy3 = 0.0, pvy4 = 0.0;
  double ppy1 = 0.0, ppy2 = 0.0, ppy3 = 0.0, ppy4 = 0.0, ppy5 = 0.0;
  double rby1 = 10.0, rby2 = 8.0, rby3 = 0.0, rby4 = 0.0, rcy1 = 1.0, rey1 = 0.0, rey2 = 0.0, rhy1 = 0.0, rhy2 = 0.0;
  double rvy1 = 0.0, rvy2 = 0.0, rvy3 = 0.0, rvy4 = 0.0, rvy5 = 0.0, rvy6 = 0.0;
};

// A coefficient by the name that it has in .tir files ("PCX1"), for readers of files.
struct MagicFormulaCoefficient {
  std::string_view name;
  double MagicFormulaSettings::*member;
};
// All of them, each once.
std::span<const MagicFormulaCoefficient> MagicFormulaCoefficients();

// What a tyre does, steadily: kappa = -v_sx / |v_x| (1: spinning, -1: locked), tan_alpha = v_y / |v_x|, camber about
// the wheel's x axis. Contact frame: x along the wheel, y to its left.
struct TyreSlip {
  double kappa = 0.0;
  double tan_alpha = 0.0;
  double camber_rad = 0.0;
};
// Of the road on the tyre, in the contact frame: along x, along y (positive to the left).
struct TyreForces {
  double longitudinal_N = 0.0;
  double lateral_N = 0.0;
  double aligning_Nm = 0.0;  // about the contact's z axis, counter-clockwise from above; SteadyForces leaves it at 0
};

// The forces at a load (0 for a load of 0 or less). `friction` of the ground multiplies the peaks, not the stiffness.
TyreForces SteadyForces(const MagicFormulaSettings& tyre, const TyreSlip& slip, double load_N, double friction);

// Slopes at zero slip, both positive: dFx/dkappa and -dFy/dtan(alpha) of a tyre without camber, in N. They do not
// depend on friction. With shifts (PHX, PHY …) they are the formula's K, with its point beside the origin.
double LongitudinalStiffness(const MagicFormulaSettings& tyre, double load_N);
double CorneringStiffness(const MagicFormulaSettings& tyre, double load_N);
// Peaks D = mu Fz in N.
double LongitudinalPeak(const MagicFormulaSettings& tyre, double load_N, double friction);
double LateralPeak(const MagicFormulaSettings& tyre, double load_N, double friction);

}  // namespace rodeira::dynamics
