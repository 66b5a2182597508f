// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motion/full_motion.hpp"
#include "common/traffic/motion/paths.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/crosswalks.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/right_of_way/claims.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/flow_count.hpp"
#include "common/traffic/state/leaving.hpp"
#include "common/traffic/state/lists.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles leave at the end of their last lane, and enter at its beginning.
class Entering {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::optional<Pedestrians>& people;
    const std::vector<FlowCount>& flows;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<Block>> blocks;
    std::span<const std::uint8_t> at_entry;
    const Neighbours& neighbours;
    const SpeedLimits& limits;
    const Crosswalks& crosswalks;
  };
  struct Writes {
    std::span<Agent> agents;
    std::optional<FullCars>& full;
    std::vector<std::uint32_t>& waiting;
    std::uint64_t& next_grant;
    std::uint64_t& ended;
    std::uint64_t& missed;
    std::span<ConflictPassage> passages;
    std::span<std::uint32_t> missed_now;
    std::vector<Leaver>& leavers;
    Lists<std::uint32_t>& present;
    std::vector<std::uint8_t>& expected;
    Ways& ways;
    Passages& passages_ahead;
    Claims& claims;
    FullMotion& full_motion;
    Paths& paths;
  };
  Entering(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The entry of this trip, drawn at random from the seed, the vehicle and the trip.
  std::uint32_t DrawEntry(std::uint32_t id, std::uint32_t trip) const;
  // The speed from which it can stop before the first zones that are not its own.
  double AtMostForLine(std::uint32_t id);
  // A vehicle at the end of its last lane leaves the road.
  void Leave(std::uint32_t id);
  // It leaves wherever it is, and does not enter again.
  void Remove(std::uint32_t id);
  // In each step: at each entry the first vehicle that waits comes, if there is room for it.
  void Enter();

 private:
  void Clear(std::uint32_t id);
  LeaveReason ReasonOf(std::uint32_t id) const;
  bool IsAmongOthers(std::uint32_t track) const;
  bool IsExpected(std::uint32_t track, double gap_m) const;
  bool TryEnter(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
