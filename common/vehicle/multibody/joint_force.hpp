// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {

// What follows where an earlier body, which shares two of the points, keeps their distance for both: the tension along
// that line cannot be told apart.
enum class SharedDistance {
  kRefused,
  kOfTheEarlierBody,  // it bears that tension; sums over the points are right
};

// What acts on one body at one of its points, from outside of it: joints with others, the ground, forces that are
// applied at the point itself. From the body's own equations of motion, F = (M qdd + Φqᵀ λ - Q)_point. Φ are the
// constraints that keep the body rigid and those that act on it at markers or as torques. Q are its weight and the
// loads at its markers and torques. The coordinates spread both over the body's points, where they do not act.
class JointForce {
 public:
  // Wrong input where another body, which shares the points, keeps this one rigid as well, unless `shared` says which
  // one bears it.
  static base::Result<JointForce> Make(const System& system, int body, int point,
                                       SharedDistance shared = SharedDistance::kRefused);
  // In N, in the world's axes, with the accelerations and multipliers of the last step.
  Vector3d Now(const System& system) const;
  // With those of System::FindBalance.
  Vector3d In(const System& system, const Balance& balance) const;

 private:
  Vector3d Total(const System& system, std::span<const double> qdd, std::span<const double> multipliers) const;

  int body_ = 0;
  int point_ = 0;
  std::vector<MassTerm> mass_;
  Form centre_;
  double mass_kg_ = 0.0;
  std::vector<std::pair<Row, int>> rows_;  // and the multiplier of each
  std::vector<std::pair<Tie, int>> ties_;  // and the first of its three
  // Joint rows that act on the body beside its points, and the multiplier of each. The coordinates are doubled: the
  // first half enters through the body's markers and directions, the second half through everything else.
  std::vector<std::pair<Row, int>> beside_;
  std::vector<std::pair<Vector3d, int>> constant_;  // the same of sums: pull at the point
};

}  // namespace rodeira::multibody
