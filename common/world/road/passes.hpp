// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/bare_terrain.hpp"
#include "common/world/road/station_names.hpp"

namespace rodeira::road {

// Two roads of a world file, or two stretches of one, of which one passes over the other, more than Network::kLevel_m
// higher, where neither a bridge carries the upper one nor a tunnel leads the lower one under the ground: the ground
// rises from one to the other.
struct Pass {
  std::uint32_t over = 0, under = 0;
  double over_s_m = 0.0, under_s_m = 0.0;
  double apart_m = 0.0;
};

// One for each pair of roads that have any, where a walk along the upper one meets it first.
std::vector<Pass> FindPasses(const network::Network& network);

// A tunnel with lanes over which the terrain, as it is without roads, lies by no more than the step that a car is taken
// to climb (ground::kMaxAboveHint_m): it would drive on the terrain. Where the terrain lies under the road the road
// itself answers.
struct OpenTunnel {
  std::uint32_t road = 0;
  double from_s_m = 0.0, to_s_m = 0.0;  // of the tunnel
  double s_m = 0.0, hill_m = 0.0;       // where the terrain is the least over the road, and by how much it is, above 0
};
std::vector<OpenTunnel> FindOpenTunnels(const network::Network& network, const BareTerrain& terrain);

// A warning for each kind, for `world check`.
std::vector<OfRoad> DescribePasses(const network::Network& network, const BareTerrain& terrain);

}  // namespace rodeira::road
