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

  void FetchZones(std::size_t id) const;
  void HoldZones(std::uint32_t id);
  void AskForZones();
  void ComeToZones(std::uint32_t id);
  double ArrivesAt(const ApproachingVehicle& comer) const;
  double ClearsAt(const ApproachingVehicle& comer) const;
  bool IsFarEnough(std::uint32_t id, const Crossing& crossing, const ApproachingVehicle& comer, double comes_s,
                   double clears_s) const;
  void ComeLater(std::uint32_t id);
  void OthersAtZones();
  bool TakeFirstZones(std::uint32_t id);

 private:
  double ComesWithin(const ApproachingVehicle& comer, double way_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
