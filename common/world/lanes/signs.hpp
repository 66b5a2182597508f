// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/world/lanes/graph.hpp"
#include "common/world/network/placing.hpp"

namespace rodeira::lanes {

// The signs for vehicles on a track, in the order of growing right.
enum class Sign : std::uint8_t { kStop = 0, kGiveWay = 1, kNone = 2, kPriority = 3 };

// A sign at a track.
struct SignPlace {
  double d_m = 0.0;  // along the track
  Sign sign = Sign::kNone;
};

using network::HoldsFor;

// STOP, give-way and priority signs (206, 205, 301, 306 and 307, which ends a priority road) for the traffic of a
// track, by the Vienna Convention's German numbers, which OpenDRIVE files and this project use; ascending.
std::vector<SignPlace> SignsOf(const Graph& graph, std::uint32_t track);

// The sign that holds at d of a track: the last one before it on the track, or, going back over tracks that are the
// only way here, within 60 m.
Sign SignFor(const Graph& graph, std::uint32_t track, double d_m);

}  // namespace rodeira::lanes
