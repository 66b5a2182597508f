// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_ways.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/observation.hpp"
#include "common/traffic/perception/occupancy.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Whether a lane change is worth while and safe (MOBIL), and its beginning and end.
class LaneChanges {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::int64_t& time_ns;
    std::span<const std::uint8_t> beside;
    std::span<const ConflictPassage> passages;
    const CurrentTracks& tracks;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const CarFollowing& following;
    const LaneWays& lanes_beside;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<RouteSegments> stretches;
    Occupancy& occupants;
    std::span<Leader> ahead;
    Ways& ways;
    Observation& observation;
  };
  LaneChanges(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // `even_slowly`: also at walking pace, for another reason than speed.
  bool ThinksOfLanes(std::uint32_t id, std::int64_t step_ns, bool even_slowly = false) const;
  // Whether it must change lanes for its route where only slow vehicles can.
  bool NeedsSlowChange(std::uint32_t id) const;
  // Whether it should drive around a stationary vehicle ahead.
  bool GoesRound(std::uint32_t id) const;
  // Not in junctions, and not while zones ahead are granted to it or are due.
  bool MayLeaveLane(std::uint32_t id, bool even_slowly = false) const;
  // Changes to the lane beside.
  void ChangeLanes(std::int64_t step_ns);
  // The next one on a lane beside that finds no gap, is nearer than the leader and must come over to this lane, is let
  // in: followed by braking gently. Those that stand behind others are passed.
  double WantedCourteous(std::uint32_t id, double limit_mps) const;

 private:
  std::optional<LaneChangeOption> Weigh(std::uint32_t id, int side, bool told = false);
  void BeginChange(std::uint32_t id, LaneChangeOption&& way);
  int ToldSide(std::uint32_t id) const;
  void ChangeAsTold(std::uint32_t id, int side);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
