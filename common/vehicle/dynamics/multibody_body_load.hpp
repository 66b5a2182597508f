// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "common/vehicle/dynamics/collision_settings.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/load.hpp"

namespace rodeira::dynamics {

// What the chassis takes from outside but for its wheels: a push that is set before the step, and the ground under the
// corners of the car's box, by which the car lies on its side or its roof. The ground's force follows the motion within
// the step.
class BodyLoad final : public multibody::Load {
 public:
  BodyLoad(const multibody::Frame& chassis, const CollisionSettings& settings)
      : chassis_(chassis), settings_(settings) {}

  // Where B and the corners of the box lie in the chassis as it is drawn. Until then nothing acts.
  void SetBody(const Eigen::Isometry3d& X_CB, const VehicleDimensions& dimensions);
  // For the coming step: about B's origin, in W.
  void SetPush(const Wrench& push) { push_ = push; }
  // The plane that the corners meet: a point of it and its upward unit normal.
  void SetGround(const Eigen::Vector3d& point_W, const Eigen::Vector3d& normal_W) {
    ground_W_ = point_W;
    normal_W_ = normal_W;
  }
  // No corner meets any ground until the next SetGround.
  void LeaveGround() { SetGround({0.0, 0.0, -1e9}, Eigen::Vector3d::UnitZ()); }

  void Add(const multibody::Motion& motion, multibody::Sink& sink) const override;
  double Energy(const multibody::Motion& motion) const override;
  double Force(const multibody::Motion& motion) const override;  // of the ground, along its normal

 private:
  Eigen::Vector3d OnCorner(const multibody::Form& corner, const multibody::Motion& motion) const;

  multibody::Frame chassis_;
  CollisionSettings settings_;
  multibody::Form origin_;  // of B
  std::array<multibody::Form, 8> corners_;
  Wrench push_;
  Eigen::Vector3d ground_W_{0.0, 0.0, -1e9};
  Eigen::Vector3d normal_W_ = Eigen::Vector3d::UnitZ();
};

}  // namespace rodeira::dynamics
