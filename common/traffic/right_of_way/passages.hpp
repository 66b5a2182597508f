// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/perception/ways.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The next conflict zones on the way of each vehicle.
class Passages {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const RouteSegments> stretches;
    std::span<const std::uint32_t> way_numbers;
    std::span<const double> bars;
  };
  struct Writes {
    std::span<Agent> agents;
    std::span<ConflictPassage> passages;
    std::span<std::array<PlannedAt, 2>> known;
    Signals& signals;
    Ways& ways;
  };
  Passages(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The plan's speed there by its driver's factor, m/s; 0 without a way. `place`, 0 or 1: where the answer is kept for
  // the next call.
  double KnowAllowedAt(std::uint32_t id, double odometer_m, std::size_t place);
  // One that must know now looks on to where it would stand, however slowly it drives: where zones are longer than it
  // sees, the next ones may begin where those end, and one with the first ones alone would stand in them.
  void FindPassage(std::uint32_t id);
  // Its grants and its next passage, and whether it has come to rest at a STOP line or waits for others.
  void ComeToLine(std::uint32_t id, double dt_s);

 private:
  bool KeepPassage(std::uint32_t id);
  void FindCrossings(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
