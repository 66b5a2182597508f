// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
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
    const SpeedLimits& limits;
  };
  explicit LaneWays(const Reads& reads) : in_(reads) {}

  // `ends_m`: odometer at which the change must have ended; it is more abrupt then. `tight_m`: the same of one that may
  // be as short as a slow vehicle can drive.
  std::optional<Piece> PieceBeside(std::uint32_t id, int side, double ends_m, double tight_m = kNoBarrier_m) const;
  bool IsPlain(std::uint32_t id, double from_m, double to_m, double tightest_1pm = kTightestLaneChange_1pm) const;
  // Whether its way is so short or bent here that only slow vehicles change lanes.
  bool ChangesSlowly(std::uint32_t id) const;
  bool IsFree(std::uint32_t id, double from_m, double to_m) const;
  std::optional<EndingLane> EndAhead(std::uint32_t id) const;
  // Odometer.
  std::optional<double> WaitsBeside_m(std::uint32_t id) const;
  bool MayCross(std::uint32_t id, int side, double from_m, double to_m) const;
  double RouteEnds(std::uint32_t id) const;
  int FewerChanges(std::uint32_t id, std::uint32_t track) const;
  double LaneEnds(std::uint32_t id) const;

 private:
  Reads in_;
};

}  // namespace rodeira::traffic
