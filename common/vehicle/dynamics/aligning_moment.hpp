// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// Coefficients of the aligning moment M_z; names are those of .tir files in lower case.
struct AligningSettings {
  double unloaded_radius = 0.0;  // R0, m
  double ltr = 1.0, lres = 1.0, lkzc = 1.0, ls = 1.0, lgaz = 1.0 /* 5.2 only */;
  double qbz1 = 0.0, qbz2 = 0.0, qbz3 = 0.0, qbz4 = 0.0, qbz5 = 0.0, qbz9 = 0.0, qbz10 = 0.0, qcz1 = 0.0;
  double qdz1 = 0.0, qdz2 = 0.0, qdz3 = 0.0, qdz4 = 0.0, qdz6 = 0.0, qdz7 = 0.0, qdz8 = 0.0, qdz9 = 0.0;
  double qdz10 = 0.0, qdz11 = 0.0, qez1 = 0.0, qez2 = 0.0, qez3 = 0.0, qez4 = 0.0, qez5 = 0.0;
  double qhz1 = 0.0, qhz2 = 0.0, qhz3 = 0.0, qhz4 = 0.0, ppz1 = 0.0, ppz2 = 0.0;
  double ssz1 = 0.0, ssz2 = 0.0, ssz3 = 0.0, ssz4 = 0.0;
};

struct AligningCoefficient {
  std::string_view name;  // "QBZ1"
  double AligningSettings::*member;
};
// All of them, each once.
std::span<const AligningCoefficient> AligningCoefficients();

// M_z in N m about the contact's z axis, positive counter-clockwise seen from above: trail and residual moment with
// combined slip (Pacejka, 3rd ed., (4.E31) to (4.E49) and (4.E71) to (4.E78); Besselink et al., Vehicle System Dynamics
// 48 (2010), (A54) to (A60)); trail and arm go by FNOMIN without LFZO, as MFeval does to match TNO's solver. 0 for a
// load of 0 or less.
double AligningMoment(const MagicFormulaSettings& tyre, const AligningSettings& aligning, const TyreSlip& slip,
                      double load_N, double friction);

// SteadyForces with AligningMoment as aligning_Nm, in one evaluation. The tyre rolls forward.
TyreForces SteadyForcesWithMoment(const MagicFormulaSettings& tyre, const AligningSettings& aligning,
                                  const TyreSlip& slip, double load_N, double friction);

// The pneumatic trail of those formulas in m, for a tyre with other curves of its forces: of `tyre` only FNOMIN, LFZO,
// LKY, LMUY and the pressures count. `stiffness_ratio` is longitudinal stiffness over cornering stiffness. `load_N` and
// `friction` are above 0.
double PneumaticTrail(const MagicFormulaSettings& tyre, const AligningSettings& aligning, const TyreSlip& slip,
                      double stiffness_ratio, double load_N, double friction);

}  // namespace rodeira::dynamics
