// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_ways.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/overtaking/oncoming.hpp"
#include "common/traffic/overtaking/overtaking.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/observation.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Whether to overtake on the lane of oncoming traffic: is the vehicle held up, does the law allow it, is there room?
class OvertakingStart {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const std::uint8_t> is_overtaken;
    std::span<const Leader> ahead;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const CarFollowing& following;
    const LaneWays& lanes_beside;
    const OncomingLane& oncoming;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<RouteSegments> stretches;
    bool& any_overtaking;
    Ways& ways;
    Observation& observation;
  };
  OvertakingStart(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // While it overtakes it is in more of a hurry, and comes nearer to its leader.
  driver::IdmSettings IdmOf(std::uint32_t id) const;
  // Begins to overtake where it is held up, sees the oncoming lane free for long enough, and may.
  void ThinkOfOvertaking(std::uint32_t id);
  // The odometer where a vehicle that is no agent stands before it, or could soon if it is slower than `below_mps`, far
  // from a junction, if it may be passed on the lane of oncoming traffic.
  std::optional<double> PassesStanding_m(std::uint32_t id, double below_mps = kStandingLeader_mps) const;
  // Of one on its path out, from its front bumper on: a shorter rest of it that is clear of the one passed wherever
  // that may stop, and the odometer from which it is; nothing where there is no room for it.
  struct RestOut {
    Piece piece;
    double clear_m = 0.0;
  };
  // Precondition: it is on its path out of the lane.
  std::optional<RestOut> ShorterRest(std::uint32_t id, const Leader& passed) const;
  // The least that it may, and wants to, drive between two odometers.
  double TopSpeed(std::uint32_t id, double from_m, double to_m) const;
  // What is still to be done from now on behind, or beside, the one passed.
  PassCase CaseOf(std::uint32_t id, const Leader& passed, double top_mps, double aside_m, double to_m) const;

 private:
  bool IsHeldUp(std::uint32_t id) const;
  bool HasRoomBefore(std::uint32_t id, const Overtaking& way, const PassPlan& plan, double top_mps);
  std::optional<Piece> WeighOvertaking(std::uint32_t id, Overtaking& way);
  std::optional<Piece> PieceOut(std::uint32_t id, double top_mps) const;
  double Needs_m(std::uint32_t id, const Leader& passed, int side) const;
  void Tighten(std::uint32_t id, Piece& piece) const;
  bool MayOvertake(std::uint32_t id, double to_m, double aside_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
