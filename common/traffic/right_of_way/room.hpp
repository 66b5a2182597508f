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

// Whether there is room behind conflict zones, by how far each vehicle surely comes.
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

  // How far its front comes whatever others decide: as far as it sees, to the line before zones that are not its own
  // (but for the hand's breadth before it at which it may come to rest), behind the vehicles before it as far as those
  // come, and as far as the holders of its own zones before it let it. One that is told to brake, and one that is no
  // agent, may stop at once. In a ring of followers the one that closes it counts as standing.
  double ReachOf(std::uint32_t id, int depth);
  // Whether a vehicle has gone so far before this one has long been waiting at the end of its zones. One that stands
  // starts so long after all that stand in a row before it; one that drives up to such a row comes as far as its end
  // before.
  bool LeavesInTime(std::uint32_t id, std::uint32_t other, double way_m) const;
  // Whether a standing agent has where to go, as it was seen in the last step: none within 5 m before it or, where it
  // stands at a line before conflict zones, none up to where it would stand behind them.
  bool RoomAhead(std::uint32_t id) const;
  // What others, and it, must know of a vehicle that may come to its zones soon: when, and whether there is room behind
  // them.
  void TellComing(std::uint32_t id);
  // Whether it can stand past the light, behind those that wait there for oncoming traffic, and whether there is room
  // behind the zones for all of them.
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
