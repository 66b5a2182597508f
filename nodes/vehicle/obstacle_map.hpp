// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/vehicle/dynamics/collision_space.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/network/tubes.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// What stands in a world and stops a car, as boxes: barriers, walls and rails, poles and lamps, trunks of trees,
// buildings, obstacles, the walls and portals of tunnels. Bushes, delineators, signs and all that is lower than 0.3 m
// are driven over. What stands on the ground reaches from 1 m below it to at least 2 m above, so that no car is lifted
// over a rail. A pure function of the world.
class ObstacleMap {
 public:
  ObstacleMap() = default;  // nothing stands anywhere
  // `reach_m`: of the car's body from its B.
  ObstacleMap(const road::World& world, double reach_m);

  // Their ids are their numbers.
  std::span<const dynamics::Obstacle> all() const { return obstacles_; }
  // The object's or the tunnel's id in the roads' file.
  const std::string& NameOf(std::size_t number) const { return names_[number]; }
  // Numbers, ascending, of all that a car with B at p_W may touch, and some around.
  std::span<const std::uint32_t> Near(const Eigen::Vector3d& p_W) const;

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  static Cell CellAt(double x_m, double y_m);

  void AddThing(const road::World& world, const network::Placed& placed);
  void AddSkeleton(const network::Placed& placed, const Eigen::Vector3d& foot_W, const network::Road* road);
  void AddRun(const road::World& world, const network::PlacedRun& run);
  // Its walls, and beside a mouth the portal.
  void AddTube(const network::TubePiece& piece);
  void AddProps(const road::World& world, const network::Props& props);
  // A thing with a known foot; what stands at no road has no outline.
  void AddBody(const network::Placed& placed, const Eigen::Vector3d& foot_W, const network::Road* road);
  // A wall of this width between two feet.
  void AddWall(const std::string& name, const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, double width_m,
               double height_m);
  void AddBox(const std::string& name, const Eigen::Vector3d& foot_W, double heading_rad, const Eigen::Vector3d& size_m,
              bool stands);

  double reach_m_ = 0.0;
  std::vector<dynamics::Obstacle> obstacles_;
  std::vector<std::string> names_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace rodeira::nodes
