// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/grants.hpp"
#include "common/traffic/right_of_way/merging.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/right_of_way/passages.hpp"
#include "common/traffic/right_of_way/reservation_table.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Finds closed cycles of vehicles that wait for one another, and ends them.
class Deadlocks {
 public:
  struct Reads {
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const RouteSegments> stretches;
    std::span<const Leader> ahead;
    std::span<const ConflictPassage> passages;
    const ReservationTable& book;
    const std::vector<std::uint32_t>& heads;
    const std::vector<std::uint32_t>& held_up;
    const Merging& merging;
  };
  struct Writes {
    std::span<Agent> agents;
    Passages& passages_ahead;
    Grants& grants;
  };
  Deadlocks(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Ends every cycle that there is in this step.
  void ResolveDeadlocks();

 private:
  std::int64_t WaitsFor(std::uint32_t id) const;
  std::vector<std::uint32_t> FindWaitCycle(std::uint32_t start, std::vector<std::uint8_t>& seen) const;
  bool RevokeReservation(std::uint32_t id);
  bool IsAtLine(std::uint32_t id) const;
  bool AreInOneAnothersWay(std::span<const std::uint32_t> some) const;
  bool GrantCycle(const std::vector<std::uint32_t>& circle);
  void BreakDeadlock(std::vector<std::uint32_t> circle);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
