// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/station_names.hpp"

namespace rodeira::road {

// Two roads that lie on one another, on one level, where no junction and no link says that one can be driven on from
// the other.
struct Overlap {
  std::uint32_t road = 0, other = 0;  // road < other
  double s_m = 0.0, other_s_m = 0.0;
  bool meet = true;      // nowhere but at an end of each: they only touch
  double apart_m = 0.0;  // how much higher the second one is there
};

// One for each pair of roads that have any, at the smallest s of the first: lanes that are driven on are looked at
// every metre, in their middle and 0.1 m within the outermost edges, and against lanes that are driven on, less than
// Network::kLevel_m above or below. Roads of one junction do not count, nor the roads that lead into it within 60 m of
// its mouth, nor roads that go on into one another within 60 m of where they do.
std::vector<Overlap> FindOverlaps(const network::Network& network);

// A sentence for each. Parts of a road between junctions are named by their road, with its stations, where `own` says
// that the network is a world file's.
std::vector<OfRoad> DescribeOverlaps(const network::Network& network, bool own);

}  // namespace rodeira::road
