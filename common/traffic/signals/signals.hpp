// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/signals/light_holds.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::traffic {

// Traffic lights: what they show, and which reservations end at a light that is not green.
class Signals {
 public:
  struct Reads {
    const TrafficSettings& settings;
    const TrafficMap& map;
    std::span<const AgentTraits> traits;
    const std::int64_t& time_ns;
    std::span<const RouteSegments> stretches;
    const LightHolds& holds;
  };
  struct Writes {
    std::span<Agent> agents;
    std::vector<network::LightColour>& colours;
  };
  Signals(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Of the network's controller with this index, in this step.
  bool IsGreen(std::int64_t light) const {
    return out_.colours[static_cast<std::size_t>(light)] == network::LightColour::kGreen;
  }
  // What a controller with times shows at a moment, as far as it is known now.
  network::LightColour ColourAt(std::int64_t light, std::int64_t time_ns) const {
    const auto index = static_cast<std::size_t>(light);
    return in_.holds.At(static_cast<std::uint32_t>(light), *in_.map.network->controllers()[index].times, time_ns);
  }
  // What all controllers show in this step; red for those without times.
  void FindColours();
  // The first line of a track beyond a place with a light that is not green, if a car from there with this speed can
  // stop before it; far away where there is none.
  double RedAhead(std::uint32_t track, double from_m, double speed_mps) const;
  // One with a grant past a light that is green no more, and that can stop before it, gives it back. It stands where it
  // would have waited: no holder of a zone of that way counts on it.
  void ApplyLights(std::uint32_t id);

 private:
  bool AllGreen(std::uint32_t id, double from_m, double to_m) const;

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic
