// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace rodeira::dynamics {

// Dry friction elements that act together during one step: brakes, clutch, drag, differential. Element i lets its parts
// slide with the relative speed s_i and passes an angular impulse p_i (torque × dt) of at most bound_i:
//   s = s_free + A p,   and for each i:  s_i = 0 with |p_i| <= bound_i,  or  p_i = -sign(s_i) bound_i.
// A = G M⁻¹ Gᵗ is symmetric and must be positive definite; the solution is then unique.
template <int kElements>
using FrictionVector = Eigen::Matrix<double, kElements, 1>;
template <int kElements>
using FrictionMatrix = Eigen::Matrix<double, kElements, kElements>;

// Defined for 5 and 9 elements: one and two driven axles.
template <int kElements>
FrictionVector<kElements> SolveFriction(const FrictionMatrix<kElements>& a, const FrictionVector<kElements>& s_free,
                                        const FrictionVector<kElements>& bound);

}  // namespace rodeira::dynamics
