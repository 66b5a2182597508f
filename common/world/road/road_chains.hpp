// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// A road as its author wrote it: its parts between junctions and the ways through these, in order.
struct RoadChain {
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

// In the order of their first parts. Roads that nothing continues are chains by themselves; ways that turn are none.
std::vector<RoadChain> ChainsOf(const network::Network& network);

}  // namespace rodeira::road
