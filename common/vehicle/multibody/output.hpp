// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/core/config/config.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"
#include "common/vehicle/multibody/joint_force.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {

// One column of a run, named by the file with its unit.
class Output {
 public:
  std::string name;
  // By what the last step left.
  double ValueOf(const System& system) const;
  // Reactions and joint forces by System::FindBalance.
  double ValueOf(const System& system, const Balance& balance) const;

 private:
  friend class OutputReader;
  enum class Kind {
    kPosition,
    kVelocity,
    kAcceleration,
    kAngle,
    kEnergy,
    kKinetic,
    kPotential,
    kReaction,
    kForce,
    kJoint
  };
  Kind kind_ = Kind::kEnergy;
  Form form_;
  int component_ = 0;
  int index_ = 0;  // of a load or a multiplier
  std::optional<JointForce> joint_;
};

// Outputs of a file: NAME: WHAT, where WHAT is "P.x", "P.vx", "P.ax" (y, z likewise), a coordinate "beta", "beta.rate"
// or "beta.acceleration", "angle P Q" (in the plane, from world x, within ±pi), "energy", "kinetic", "potential",
// "reaction CONSTRAINT", "force FORCE" or "joint BODY P.x" (what acts on the body at its point, y, z likewise). Without
// outputs: every point that moves, every coordinate, energy.
std::vector<Output> ReadOutputs(const config::Map& root, const DrawingReader& reader, const System& system);

}  // namespace rodeira::multibody
