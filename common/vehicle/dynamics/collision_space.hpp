// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/vehicle/dynamics/collision_settings.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// A box that the car may hit: another vehicle, an object beside the road, a piece of a barrier.
struct Obstacle {
  std::uint64_t id = 0;
  Eigen::Vector3d centre_W = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_WO = Eigen::Quaterniond::Identity();
  Eigen::Vector3d half_m = Eigen::Vector3d::Ones();  // along its axes, from the centre
  Eigen::Vector3d v_WO_W = Eigen::Vector3d::Zero();  // of its centre
  Eigen::Vector3d w_WO_W = Eigen::Vector3d::Zero();
};

// One obstacle that the car's box touches: the force on the car, N, in W, at a point; the obstacle gets the opposite.
struct Impact {
  std::uint64_t id = 0;
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitX();  // out of the obstacle, onto the car
  double depth_m = 0.0;                                 // the deepest contact's
  double closing_mps = 0.0;                             // along the normal, positive coming nearer
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_WB_W = Eigen::Vector3d::Zero();  // on the car, about B's origin
};

// The car's box (its outline, from the clearance to its height) among obstacles. Contacts are found by the Open
// Dynamics Engine, box on box; the force at each of n contacts is (k depth + c closing) / n along the normal, at least
// 0, and Coulomb friction across. Remembers nothing: the same pose and obstacles give the same bits.
class CollisionSpace {
 public:
  CollisionSpace(const VehicleDimensions& dimensions, const CollisionSettings& settings);
  ~CollisionSpace();
  CollisionSpace(CollisionSpace&&) noexcept;

  // In the order of the obstacles; those not touched are left out.
  std::vector<Impact> Touch(const VehicleState& car, std::span<const Obstacle> obstacles) const;

 private:
  struct Boxes;

  CollisionSettings settings_;
  BodyBox box_;
  std::unique_ptr<Boxes> boxes_;
};

// What all of them do to the car.
Wrench WrenchOf(std::span<const Impact> impacts);

}  // namespace rodeira::dynamics
