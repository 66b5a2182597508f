// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Accelerations behind a leader, without one, and before a stop.
class CarFollowing {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const SpeedLimits& limits;
  };
  explicit CarFollowing(const Reads& reads) : in_(reads) {}

  // The acceleration with which its front comes to rest there without a jerk, braking by a share of what is comfortable
  // from where it must.
  double StopAt(std::uint32_t id, double odometer_m, double share = 1.0) const;
  // The acceleration of the IDM in m/s²: behind a leader at a gap within sight; else by the limit alone.
  double Following(std::uint32_t id, double limit_mps, bool any, double gap_m, double leader_mps) const;
  // What a follower does behind a leader.
  double FollowerDoes(const Follower& behind, bool any, double gap_m, double leader_mps) const;
  // The acceleration with which it follows another agent that has come in, or comes in, before it: by what that one's
  // driver wants, since what that car does in a change of gears is over at once.
  double FollowComing(std::uint32_t id, std::uint32_t leader, double gap_m) const;

 private:
  Reads in_;
};

}  // namespace rodeira::traffic
