// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// One direction of a slip-curve tyre: force over load against slip, through (0, 0), the extremum and the asymptote,
// flat from there on. Between the points it is smooth: a parabola to the extremum, a cubic that is level at both ends
// to the asymptote.
struct SlipCurve {
  double extremum_slip = 0.12;    // where the force is largest, over 0
  double extremum_value = 1.0;    // force over load there, on dry asphalt
  double asymptote_slip = 0.6;    // from here on the tyre slides, over extremum_slip
  double asymptote_value = 0.75;  // force over load then, at most extremum_value
};

// The tyre of the source's vehicles (its figure 30): force by slip, each way by its own curve. Both ways together act
// on one ellipse: with x = kappa / extremum, y = tan alpha / extremum and s = |(x, y)|, each curve is read at s and
// shared by x / s and y / s.
struct SlipCurveSettings {
  SlipCurve longitudinal;
  SlipCurve lateral;
};

// Force over load at a slip of either sign (the curve is odd), on ground of friction 1.
double Evaluate(const SlipCurve& curve, double slip);

// As those of the Magic Formula (magic_formula.hpp): forces at a load, N; `friction` of the ground multiplies the
// peaks, not the stiffness. Camber has no effect.
TyreForces SteadyForces(const SlipCurveSettings& tyre, const TyreSlip& slip, double load_N, double friction);
// Slopes at zero slip, both positive: dFx/dkappa and -dFy/dtan(alpha), N. Peaks: the largest force, N.
double LongitudinalStiffness(const SlipCurveSettings& tyre, double load_N);
double CorneringStiffness(const SlipCurveSettings& tyre, double load_N);
double LongitudinalPeak(const SlipCurveSettings& tyre, double load_N, double friction);
double LateralPeak(const SlipCurveSettings& tyre, double load_N, double friction);

}  // namespace rodeira::dynamics
