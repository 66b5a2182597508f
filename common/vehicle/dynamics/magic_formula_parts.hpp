// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/magic_formula.hpp"

namespace rodeira::dynamics {

// What the aligning moment needs of the forces, as measured (not mirrored): with combined slip.
struct MagicFormulaParts {
  TyreForces forces;
  double trail_lateral_N = 0.0;        // the side force that the pneumatic trail multiplies
  double slip_stiffness_N = 0.0;       // Kx
  double cornering_stiffness_N = 0.0;  // Ky with camber, negative
  double stiffness_over_peak = 0.0;    // By Cy
  double shift_horizontal = 0.0;       // SHy
  double shift_vertical_N = 0.0;       // SVy
};
// Precondition: load_N is over 0.
MagicFormulaParts PartsOf(const MagicFormulaSettings& tyre, const TyreSlip& slip, double load_N, double friction);

}  // namespace rodeira::dynamics
