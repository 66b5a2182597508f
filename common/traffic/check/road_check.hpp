// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/traffic/check/body_size.hpp"
#include "common/traffic/check/corridors.hpp"
#include "common/traffic/check/joint_gaps.hpp"
#include "common/traffic/state/agent.hpp"

namespace rodeira::traffic {

// Finds vehicles with a middle beside every drivable lane, and wheels beside all that is there for vehicles.
class RoadCheck {
 public:
  // Nothing in it: the vehicle is on the road.
  struct Finding {
    std::optional<double> beside_m;  // from the middle to the nearest road, where the middle is on no drivable lane
    boost::container::static_vector<Eigen::Vector3d, 4> wheels_W;  // those beside the road
  };

  // The graph outlives it.
  RoadCheck(const lanes::Graph& graph, std::size_t vehicles);

  // Vehicles may come in any order; numbers are below `vehicles`.
  Finding Find(const AgentPose& pose, const BodySize& body);

 private:
  // Where parts of a vehicle were in the last look: corridors. A guess; a corridor is asked anew in every look.
  struct Known {
    std::uint32_t rear = Corridors::kNone, middle = Corridors::kNone, front = Corridors::kNone;
  };
  bool IsOnLane(const Eigen::Vector3d& p_W, std::uint32_t& corridor);
  bool IsInOne(const Eigen::Vector3d& p_W, std::uint32_t corridor);
  std::uint32_t Nearest(const Eigen::Vector3d& p_W);
  std::optional<double> BesideLanes(const Eigen::Vector3d& p_W);
  bool IsForVehicles(const Eigen::Vector3d& p_W);

  const lanes::Graph& graph_;
  Corridors corridors_;
  JointGaps gaps_;
  std::vector<Known> known_;  // by vehicle
  network::Hint hint_;
};

}  // namespace rodeira::traffic
