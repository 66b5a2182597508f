// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {

// The end of a lane from which a vehicle has to change to the lane beside; odometers.
struct EndingLane {
  double waits_m = 0.0;  // where its front waits for a gap, at the latest
  double ends_m = 0.0;   // where its change must have ended
};

// The path to the lane beside, and how far lanes and routes go on.
class LaneWays {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::optional<Pedestrians>& people;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<Block>> blocks;
    const bool& any_block;
    std::span<const Leader> ahead;
    const SpeedLimits& limits;
  };
  explicit LaneWays(const Reads& reads) : in_(reads) {}

  // `ends_m`: odometer at which the change must have ended; it is more abrupt then. `tight_m`: the same of one that may
  // be as short as a slow vehicle can drive.
  std::optional<Piece> PieceBeside(std::uint32_t id, int side, double ends_m, double tight_m = kNoBarrier_m) const;
  // Whether its way between two odometers is plain lane: no junction, no conflict zone, no line, no crossing for people
  // on foot, easy to drive, and it goes on.
  bool IsPlain(std::uint32_t id, double from_m, double to_m, double tightest_1pm = kTightestLaneChange_1pm) const;
  // Whether its way is so short or bent here that only slow vehicles change lanes.
  bool ChangesSlowly(std::uint32_t id) const;
  // Whether nothing on its way between two odometers may make it stop: no conflict zone, no line, no crossing for
  // people on foot. Beyond the end of its way nothing does.
  bool IsFree(std::uint32_t id, double from_m, double to_m) const;
  // The blunt end of its lane that its way leads to, for a vehicle that has to go on by the lane beside.
  std::optional<EndingLane> EndAhead(std::uint32_t id) const;
  // Odometer.
  std::optional<double> WaitsBeside_m(std::uint32_t id) const;
  // Odometer of the rear of what stands before it on its lane, if that is kept by a vehicle that is no agent, or was
  // hit, and stands there or comes towards it, and it may go round by a lane beside.
  std::optional<double> GoesRound_m(std::uint32_t id) const;
  // The nearest vehicle on its lane, within 150 m, that is no agent and stands or comes towards it, or is slower than
  // `below_mps`. The gap to one that drives on is to where it could stop.
  std::optional<Leader> BlockedBy(std::uint32_t id, double below_mps = kStandingLeader_mps) const;
  // Whether there is too little room before it to go round.
  bool IsShutIn(std::uint32_t id) const;
  // Room to the first vehicle that is no agent, or was hit, and stands on its way or comes towards it; far where there
  // is none in sight.
  double Blocked_m(std::uint32_t id) const;
  // Whether such a vehicle on the lane that it leaves, at most so far ahead, would stop the lane change that it is in.
  bool IsKept(std::uint32_t id, const RouteSegments& left, double to_m) const;
  // Whether the marks let it over to that side all the way.
  bool MayCross(std::uint32_t id, int side, double from_m, double to_m) const;
  // Where the last track ends on which it can still get over to the lane that its route goes on from; far away where
  // that is not in sight, or no change is needed.
  double RouteEnds(std::uint32_t id) const;
  // By how many changes of lanes less it comes to its route's end from the lane beside than from its own.
  int FewerChanges(std::uint32_t id, std::uint32_t track) const;
  // Where its lane ends, goes over into the lane beside, or parts from its route; far away where none is in sight.
  double LaneEnds(std::uint32_t id) const;

 private:
  template <typename Visit>
  void EachBody(std::uint32_t id, const RouteSegments& way, double to_m, double below_mps, const Visit& visit) const;

  Reads in_;
};

}  // namespace rodeira::traffic
