// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Forces inside a multibody car.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace rodeira::dynamics {

/// The force on a body at a point that it shares with bodies before it in the vehicle file.
struct JointForce {
  std::string body;                                   ///< name of the body
  std::string point;                                  ///< name of the point
  Eigen::Vector3d force_B = Eigen::Vector3d::Zero();  ///< force on the body, expressed in B, in N
};

/// The force of an element of the vehicle file's `forces`: a spring with its damper and stops, an anti-roll bar.
struct SpringForce {
  std::string name;       ///< name of the element
  double force_N = 0.0;   ///< the whole force, tension positive, in N; on an angle: torque, in N m
  double damper_N = 0.0;  ///< the part of force_N that depends on velocity
};

/// Forces inside a car at one moment.
struct JointForces {
  std::vector<JointForce> joints;    ///< in the order of the vehicle file's bodies and of their points
  std::vector<SpringForce> springs;  ///< in the order of the vehicle file
};

}  // namespace rodeira::dynamics
