// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "common/world/network/network.hpp"

namespace rodeira::road {

// A sentence about a road, and the road's index.
struct OfRoad {
  std::uint32_t road = 0;
  std::string text;
};

// Names of places on a network's roads, for messages. In a world file's network (`own`) parts of a road between
// junctions are named by their road, with its stations; otherwise a road is named by its id.
class StationNames {
 public:
  // The network outlives it.
  StationNames(const network::Network& network, bool own);

  // "road 'a' at s = 12.0 m"
  std::string At(std::uint32_t road, double s_m) const;
  std::string Road(std::uint32_t road) const;              // "road 'a'"
  double StationOf(std::uint32_t road, double s_m) const;  // along the named road

 private:
  const network::Network& network_;
  std::map<std::uint32_t, std::pair<std::string, double>> of_;  // the name, and where the part begins
};

}  // namespace rodeira::road
