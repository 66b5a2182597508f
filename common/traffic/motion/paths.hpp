// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Paths grow under front bumpers and are forgotten behind rear ones.
class Paths {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const CurrentTrackCache> below;
  };
  struct Writes {
    std::span<Agent> agents;
  };
  Paths(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The path grows under the front bumper and is forgotten behind the rear one. How many lanes for its route it has
  // missed.
  std::uint32_t Follow(std::uint32_t id);
  // Whether its front has come to where its last lane ends or is too narrow for it.
  bool AtTheEnd(std::uint32_t id) const;

 private:
  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
