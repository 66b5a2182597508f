// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/traffic/demand/demand.hpp"
#include "common/traffic/network/traffic_map.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

// Places of a vehicle on its way, and how the way goes on.
namespace rodeira::traffic {

inline constexpr double kNoBarrier_m = 1e18;  // odometer of a barrier that is not there

// Odometer of the front bumper.
inline double FrontOf(const Agent& agent, const AgentTraits& traits) { return agent.o_m + 0.5 * traits.length_m; }
// From the odometer's place to each axle.
inline double HalfBase(const AgentTraits& traits) { return 0.5 * traits.wheelbase_m; }
// The speed that it never drives faster than, whatever the limit.
inline double Cap_mps(const Agent& agent, const AgentTraits& traits) { return std::min(agent.cap_mps, traits.top_mps); }

// Null where it has none.
const Route* RouteOf(const TrafficMap& map, const Agent& agent);
// How a vehicle goes on from a track: as its route says; without a route, or where that cannot be reached any more, by
// a random draw.
const lanes::Link& NextLink(const TrafficMap& map, std::uint64_t seed, std::uint32_t id, const Agent& agent,
                            std::uint32_t track, Choice& choice);

}  // namespace rodeira::traffic
