// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/friction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace rodeira::dynamics {
namespace {

enum class Role { kSticks, kAtPlus, kAtMinus };
using Roles = std::array<Role, kFrictionElements>;

// Impulses when the elements play these roles: sticking ones make their relative speed vanish.
FrictionVector ImpulsesFor(const Roles& roles, const FrictionMatrix& a, const FrictionVector& s_free,
                           const FrictionVector& bound) {
  FrictionMatrix system = FrictionMatrix::Identity();
  FrictionVector right;
  for (int i = 0; i < kFrictionElements; ++i) {
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
FrictionVector SolveFriction(const FrictionMatrix& a, const FrictionVector& s_free, const FrictionVector& bound) {
  constexpr int kMaxTurns = 500;  // there are 243 patterns
  Roles roles{};                  // begin with what each would do by itself; a bound of 0 never changes its role
  for (int i = 0; i < kFrictionElements; ++i) {
    const double most = a(i, i) * bound[i];
    roles[i] = s_free[i] > most ? Role::kAtMinus : (s_free[i] < -most || most == 0.0 ? Role::kAtPlus : Role::kSticks);
  }
  FrictionVector p = FrictionVector::Zero();
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    p = ImpulsesFor(roles, a, s_free, bound);
    const FrictionVector s = s_free + a * p;
    bool done = true;
    for (int i = 0; i < kFrictionElements && done; ++i) {
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

}  // namespace rodeira::dynamics
