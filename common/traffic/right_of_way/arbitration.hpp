// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/thread_pool.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/neighbours.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/claims.hpp"
#include "common/traffic/right_of_way/deadlock.hpp"
#include "common/traffic/right_of_way/grants.hpp"
#include "common/traffic/right_of_way/merging.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"
#include "common/traffic/right_of_way/room.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The phase of right of way: passages, room, reservations, deadlocks.
class RightOfWay {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::optional<Pedestrians>& people;
    const std::int64_t& time_ns;
    base::ThreadPool* pool;
    const CurrentTracks& tracks;
    const Neighbours& neighbours;
  };
  struct Writes {
    std::span<std::uint8_t> beside;
    std::span<std::uint8_t> passes;
    std::span<Leader> ahead;
    std::span<ConflictPassage> passages;
    std::span<double> reaches;
    ReservationTable& book;
    std::vector<std::uint32_t>& coming;
    std::vector<std::uint32_t>& heads;
    std::vector<std::uint32_t>& held_up;
    std::vector<std::uint32_t>& order;
    Passages& passages_ahead;
    Merging& merging;
    Room& room;
    Claims& claims;
    Grants& grants;
    Deadlocks& deadlocks;
  };
  RightOfWay(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Right of way.
  void Arbitrate(double dt_s, std::int64_t turn_ns);

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
