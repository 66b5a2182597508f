// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/thread_pool.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles driven by the driver of MOTORS.
class MotorsDriving {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    base::ThreadPool* pool;
  };
  struct Writes {
    std::optional<FullCars>& full;
    std::vector<MotorsDriver>& motors;
    std::vector<Eigen::Vector2d>& segments;
  };
  MotorsDriving(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // MOTORS' driver.
  void StartMotors();
  // The mean of both borders with the driver's weight. The first control point of its curve is moved: the others lie as
  // they are.
  Eigen::Vector2d MotorsPoint(const MotorsDriver& driver, std::uint32_t index) const;
  // How many checkpoints the driver's lane has; at least 3.
  std::uint32_t MotorsPoints(const MotorsDriver& driver) const;
  // The point that the driver looks to, two seconds of way on and not beyond the lane's end, and its angle from where
  // the car points.
  Eigen::Vector2d MotorsLooksAt(std::uint32_t id) const;
  // From where the car points to that point, positive to the left; 0 close to it.
  double MotorsTurn_rad(std::uint32_t id, const Eigen::Vector2d& look_W) const;
  // A vehicle stops if its look-ahead crosses that of one on its right (left-hand traffic: on its left). Two seconds of
  // way, to the lane's end.
  void GiveWay();
  // The controls of its car for the coming dt_s.
  void DriveMotors(std::uint32_t id, double dt_s);

 private:
  void TakeLane(std::uint32_t id, const Piece& piece);
  void FollowTrajectory(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
