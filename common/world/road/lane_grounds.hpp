// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/surface_point.hpp"

namespace rodeira::road {

// What a lane is made of from a station on.
struct LaneGround {
  double s_m = 0.0;
  ground::Surface surface = ground::Surface::kAsphalt;
  double friction = 0.0;
};

// What every lane of a network is made of, ready to be asked: its materials in force, where they are called as one of
// our surfaces, otherwise its type's surface; a material's own friction, otherwise the surface's.
class LaneGrounds {
 public:
  LaneGrounds() = default;
  LaneGrounds(const network::Network& network, const FrictionTable& friction);

  // The lane must be one of the network's.
  const LaneGround& At(const network::Network& network, const network::LaneKey& lane, double s_m) const {
    const std::size_t number = network.Number(lane);
    std::size_t found = first_[number];
    for (std::size_t i = found + 1; i < first_[number + 1]; ++i) {
      if (grounds_[i].s_m <= s_m) found = i;
    }
    return grounds_[found];
  }

 private:
  std::vector<std::size_t> first_;  // by the lane's number; one more at the end
  std::vector<LaneGround> grounds_;
};

}  // namespace rodeira::road
