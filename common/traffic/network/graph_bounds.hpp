// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// The rectangle around the middles of all lanes.
struct GraphBounds {
  double west_m = 1e18, south_m = 1e18, east_m = -1e18, north_m = -1e18;
};

// Without a track west is above east.
inline GraphBounds BoundsOf(const lanes::Graph& graph) {
  GraphBounds bounds;
  for (const lanes::Track& track : graph.tracks()) {
    for (const auto& node : track.curve.nodes()) {
      bounds.west_m = std::min(bounds.west_m, node.p_W.x()), bounds.east_m = std::max(bounds.east_m, node.p_W.x());
      bounds.south_m = std::min(bounds.south_m, node.p_W.y()), bounds.north_m = std::max(bounds.north_m, node.p_W.y());
    }
  }
  return bounds;
}

}  // namespace rodeira::traffic
