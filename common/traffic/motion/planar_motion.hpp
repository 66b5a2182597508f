// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/current_tracks.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Vehicles that move exactly along their paths, by the steady state of the powertrain.
class PlanarMotion {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    std::span<const CurrentTrackCache> below;
    const CurrentTracks& tracks;
  };
  struct Writes {
    std::span<Agent> agents;
  };
  PlanarMotion(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Brings near what vehicles with numbers a little above this one will read; changes no result.
  void FetchBend(std::size_t id) const;
  // The pedals for the acceleration, and what they give, held over the step; a car that comes to rest stays at rest.
  void MovePlanar(std::uint32_t id, double wanted_mps2, double dt_s);

 private:
  double Advance(std::uint32_t id, double odometer_m) const;
  double Moved(std::uint32_t id, double travel_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
