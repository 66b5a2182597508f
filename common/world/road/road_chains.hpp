// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// A road as its author wrote it: its parts between junctions and the ways through these, in order.
struct RoadChain {
  // A road of the network within the chain.
  struct Part {
    std::uint32_t road = 0;
    double from_s_m = 0.0;  // where it begins along the chain
  };
  std::string name;
  std::vector<Part> parts;
  double length_m = 0.0;

  // The part at a station, and s on it.
  std::pair<const network::Road*, double> At(const network::Network& network, double s_m) const;
};

// The chain's name in files: that of its parts without what follows '/', 'east' of east/1, east/2 ...
std::string IdOf(const network::Network& network, const RoadChain& chain);

// In the order of their first parts. Roads that nothing continues are chains by themselves; ways that turn are none.
std::vector<RoadChain> ChainsOf(const network::Network& network);

// The road that a name of a scenario or of traffic settings means: a road of the network by its id, alone, with its own
// stations; otherwise a chain by its id, with stations from its beginning. Nothing: there is neither.
std::optional<RoadChain> FindRoadOrChain(const network::Network& network, std::string_view name);
// Names for messages: ids of chains, then ids of roads that are parts of them.
std::vector<std::string> NamesOfRoads(const network::Network& network);

}  // namespace rodeira::road
