// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/world/lanes/graph.hpp"

namespace rodeira::lanes {

// By track: the one beside it with traffic that comes towards it, on a road of one lane a direction; below 0: none. It
// lies to the left, in left-hand traffic to the right. Junctions have none.
std::vector<std::int64_t> Opposites(const Graph& graph);

// Where a sign forbids to overtake: from one of 276 on to one of 280 or 282, or the next junction.
class NoOvertaking {
 public:
  explicit NoOvertaking(const Graph& graph);

  // Whether nothing between two distances of a track is forbidden.
  bool Allows(std::uint32_t track, double from_d_m, double to_d_m) const;

 private:
  struct Change {
    double d_m = 0.0;
    bool forbids = false;
  };
  std::vector<bool> begins_;                  // by track: what holds at its beginning
  std::vector<std::vector<Change>> changes_;  // by track, ascending
};

}  // namespace rodeira::lanes
