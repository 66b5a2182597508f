// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"
#include "common/traffic/right_of_way/room.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Which vehicles hold each conflict zone, and which come to it.
class Claims {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<Block>> blocks;
    const bool& any_block;
    const std::vector<std::uint32_t>& order;
    const Signals& signals;
    const SpeedLimits& limits;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<ConflictPassage> passages;
    ReservationTable& book;
    std::span<std::uint8_t> is_asked;
    std::vector<std::uint32_t>& asked_sides;
    Room& room;
  };
  Claims(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Brings near what HoldZones of this vehicle will read; changes no result.
  void FetchZones(std::size_t id) const;
  // Its own are the zones that are granted to it and those that it stands in.
  void HoldZones(std::uint32_t id);
  // The sides of zones that matter to agents that may get a reservation now.
  void RequestZones();
  // A head that waits to be granted its zones comes to them; without a query it is not told.
  void ComeToZones(std::uint32_t id);
  // Its front at the zone's beginning.
  double ArrivesAt(const ApproachingVehicle& comer) const;
  // Its rear at the zone's end.
  double ClearsAt(const ApproachingVehicle& comer) const;
  // Where two ways merge, whether the approaching one, surely behind it, need not brake much for it to stay there until
  // it is out of the zone.
  bool IsFarEnough(std::uint32_t id, const Crossing& crossing, const ApproachingVehicle& comer, double comes_s,
                   double clears_s) const;
  // One that was just refused does not come before the vehicle that keeps it out is gone.
  void ComeLater(std::uint32_t id);
  // Vehicles that are no agents.
  void OthersAtZones();
  // The conflict zones at its beginning, up to the next place where it can stand: its own from now on. False where
  // another one holds any of them.
  bool TakeFirstZones(std::uint32_t id);

 private:
  double ComesWithin(const ApproachingVehicle& comer, double way_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
