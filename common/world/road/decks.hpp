// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/road_edge.hpp"

namespace rodeira::road {

// The ground between roads rises and falls by 1 in 2, and where they stand closer by as much as it must.
inline constexpr double kBank = 0.5;

// Where the roads of an OpenDRIVE file are carried over others: by road, ascending, the stretches over another road
// that lies more than Network::kLevel_m lower, and on either side as much again as a bank takes to come down from them.
// Elsewhere a road stands on the ground, whatever the file calls a bridge or a tunnel: nothing is known of what those
// lead over or under.
std::vector<std::vector<Stretch>> FindDecks(const network::Network& network);

// What of a road stands on the ground, in order.
std::vector<Stretch> StandingOn(const network::Road& road, const std::vector<Stretch>& decks);

}  // namespace rodeira::road
