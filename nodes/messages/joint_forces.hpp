// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/joint_forces.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// Forces are rounded to 16 significant bits.
msg::JointForces ToMessage(const dynamics::JointForces& forces);

}  // namespace rodeira::nodes
