// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/world/lanes/zones.hpp"

namespace rodeira::lanes {

// A light for the traffic of a lane: the line at which a vehicle waits.
struct LaneLight {
  double s_m = 0.0;              // of the road
  std::uint32_t controller = 0;  // index into the network's controllers; it has times
  std::string signal;            // its id
};

// The lights of a lane within [low_s_m, high_s_m] of its road: signals, and references to signals elsewhere, that a
// controller with times controls; ascending. Lights for people on foot alone are none. along: its traffic goes with
// growing s.
std::vector<LaneLight> LightsOfLane(const network::Network& network, const network::LaneKey& lane, bool along,
                                    double low_s_m, double high_s_m);

// A light for the traffic of a track: the line at which a vehicle waits.
struct LightPlace {
  double d_m = 0.0;
  std::uint32_t controller = 0;  // index into the network's controllers; it has times
  std::string signal;            // its id
  std::uint32_t track = 0;
};

// The lights of a track, in the order in which its traffic comes to them; d in metres along it.
std::vector<LightPlace> LightsOf(const Graph& graph, std::uint32_t track);

// The light that holds at d of a track: the last one before it, or, going back over tracks that are the only way here,
// within 60 m.
std::optional<LightPlace> LightFor(const Graph& graph, std::uint32_t track, double d_m);

// The controllers of lights for vehicles that say no times, by id: their lights are dark.
std::vector<std::string> DarkControllers(const network::Network& network);

// Two lights that are green or amber together although their ways cross or merge.
struct GreenTogether {
  std::array<std::uint32_t, 2> controllers{};  // indices into the network's
  std::string sentence;                        // names both
};
// The first such two; nothing where there are none.
std::optional<GreenTogether> FindGreenTogether(const Graph& graph, const Zones& zones);

// Controllers with times of lights that let vehicles go which come from different sides and cross or merge, in pairs of
// indices, the lower one first; ascending. A turn across the way of oncoming traffic yields and is no such pair.
std::vector<std::array<std::uint32_t, 2>> ConflictingControllers(const Graph& graph, const Zones& zones);

// Wrong input where a light for vehicles is never green. Wrong input where two lights are green or amber together with
// ways that come from different sides and cross or merge. A turn across the way of oncoming traffic may be
// green with it: it yields. The two are named, with the line of the later one's green where that is known.
base::Status CheckLights(const Graph& graph, const Zones& zones);

}  // namespace rodeira::lanes
