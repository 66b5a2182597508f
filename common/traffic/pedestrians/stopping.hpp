// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

// Stops before crossings for people on foot.
namespace rodeira::traffic {

// Share of the comfortable braking for people on foot: followers brake harder.
inline constexpr double kYieldingShare = 0.75;
inline constexpr double kCrosswalkStopDistance_m = 1.0;  // from a stopped front to the crossing
inline constexpr double kBrakeReaction_s = 0.5;          // until the brakes act

// So far ahead a vehicle looks for crossings.
double StoppingWay(const Agent& agent, const AgentTraits& traits);
// Whether a crossing lies between two distances along a track.
bool NearCrossing(const std::optional<Pedestrians>& people, std::uint32_t track, double low_m, double high_m);

}  // namespace rodeira::traffic
