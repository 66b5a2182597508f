// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/friction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace rodeira::dynamics {
namespace {

enum class Role { kSticks, kAtPlus, kAtMinus };
template <int kElements>
using Roles = std::array<Role, kElements>;

// Impulses when the elements play these roles: sticking ones make their relative speed vanish.
template <int kElements>
FrictionVector<kElements> ImpulsesFor(const Roles<kElements>& roles, const FrictionMatrix<kElements>& a,
                                      const FrictionVector<kElements>& s_free, const FrictionVector<kElements>& bound) {
  FrictionMatrix<kElements> system = FrictionMatrix<kElements>::Identity();
  FrictionVector<kElements> right;
  for (int i = 0; i < kElements; ++i) {
    if (roles[i] == Role::kSticks) {
      system.row(i) = a.row(i);
      right[i] = -s_free[i];
    } else {
      right[i] = roles[i] == Role::kAtPlus ? bound[i] : -bound[i];
    }
  }
  return system.partialPivLu().solve(right);
}

}  // namespace

// Least-index pivoting (K. G. Murty's rule) on the box-constrained complementarity problem: change the role of the
// first element that breaks its condition. Finite for a positive definite A; with five elements a handful of turns.
template <int kElements>
FrictionVector<kElements> SolveFriction(const FrictionMatrix<kElements>& a, const FrictionVector<kElements>& s_free,
                                        const FrictionVector<kElements>& bound) {
  constexpr int kMaxTurns = 500;  // of five elements there are 243 patterns
  Roles<kElements> roles{};       // begin with what each would do by itself; a bound of 0 never changes its role
  for (int i = 0; i < kElements; ++i) {
    const double most = a(i, i) * bound[i];
    roles[i] = s_free[i] > most ? Role::kAtMinus : (s_free[i] < -most || most == 0.0 ? Role::kAtPlus : Role::kSticks);
  }
  FrictionVector<kElements> p = FrictionVector<kElements>::Zero();
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    p = ImpulsesFor<kElements>(roles, a, s_free, bound);
    const FrictionVector<kElements> s = s_free + a * p;
    bool done = true;
    for (int i = 0; i < kElements && done; ++i) {
      if (!(bound[i] > 0.0)) continue;
      Role& role = roles[i];
      const Role before = role;
      if (role == Role::kSticks && p[i] > bound[i])
        role = Role::kAtPlus;
      else if (role == Role::kSticks && p[i] < -bound[i])
        role = Role::kAtMinus;
      else if (role == Role::kAtPlus && s[i] > 0.0)
        role = Role::kSticks;
      else if (role == Role::kAtMinus && s[i] < 0.0)
        role = Role::kSticks;
      done = role == before;
    }
    if (done) break;
  }
  // Rounding can leave two roles that call for each other; the bound holds in any case.
  return p.cwiseMin(bound).cwiseMax(-bound);
}

template FrictionVector<5> SolveFriction<5>(const FrictionMatrix<5>&, const FrictionVector<5>&,
                                            const FrictionVector<5>&);
template FrictionVector<9> SolveFriction<9>(const FrictionMatrix<9>&, const FrictionVector<9>&,
                                            const FrictionVector<9>&);

}  // namespace rodeira::dynamics
