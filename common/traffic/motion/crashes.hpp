// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/traffic/motion/crashed.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motion/poses.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles that have been hit.
class Crashes {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const Poses& body_poses;
  };
  struct Writes {
    std::span<Agent> agents;
    std::optional<FullCars>& full;
    std::vector<AgentPose>& poses;
  };
  Crashes(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // An impulse on an agent's body, N s, at a point, both in W: from then on it drives no more, but slides on locked
  // wheels and stays where it comes to rest, an obstacle to all others. A push that would change its speed by less than
  // 1 mm/s is nothing to it as long as it drives; nothing happens to one that is not there.
  void Strike(std::uint32_t id, const Eigen::Vector2d& impulse_Ns, const Eigen::Vector2d& point_W);
  // All crashed vehicles slide on for dt_s.
  void StepCrashed(double dt_s);

 private:
  double HeightAt(const Crashed& crashed, double near_z_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
