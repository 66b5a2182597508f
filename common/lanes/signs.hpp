#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/lanes/graph.hpp"

namespace rodeira::lanes {

// What is said to who drives on a track, in the order of growing right.
enum class Sign : std::uint8_t { kStop = 0, kGiveWay = 1, kNone = 2, kPriority = 3 };

struct SignPlace {
  double d_m = 0.0;  // along the track
  Sign sign = Sign::kNone;
};

// Whether something beside the road is for the traffic of a lane of it, by its orientation ("+", "-", "none") and lanes.
// along: the lane's traffic goes with growing s.
bool HoldsFor(int lane, bool along, std::string_view orientation, const std::vector<network::LaneValidity>& validity);

// STOP, give-way and priority signs (206, 205, 301, 306 and 307, which ends a priority road) for the traffic of a track, by
// the Vienna Convention's German numbers, which OpenDRIVE files and this project use; ascending.
std::vector<SignPlace> SignsOf(const Graph& graph, std::uint32_t track);

// The sign that holds at d of a track: the last one before it on the track, or, going back over tracks that are the only
// way here, within 60 m.
Sign SignFor(const Graph& graph, std::uint32_t track, double d_m);

}  // namespace rodeira::lanes
