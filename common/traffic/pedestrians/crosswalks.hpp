// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/pedestrians/yielding.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/lanes/foot_crossings.hpp"

namespace rodeira::traffic {

// People on foot and vehicles at crossings.
class Crosswalks {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const Agent> agents;
    std::span<const AgentTraits> traits;
    const std::int64_t& time_ns;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<Block>> blocks;
    std::span<const Leader> ahead;
    const Signals& signals;
  };
  struct Writes {
    std::optional<Pedestrians>& people;
    std::span<Yielding> yielding;
    std::span<double> bars;
    std::vector<AtCrossing>& at_crossings;
    std::vector<ToCrossing>& to_crossings;
  };
  Crosswalks(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // People on foot.
  void LookAtPeople(double dt_s);
  // The speed from which an entering car can stop before the first crossing at which a pedestrian walks or waits; below
  // 0 where it would stand on one.
  double AtMostForPeople(std::uint32_t id) const;
  // Wrong input where the traffic has no pedestrians, or the road no crossing.
  base::Status CheckSpawnPedestrian(std::string_view road, double s_m) const;
  // One more comes to the crossing of a road nearest to a station, from the road's left or right, at once. Wrong input
  // where there is none, or the settings have no `pedestrians`.
  base::Status SpawnPedestrian(std::string_view road, double s_m, bool from_left);

 private:
  bool LightsLetGo(const lanes::FootCrossing& crossing) const;
  void CarsAtCrossings();
  void OthersAtCrossings();
  void Yield(double dt_s);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
