// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/claims.hpp"
#include "common/traffic/right_of_way/merging.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"
#include "common/traffic/right_of_way/room.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Reservations: a vehicle gets all zones of its passage at once, or none; one that turns across oncoming traffic at a
// light may get those before that traffic, and waits there.
class Grants {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const Leader> ahead;
    const SpeedLimits& limits;
    const Merging& merging;
    const Claims& claims;
    const Signals& signals;
  };
  struct Writes {
    std::span<Agent> agents;
    std::uint64_t& next_grant;
    std::span<ConflictPassage> passages;
    ReservationTable& book;
    Passages& passages_ahead;
    Room& room;
  };
  Grants(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // It has waited longer than kPriorityWait_s, or waits within a junction at a light that is no longer green.
  bool Urgent(std::uint32_t id) const;
  // Whether the holder of the zone takes up the same room behind it, and does not go round there.
  bool TakesRoom(const Crossing& crossing) const;
  // Whether another vehicle keeps it out of a zone of its passage. `heeded`: one that has waited longer does so, too.
  bool IsHeld(std::uint32_t id, bool heeded = false);
  // Grants the passage unless a vehicle is in its way: holds one of the zones or, where the agent has to yield, comes
  // to one or has waited longer.
  bool Grant(std::uint32_t id, bool yields);
  // Grants the zones before those of oncoming traffic that it has to yield to, for it to wait there.
  bool GrantToWait(std::uint32_t id);

 private:
  bool ClearsJunction(std::uint32_t id) const;
  void Take(std::uint32_t id, std::size_t crossings, const ZoneGrant& grant);
  bool RoomBehind(std::uint32_t id, const Crossing& crossing, const Reservation& holder);
  bool Held(std::uint32_t id, const Crossing& crossing, bool heeded);
  double ClearsBehindLeader(std::uint32_t id, double out_m) const;
  bool Yields(std::uint32_t id, const Crossing& crossing);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
