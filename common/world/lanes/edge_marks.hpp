// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/world/lanes/graph.hpp"

namespace rodeira::lanes {

enum class Side : std::uint8_t { kLeft = 0, kRight = 1 };  // as the lane's traffic sees it

// Where traffic may cross the edges of its lane, by what is painted there: of several lines the one on its own side
// counts, broken or dotted ones may be crossed, continuous ones may not; no paint forbids nothing. Where the lane
// beside is another road's and none is painted on the own road, that one's counts. Where OpenDRIVE's `laneChange`
// forbids something, that counts. Looked at every two metres.
class EdgeMarks {
 public:
  explicit EdgeMarks(const Graph& graph);

  // Whether all of the edge between two distances may be crossed. Only where another drivable lane lies beyond it.
  bool MayCross(std::uint32_t track, Side side, double from_d_m, double to_d_m) const;

 private:
  std::vector<std::array<std::vector<bool>, 2>> open_;  // by track and side; empty: no drivable lane there
};

}  // namespace rodeira::lanes
