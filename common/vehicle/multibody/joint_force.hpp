// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {

// What acts on one body at one of its points, from outside of it: joints with others, the ground, forces that are
// applied there. From the body's own equations of motion, F = (M qdd + Φqᵀ λ - Q)_point with its mass, its weight and
// the constraints that keep it rigid.
class JointForce {
 public:
  // Wrong input where another body, which shares the points, keeps this one rigid as well: the two cannot be told
  // apart.
  static base::Result<JointForce> Make(const System& system, int body, int point);
  // In N, in the world's axes.
  Vector3d Now(const System& system) const;

 private:
  int point_ = 0;
  std::vector<MassTerm> mass_;
  Form centre_;
  double mass_kg_ = 0.0;
  std::vector<std::pair<Row, int>> rows_;  // and the multiplier of each
  std::vector<std::pair<Tie, int>> ties_;  // and the first of its three
};

}  // namespace rodeira::multibody
