// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/geometry/axis_feet.hpp"
#include "common/world/network/lane.hpp"

namespace rodeira::network {

// Points close to one another on the surface of one road, and what Network::Surfaces says of them, number by number.
struct Cluster {
  using Numbers = geometry::AxisFeet::Numbers;
  static constexpr std::size_t kMost = geometry::AxisFeet::kMost;

  geometry::AxisFeet feet;  // the points, t, and of the reference line at s the direction and the curvature
  std::uint32_t road = 0, section = 0;
  int lane = 0;  // of all of them; 0: each has its own
  std::array<int, kMost> lanes;
  Numbers s_m;
  Numbers z_m, z_by_s, z_by_t;  // of the surface
  bool leans = false;  // superelevated at all of them; then how a point moves with s and with t, seen from above
  Numbers ds_x, ds_y, dt_x, dt_y;
  double low_s_m, high_s_m, low_t_m, high_t_m;  // the smallest and the largest

  // The id of the lane at a point, an index below the number of points.
  int LaneOf(std::size_t point) const { return lane != 0 ? lane : lanes[point]; }
};

}  // namespace rodeira::network
