// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/magic_formula.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/vehicle/dynamics/magic_formula_parts.hpp"

namespace rodeira::dynamics {
namespace {

using S = MagicFormulaSettings;
constexpr double kTiny = 1e-9;  // keeps divisions finite where a load or a friction vanishes

constexpr auto kCoefficients = std::to_array<MagicFormulaCoefficient>({
    {"FNOMIN", &S::fnomin}, {"FZMAX", &S::fzmax}, {"NOMPRES", &S::nompres}, {"INFLPRES", &S::inflpres},
    {"LFZO", &S::lfzo},     {"LCX", &S::lcx},     {"LMUX", &S::lmux},       {"LEX", &S::lex},
    {"LKX", &S::lkx},       {"LHX", &S::lhx},     {"LVX", &S::lvx},         {"LCY", &S::lcy},
    {"LMUY", &S::lmuy},     {"LEY", &S::ley},     {"LKY", &S::lky},         {"LKYC", &S::lkyc},
    {"LHY", &S::lhy},       {"LVY", &S::lvy},     {"LXAL", &S::lxal},       {"LYKA", &S::lyka},
    {"LVYKA", &S::lvyka},   {"LGAX", &S::lgax},   {"LGAY", &S::lgay},       {"PCX1", &S::pcx1},
    {"PDX1", &S::pdx1},     {"PDX2", &S::pdx2},   {"PDX3", &S::pdx3},       {"PEX1", &S::pex1},
    {"PEX2", &S::pex2},     {"PEX3", &S::pex3},   {"PEX4", &S::pex4},       {"PKX1", &S::pkx1},
    {"PKX2", &S::pkx2},     {"PKX3", &S::pkx3},   {"PHX1", &S::phx1},       {"PHX2", &S::phx2},
    {"PVX1", &S::pvx1},     {"PVX2", &S::pvx2},   {"PPX1", &S::ppx1},       {"PPX2", &S::ppx2},
    {"PPX3", &S::ppx3},     {"PPX4", &S::ppx4},   {"RBX1", &S::rbx1},       {"RBX2", &S::rbx2},
    {"RBX3", &S::rbx3},     {"RCX1", &S::rcx1},   {"REX1", &S::rex1},       {"REX2", &S::rex2},
    {"RHX1", &S::rhx1},     {"PCY1", &S::pcy1},   {"PDY1", &S::pdy1},       {"PDY2", &S::pdy2},
    {"PDY3", &S::pdy3},     {"PEY1", &S::pey1},   {"PEY2", &S::pey2},       {"PEY3", &S::pey3},
    {"PEY4", &S::pey4},     {"PEY5", &S::pey5},   {"PKY1", &S::pky1},       {"PKY2", &S::pky2},
    {"PKY3", &S::pky3},     {"PKY4", &S::pky4},   {"PKY5", &S::pky5},       {"PKY6", &S::pky6},
    {"PKY7", &S::pky7},     {"PHY1", &S::phy1},   {"PHY2", &S::phy2},       {"PHY3", &S::phy3},
    {"PVY1", &S::pvy1},     {"PVY2", &S::pvy2},   {"PVY3", &S::pvy3},       {"PVY4", &S::pvy4},
    {"PPY1", &S::ppy1},     {"PPY2", &S::ppy2},   {"PPY3", &S::ppy3},       {"PPY4", &S::ppy4},
    {"PPY5", &S::ppy5},     {"RBY1", &S::rby1},   {"RBY2", &S::rby2},       {"RBY3", &S::rby3},
    {"RBY4", &S::rby4},     {"RCY1", &S::rcy1},   {"REY1", &S::rey1},       {"REY2", &S::rey2},
    {"RHY1", &S::rhy1},     {"RHY2", &S::rhy2},   {"RVY1", &S::rvy1},       {"RVY2", &S::rvy2},
    {"RVY3", &S::rvy3},     {"RVY4", &S::rvy4},   {"RVY5", &S::rvy5},       {"RVY6", &S::rvy6},
});

double Sign(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

// The argument that both sine and cosine forms share: C atan(B x - E (B x - atan(B x))).
double Angle(double b, double c, double e, double x) {
  const double bx = b * x;
  return c * std::atan(bx - e * (bx - std::atan(bx)));
}

// sqrt form of cos(atan(x)).
double CosAtan(double x) { return 1.0 / std::sqrt(1.0 + x * x); }

// What both directions need to know about load and pressure.
struct Operating {
  double fz, fz0, dfz, dpi;
};

Operating At(const S& t, double load_N) {
  const double fz = std::min(load_N, t.fzmax);
  const double fz0 = t.fnomin * t.lfzo;
  return {fz, fz0, (fz - fz0) / fz0, (t.inflpres - t.nompres) / t.nompres};
}

double Mux(const S& t, const Operating& o, double camber, double friction) {
  const double mu =
      (t.pdx1 + t.pdx2 * o.dfz) * (1.0 + t.ppx3 * o.dpi + t.ppx4 * o.dpi * o.dpi) * (1.0 - t.pdx3 * camber * camber);
  return std::max(0.0, mu) * t.lmux * friction;
}

double Muy(const S& t, const Operating& o, double camber, double friction) {
  const double mu =
      (t.pdy1 + t.pdy2 * o.dfz) * (1.0 + t.ppy3 * o.dpi + t.ppy4 * o.dpi * o.dpi) * (1.0 - t.pdy3 * camber * camber);
  return std::max(0.0, mu) * t.lmuy * friction;
}

double Kx(const S& t, const Operating& o) {
  return o.fz * (t.pkx1 + t.pkx2 * o.dfz) * std::exp(t.pkx3 * o.dfz) * (1.0 + t.ppx1 * o.dpi + t.ppx2 * o.dpi * o.dpi) *
         t.lkx;
}

double Ky(const S& t, const Operating& o, double camber) {
  const double bend = (t.pky2 + t.pky5 * camber * camber) * (1.0 + t.ppy2 * o.dpi);
  return t.pky1 * o.fz0 * (1.0 + t.ppy1 * o.dpi) * (1.0 - t.pky3 * std::fabs(camber)) *
         std::sin(t.pky4 * std::atan(o.fz / o.fz0 / bend)) * t.lky;
}

// The formula's factor of friction for the vertical shifts, degressive since version 6: it lets them vanish with the
// friction.
double ShiftFactor(const S& t, double lambda) {
  return t.version == MagicFormulaVersion::k52 ? lambda : 10.0 * lambda / (1.0 + 9.0 * lambda);
}

// Version 5.2 scales the camber of each direction by a factor of its own.
double CamberX(const S& t, const TyreSlip& slip) {
  return t.version == MagicFormulaVersion::k52 ? slip.camber_rad * t.lgax : slip.camber_rad;
}
double CamberY(const S& t, const TyreSlip& slip) {
  return t.version == MagicFormulaVersion::k52 ? slip.camber_rad * t.lgay : slip.camber_rad;
}

// A force of one direction alone, and what the friction ellipse needs of its curve.
struct Pure {
  double force_N;
  double slip;        // with the horizontal shift
  double vertical_N;  // vertical shift
  double stiffness_N, peak_N;
};

Pure PureLongitudinal(const S& t, const Operating& o, const TyreSlip& slip, double friction) {
  const double kappa = slip.kappa + (t.phx1 + t.phx2 * o.dfz) * t.lhx;
  const double c = t.pcx1 * t.lcx;
  const double d = Mux(t, o, CamberX(t, slip), friction) * o.fz;
  const double e =
      std::min(1.0, (t.pex1 + t.pex2 * o.dfz + t.pex3 * o.dfz * o.dfz) * (1.0 - t.pex4 * Sign(kappa)) * t.lex);
  const double k = Kx(t, o);
  const double b = k / (c * d + kTiny);
  const double vertical = o.fz * (t.pvx1 + t.pvx2 * o.dfz) * t.lvx * ShiftFactor(t, t.lmux * friction);
  return {d * std::sin(Angle(b, c, e, kappa)) + vertical, kappa, vertical, k, d};
}

Pure PureLateral(const S& t, const Operating& o, const TyreSlip& slip, double friction) {
  const double gamma = CamberY(t, slip);
  const double shift_factor = ShiftFactor(t, t.lmuy * friction);
  const double k = Ky(t, o, gamma);
  const double camber_shift = o.fz * (t.pvy3 + t.pvy4 * o.dfz) * gamma * t.lkyc * shift_factor;
  const double camber_stiffness = o.fz * (t.pky6 + t.pky7 * o.dfz) * (1.0 + t.ppy5 * o.dpi) * t.lkyc;
  const double k_safe = std::fabs(k) < kTiny ? -kTiny : k;
  const double shift_by_camber = t.version == MagicFormulaVersion::k52
                                     ? t.phy3 * gamma * t.lkyc
                                     : (camber_stiffness * gamma - camber_shift) / k_safe;
  const double alpha = slip.tan_alpha + (t.phy1 + t.phy2 * o.dfz) * t.lhy + shift_by_camber;
  const double c = t.pcy1 * t.lcy;
  const double d = Muy(t, o, gamma, friction) * o.fz;
  const double bend = 1.0 + t.pey5 * gamma * gamma - (t.pey3 + t.pey4 * gamma) * Sign(alpha);
  const double e = std::min(1.0, (t.pey1 + t.pey2 * o.dfz) * bend * t.ley);
  const double b = k / (c * d + kTiny);
  const double vertical = o.fz * (t.pvy1 + t.pvy2 * o.dfz) * t.lvy * shift_factor + camber_shift;
  return {d * std::sin(Angle(b, c, e, alpha)) + vertical, alpha, vertical, k, d};
}

// Weight of Fx by the slip angle: 1 at none.
double WeightLongitudinal(const S& t, const Operating& o, const TyreSlip& slip) {
  const double b = (t.rbx1 + t.rbx3 * slip.camber_rad * slip.camber_rad) * CosAtan(t.rbx2 * slip.kappa) * t.lxal;
  const double e = std::min(1.0, t.rex1 + t.rex2 * o.dfz);
  const double weight = std::cos(Angle(b, t.rcx1, e, slip.tan_alpha + t.rhx1)) / std::cos(Angle(b, t.rcx1, e, t.rhx1));
  return std::max(0.0, weight);
}

double WeightLateral(const S& t, const Operating& o, const TyreSlip& slip) {
  const double b =
      (t.rby1 + t.rby4 * slip.camber_rad * slip.camber_rad) * CosAtan(t.rby2 * (slip.tan_alpha - t.rby3)) * t.lyka;
  const double e = std::min(1.0, t.rey1 + t.rey2 * o.dfz);
  const double shift = t.rhy1 + t.rhy2 * o.dfz;
  const double weight = std::cos(Angle(b, t.rcy1, e, slip.kappa + shift)) / std::cos(Angle(b, t.rcy1, e, shift));
  return std::max(0.0, weight);
}

// The side force that longitudinal slip brings about by itself.
double InducedLateral(const S& t, const Operating& o, const TyreSlip& slip, double friction) {
  const double size = Muy(t, o, CamberY(t, slip), friction) * o.fz *
                      (t.rvy1 + t.rvy2 * o.dfz + t.rvy3 * CamberY(t, slip)) * CosAtan(t.rvy4 * slip.tan_alpha);
  return size * std::sin(t.rvy5 * std::atan(t.rvy6 * slip.kappa)) * t.lvyka;
}

// Combined slip without coefficients of its own (Adams/Tire, PAC2002, "Combined slip: friction ellipse"): the slip
// points along tan(beta) = sin(alpha) / kappa, and each force is cut to an ellipse of its own value and the other's
// peak. Where a slip vanishes, force over slip is its stiffness.
TyreForces OnEllipse(const Pure& x, const Pure& y) {
  const double kappa = x.slip + x.vertical_N / (std::fabs(x.stiffness_N) < kTiny ? kTiny : x.stiffness_N);
  const double alpha = y.slip + y.vertical_N / (std::fabs(y.stiffness_N) < kTiny ? -kTiny : y.stiffness_N);
  const double along = std::fabs(kappa), across = std::fabs(std::sin(alpha));
  const auto slope = [](const Pure& pure, double slip) {
    return slip < kTiny ? std::fabs(pure.stiffness_N) : std::fabs(pure.force_N - pure.vertical_N) / slip;
  };
  const double x_share = 1.0 / std::hypot(1.0, slope(x, along) * across / std::max(y.peak_N, kTiny));
  const double y_share = 1.0 / std::hypot(1.0, slope(y, across) * along / std::max(x.peak_N, kTiny));
  return {x.force_N * x_share, y.force_N * y_share, 0.0};
}

}  // namespace

std::span<const MagicFormulaCoefficient> MagicFormulaCoefficients() { return kCoefficients; }

TyreForces SteadyForces(const MagicFormulaSettings& tyre, const TyreSlip& mounted, double load_N, double friction) {
  if (!(load_N > 0.0)) return {};
  const double side = tyre.mirrored ? -1.0 : 1.0;
  const TyreSlip slip{mounted.kappa, side * mounted.tan_alpha, side * mounted.camber_rad};
  const Operating o = At(tyre, load_N);
  const Pure x = PureLongitudinal(tyre, o, slip, friction);
  const Pure y = PureLateral(tyre, o, slip, friction);
  if (tyre.friction_ellipse) {
    const TyreForces forces = OnEllipse(x, y);
    return {forces.longitudinal_N, side * forces.lateral_N, 0.0};
  }
  return {x.force_N * WeightLongitudinal(tyre, o, slip),
          side * (y.force_N * WeightLateral(tyre, o, slip) + InducedLateral(tyre, o, slip, friction)), 0.0};
}

MagicFormulaParts PartsOf(const MagicFormulaSettings& tyre, const TyreSlip& slip, double load_N, double friction) {
  const Operating o = At(tyre, load_N);
  const Pure x = PureLongitudinal(tyre, o, slip, friction), y = PureLateral(tyre, o, slip, friction);
  const Pure upright = slip.camber_rad == 0.0 ? y : PureLateral(tyre, o, {slip.kappa, slip.tan_alpha, 0.0}, friction);
  MagicFormulaParts parts;
  parts.slip_stiffness_N = x.stiffness_N;
  parts.cornering_stiffness_N = std::fabs(y.stiffness_N) < kTiny ? -kTiny : y.stiffness_N;
  parts.stiffness_over_peak = y.stiffness_N / std::max(y.peak_N, kTiny);
  parts.shift_horizontal = y.slip - slip.tan_alpha;
  parts.shift_vertical_N = y.vertical_N;
  if (tyre.friction_ellipse) {
    parts.forces = OnEllipse(x, y);
    parts.trail_lateral_N = parts.forces.lateral_N;
    return parts;
  }
  const double weight = WeightLateral(tyre, o, slip);
  parts.forces = {x.force_N * WeightLongitudinal(tyre, o, slip),
                  y.force_N * weight + InducedLateral(tyre, o, slip, friction), 0.0};
  parts.trail_lateral_N = weight * (tyre.version == MagicFormulaVersion::k52 ? y.force_N : upright.force_N);
  return parts;
}

double LongitudinalStiffness(const MagicFormulaSettings& tyre, double load_N) {
  return load_N > 0.0 ? Kx(tyre, At(tyre, load_N)) : 0.0;
}

double CorneringStiffness(const MagicFormulaSettings& tyre, double load_N) {
  return load_N > 0.0 ? -Ky(tyre, At(tyre, load_N), 0.0) : 0.0;
}

double LongitudinalPeak(const MagicFormulaSettings& tyre, double load_N, double friction) {
  if (!(load_N > 0.0)) return 0.0;
  const Operating o = At(tyre, load_N);
  return Mux(tyre, o, 0.0, friction) * o.fz;
}

double LateralPeak(const MagicFormulaSettings& tyre, double load_N, double friction) {
  if (!(load_N > 0.0)) return 0.0;
  const Operating o = At(tyre, load_N);
  return Muy(tyre, o, 0.0, friction) * o.fz;
}

}  // namespace rodeira::dynamics
