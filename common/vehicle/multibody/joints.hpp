// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/vehicle/multibody/joint_force.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::multibody {

// A point that several bodies have, seen from one of them.
struct Joint {
  std::string body;
  std::string point;
  JointForce force;  // on the body at the point
};

// Of each point of two or more bodies: the force on each of them but the first one of the drawing, which bears the
// opposite of their sum where nothing else acts at the point. Of two points that bodies share (a hinge) the tension
// along their line is the earlier body's (SharedDistance).
std::vector<Joint> JointsOf(const System& system);

}  // namespace rodeira::multibody
