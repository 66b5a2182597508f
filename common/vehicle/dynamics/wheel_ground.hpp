// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {

// The ground under a wheel, as SUELO last told it: a plane through plane_W (m) with the unit normal normal_W.
struct WheelGround {
  Eigen::Vector3d plane_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();
  double friction = 0.0;
  ground::Surface surface = ground::Surface::kOutside;
  bool inside = false;

  // SUELO's answer to the question below the hub. Outside of the world the plane stays.
  void Update(const ground::GroundQuery& query, const ground::GroundPoint& point);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// Asks for the ground under the four hubs (m, in W), one batch (law L4). Outside of the world a wheel goes on upon the
// plane that it knows.
void QueryGround(ground::Ground& ground, const std::array<Eigen::Vector3d, kWheels>& hubs_W,
                 const std::array<WheelGround*, kWheels>& wheels);

struct Plane {
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();
};

// The ground under the car for its body: through the middle of the ground under the wheels, parallel to both diagonals
// of those points; level where they stand too steeply for a ground.
Plane PlaneUnder(const std::array<const WheelGround*, kWheels>& wheels);

}  // namespace rodeira::dynamics
