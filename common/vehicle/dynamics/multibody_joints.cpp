// SPDX-License-Identifier: Apache-2.0
// Forces inside the multibody car.
#include "common/vehicle/dynamics/multibody_model.hpp"

namespace rodeira::dynamics {

void MultibodyModel::ReadOutputs(const config::Map& root) {
  const config::Map mechanism = root.Child("mechanism");
  if (mechanism.Has("outputs"))
    outputs_ = multibody::ReadOutputs(mechanism, multibody::DrawingReader(mechanism), *system_);
}

std::vector<std::string> MultibodyModel::output_names() const {
  std::vector<std::string> names;
  for (const multibody::Output& output : outputs_) names.push_back(output.name);
  return names;
}

std::vector<double> MultibodyModel::Outputs() const {
  std::vector<double> values;
  if (outputs_.empty()) return values;
  const multibody::Balance balance = FindBalance();
  for (const multibody::Output& output : outputs_) values.push_back(output.ValueOf(*system_, balance));
  return values;
}

JointForces MultibodyModel::FindJointForces() {
  if (joints_.empty()) joints_ = multibody::JointsOf(*system_);
  const multibody::Balance balance = FindBalance();
  const Eigen::Matrix3d R_BW = X_WB().linear().transpose();
  JointForces forces;
  for (const multibody::Joint& joint : joints_)
    forces.joints.push_back({joint.body, joint.point, R_BW * joint.force.In(*system_, balance)});
  const multibody::Motion motion = system_->motion();
  for (const multibody::NamedLoad& named : settings_.mechanism.loads) {
    const double force_N = named.load->Force(motion);
    forces.springs.push_back({named.name, force_N, force_N - named.load->ForceAtRest(motion)});
  }
  return forces;
}

// Where the equations are singular: what the step left.
multibody::Balance MultibodyModel::FindBalance() const {
  multibody::Balance balance;
  if (system_->FindBalance(balance)) return balance;
  balance.qdd.assign(system_->qdd().begin(), system_->qdd().end());
  balance.multipliers.assign(system_->multipliers().begin(), system_->multipliers().end());
  return balance;
}

}  // namespace rodeira::dynamics
