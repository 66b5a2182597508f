// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/world/network/network.hpp"
#include "common/world/terrain/picture_file.hpp"

namespace rodeira::scene {

// A lane, and about where along it something lies.
struct AlongLane {
  network::LaneKey lane;
  double s_m = 0.0;

  bool operator==(const AlongLane&) const = default;
};

// s and t of a point of a lane, of its edges too, on the lane's own road; where that passes there more than once,
// nearest to place.s_m.
Eigen::Vector2d OnRoad(const network::Network& network, const AlongLane& place, const Eigen::Vector2d& p_W);

// Where a point of the lane lies on a picture that repeats along it: (0, 0) its lower left corner, (1, 1) its upper
// right one. Its upper edge is ahead as the lane is driven (both ways: along s), and it is counted across from the
// lane's inner edge; along from the lane section's beginning, so that s stays exact on a long road.
Eigen::Vector2d OnPicture(const network::Network& network, const AlongLane& place, const terrain::LaidPicture& picture,
                          const Eigen::Vector2d& p_W);

}  // namespace rodeira::scene
