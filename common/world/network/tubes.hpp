// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "common/world/network/network.hpp"

// What stands around a road in a tunnel: walls along the edges of its outermost lanes, and a ceiling.
namespace rodeira::network {

inline constexpr double kTubeWall_m = 0.4;  // thickness of a wall
inline constexpr double kTubeInside_m =
    0.06;  // so far its face stands within the road's edge: the hill's own step, where it is drawn, lies behind it
inline constexpr double kTubeOutside_m = kTubeWall_m - kTubeInside_m;
inline constexpr double kTubeClear_m =
    4.55;  // over the road at the ends of pieces: 4.5 m between them and under lamps, too
inline constexpr double kTubeCeiling_m = 0.15;  // thickness of the ceiling
inline constexpr double kPortalWing_m = 1.0;    // so far a portal stands beside the road's edges
inline constexpr double kPortalDeep_m = 0.5;    // and out of the tunnel, along the road

// A piece of a tube, straight from its beginning [0] to its end [1]. Neighbours meet in the same points.
struct TubePiece {
  std::uint32_t road = 0;
  const Structure* structure = nullptr;  // lives as long as the network
  std::array<double, 2> s_m{};
  std::array<Eigen::Vector3d, 2> right_W = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()},
                                 left_W = right_W;  // the road's edges, on its surface
  std::array<double, 2> ceiling_m{};                // its lower side, over the straight line from edge to edge
  bool right_wall = true, left_wall = true;         // none stands where another road lies beside
  std::array<bool, 2> portal = {false, false};      // the tunnel begins, or ends, there

  // From the right edge to the left one at its beginning (0) or end (1), seen from above; unit length.
  Eigen::Vector2d LeftAt(std::size_t end) const { return (left_W[end] - right_W[end]).head<2>().normalized(); }
};

// Of all tunnels, by road and station. Pieces are at most 8 m long and stay within 2 cm of the road's edges. A tunnel
// that goes on in another road's, or ends at a junction, has no portal there.
std::vector<TubePiece> PlaceTubes(const Network& network);

}  // namespace rodeira::network
