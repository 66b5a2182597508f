// SPDX-License-Identifier: Apache-2.0
#include "nodes/messages/joint_forces.hpp"

#include "nodes/messages/rounding.hpp"

namespace rodeira::nodes {

msg::JointForces ToMessage(const dynamics::JointForces& forces) {
  msg::JointForces out;
  for (const dynamics::JointForce& joint : forces.joints) {
    msg::JointForce& to = out.joints().emplace_back();
    to.body(joint.body);
    to.point(joint.point);
    to.force_b_x_n(Measured(joint.force_B.x()));
    to.force_b_y_n(Measured(joint.force_B.y()));
    to.force_b_z_n(Measured(joint.force_B.z()));
  }
  for (const dynamics::SpringForce& spring : forces.springs) {
    msg::SpringForce& to = out.springs().emplace_back();
    to.element(spring.name);
    to.force_n(Measured(spring.force_N));
    to.damper_n(Measured(spring.damper_N));
  }
  return out;
}

}  // namespace rodeira::nodes
