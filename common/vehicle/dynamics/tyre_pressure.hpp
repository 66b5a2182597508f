// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/tyre.hpp"

namespace rodeira::dynamics {

// Gives a tyre another pressure: a share of the one for which its settings are, 0 (flat) to 1.5. By p:
//   vertical stiffness   0.2 + 0.8 p     the carcass bears about a fifth (the formula of T. B. Rhyne, Tire Science and
//                                        Technology 33 (2005) 136-155, gives 17 % for a 175/65 R14 at 2.2 bar)
//   rolling resistance   p^-0.4, at most ten times (a usual exponent of cars' tyres)
//   stiffness along and across  0.35 + 0.65 p below 1, else 1; friction stays
// The flat tyre's numbers are rough: no measured tyre stands behind them. The rolling radius stays.
void SetPressure(TyreSettings& tyre, double share);

}  // namespace rodeira::dynamics
