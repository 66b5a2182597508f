// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "common/world/sumo/read_net.hpp"
#include "common/world/sumo/road_edges.hpp"

namespace rodeira::sumo {

// Writes an <access> that denies cars to every lane that SUMO's class "passenger" may not use. Returns how many lanes
// of edges these are; lanes over junctions are not counted.
std::size_t WritePermissions(const Net& net, const RoadEdges& edges);

// Names roads after their edges; the name of the street goes into userData "sumo:street".
void WriteNames(const Net& net, const RoadEdges& edges);

}  // namespace rodeira::sumo
