// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/traffic/demand/entering.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/observation.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Where vehicles are at the beginning.
class Placing {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const Leader> ahead;
    const SpeedLimits& limits;
  };
  struct Writes {
    std::span<Agent> agents;
    std::vector<std::uint32_t>& waiting;
    Observation& observation;
    Entering& entering;
  };
  Placing(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Coming and going.
  void PlaceAll(std::span<const driver::Footprint> others);

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
