// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/right_of_way/merging.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Whether there is space behind conflict zones, from the distance that each vehicle certainly travels.
class Room {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const double& longest_half_m;
    std::span<const RouteSegments> stretches;
    const Occupancy& occupants;
    std::span<const std::vector<Block>> blocks;
    const bool& any_block;
    std::span<const Leader> ahead;
    std::span<const double> bars;
    const Ways& ways;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const Merging& merging;
  };
  struct Writes {
    std::span<ConflictPassage> passages;
    std::span<double> reaches;
    Passages& passages_ahead;
  };
  Room(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The distance that its front certainly travels, whatever others decide: at most its sight, to the stop line before
  // zones that it has not reserved (less the margin at which it may stop), behind its leaders as far as these travel,
  // and as far as earlier reservations of its zones allow. A vehicle under a braking command, or outside of the traffic
  // model, may stop at once. In a cycle of followers the vehicle that closes the cycle counts as stationary.
  double ReachOf(std::uint32_t id, int depth);
  // Whether `other` has travelled way_m before this vehicle has waited long at the end of its zones. A stationary
  // vehicle starts after all vehicles of the queue ahead of it; a moving one first drives up to the end of the
  // queue.
  bool LeavesInTime(std::uint32_t id, std::uint32_t other, double way_m) const;
  // Whether a stationary vehicle has free space ahead, as of the last step: no vehicle within 5 m or, at the stop line
  // of conflict zones, no vehicle up to the place where it would stop behind the zones.
  bool RoomAhead(std::uint32_t id) const;
  // Publishes, for itself and others, when a vehicle may arrive at its zones, and whether there is space behind
  // them.
  void TellComing(std::uint32_t id);
  // Whether it can wait past the signal, behind vehicles that wait there for oncoming traffic, and whether the space
  // behind the zones suffices for all of them.
  bool RoomToWait(std::uint32_t id);

 private:
  template <class Tell>
  void EachAhead(std::uint32_t id, double to_m, int depth, const Tell& tell);
  double ReachBehindThose(std::uint32_t id, double to_m, int depth);
  void FindRoom(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
