// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "common/world/sumo/read_net.hpp"
#include "common/world/sumo/road_edges.hpp"

namespace rodeira::sumo {

// How much was written.
struct RightOfWayWritten {
  std::size_t pairs = 0;  // ways over junctions of which one goes first
  std::size_t signs = 0;
};

// Writes the priorities: for two ways over a junction of which SUMO makes one yield, a <priority> of the junction; at
// junctions without lights the signs that say so (206, 205, 301) and the lines before them.
RightOfWayWritten WriteRightOfWay(const Net& net, const RoadEdges& edges, pugi::xml_node drive);

}  // namespace rodeira::sumo
