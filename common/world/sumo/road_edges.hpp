// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/world/sumo/read_net.hpp"

// Which road of netconvert's OpenDRIVE is which edge of the network.
namespace rodeira::sumo {

// A connection's lane on its connecting road.
struct ConnectingLane {
  const NetConnection* connection = nullptr;
  pugi::xml_node road, lane;
  int lane_id = 0;
};

// XML nodes are those of the document given to FindEdges, which outlives them.
struct RoadEdges {
  std::map<std::string, pugi::xml_node> road_of;  // by edge
  std::vector<ConnectingLane> ways;               // in the order of the connections

  // The lane of an edge's road; empty where it is none. Lanes are numbered as SUMO does, from right to left.
  pugi::xml_node Lane(const std::string& edge, int index) const;
};

// Roads outside of junctions are edges in the order of their ids; connecting roads are named after the edge inside the
// junction, and tell which roads their edges are.
RoadEdges FindEdges(const Net& net, const pugi::xml_node& drive);

// The number of a lane in OpenDRIVE, where a road has so many on its right side.
inline int LaneId(int index, std::size_t lanes) { return index - static_cast<int>(lanes); }

// The lanes of the right side of a road's only section, from right to left.
std::vector<pugi::xml_node> RightLanes(const pugi::xml_node& road);

}  // namespace rodeira::sumo
