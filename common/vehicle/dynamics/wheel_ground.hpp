// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The ground under the wheels.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

/// An edge of the ground that a wheel turns about: a level line.
struct GroundEdge {
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();   ///< a point of the line, in m
  Eigen::Vector3d ahead_W = Eigen::Vector3d::UnitX();  ///< level, of unit length, across the line: the wheel's way
  bool rises = false;                                  ///< true: the wheel climbs onto it; false: rolls down from it
};

/// The ground under a wheel, as the last query answered it: a plane in the world frame W.
struct WheelGround {
  Eigen::Vector3d plane_W = Eigen::Vector3d::Zero();    ///< a point of the plane, in m
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();  ///< normal of unit length, upward
  double friction = 0.0;                                ///< coefficient of the dry surface, 1: dry asphalt
  ground::Surface surface = ground::Surface::kOutside;  ///< material
  bool inside = false;                                  ///< false: the wheel is outside of the world
  /// What the wheel turns about while it rolls from one plane onto another (RollOn); the plane touches it there.
  std::optional<GroundEdge> edge = std::nullopt;

  /// Takes the answer to the query below the hub. Outside of the world plane and friction stay as they are.
  /// @param query the query
  /// @param point its answer
  void Update(const ground::GroundQuery& query, const ground::GroundPoint& point);

  /// Writes all values.
  /// @param writer receives the fields
  void Save(base::StateWriter& writer) const;
  /// Reads the values of Save.
  /// @param reader the fields
  void Restore(base::StateReader& reader);
};

/// Queries the ground under the four hubs in one batch (law L4). The height of a hub is the query's height hint. A
/// wheel outside of the world keeps its last plane.
/// @param ground the ground
/// @param hubs_W position of each hub in W, in m, in the order of WheelIndex
/// @param wheels receive the answers, in the order of WheelIndex; not null
void QueryGround(ground::Ground& ground, const std::array<Eigen::Vector3d, kWheels>& hubs_W,
                 const std::array<WheelGround*, kWheels>& wheels);

/// A plane in the world frame W.
struct Plane {
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();    ///< a point of the plane, in m
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();  ///< normal of unit length
};

/// Computes the ground under the car for its body: through the mean of the points under the wheels, parallel to both
/// diagonals of those points.
/// @param wheels ground under each wheel, in the order of WheelIndex; not null
/// @return the plane; level if the points lie too steeply for a ground
Plane GroundPlane(const std::array<const WheelGround*, kWheels>& wheels);

}  // namespace rodeira::dynamics
