// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/road_edges.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

namespace rodeira::sumo {
namespace {

bool IsConnecting(const pugi::xml_node& road) { return std::string_view(road.attribute("junction").value()) != "-1"; }

std::string LinkedRoad(const pugi::xml_node& road, const char* end) {
  return road.child("link").child(end).attribute("elementId").value();
}

// The edge of a lane inside a junction: ":c_2_1" is a lane of ":c_2".
std::string EdgeOfLane(const std::string& lane) { return lane.substr(0, lane.rfind('_')); }

int LinkedLane(const pugi::xml_node& lane, const char* end) {
  return lane.child("link").child(end).attribute("id").as_int();
}

// What a lane over a junction connects: the edges, and its lanes in OpenDRIVE's numbers.
using ConnectionKey = std::tuple<std::string, std::string, int, int>;

}  // namespace

std::vector<pugi::xml_node> RightLanes(const pugi::xml_node& road) {
  std::vector<pugi::xml_node> lanes;
  for (const pugi::xml_node& lane : road.child("lanes").child("laneSection").child("right").children("lane"))
    lanes.push_back(lane);
  std::reverse(lanes.begin(), lanes.end());
  return lanes;
}

pugi::xml_node RoadEdges::Lane(const std::string& edge, int index) const {
  const auto road = road_of.find(edge);
  if (road == road_of.end() || index < 0) return {};
  const std::vector<pugi::xml_node> lanes = RightLanes(road->second);
  return static_cast<std::size_t>(index) < lanes.size() ? lanes[static_cast<std::size_t>(index)] : pugi::xml_node();
}

RoadEdges FindEdges(const Net& net, const pugi::xml_node& drive) {
  RoadEdges found;
  std::map<std::string, pugi::xml_node> roads;  // outside of junctions, by id
  std::vector<pugi::xml_node> connecting, in_order;
  for (const pugi::xml_node& road : drive.children("road")) {
    if (IsConnecting(road)) {
      connecting.push_back(road);
    } else {
      roads.emplace(road.attribute("id").value(), road);
      in_order.push_back(road);
    }
  }
  std::map<std::string, std::pair<std::string, std::string>> through;  // an edge inside a junction, from where to where
  for (const NetConnection& connection : net.connections)
    through[EdgeOfLane(connection.via)] = {connection.from, connection.to};
  for (const pugi::xml_node& road : connecting) {
    const auto edges = through.find(road.attribute("name").value());
    if (edges == through.end()) continue;
    if (const auto from = roads.find(LinkedRoad(road, "predecessor")); from != roads.end())
      found.road_of.emplace(edges->second.first, from->second);
    if (const auto to = roads.find(LinkedRoad(road, "successor")); to != roads.end())
      found.road_of.emplace(edges->second.second, to->second);
  }
  // Edges that no way over a junction leads to or from.
  std::vector<const NetEdge*> edges;
  for (const NetEdge& edge : net.edges) {
    if (!edge.internal && !edge.id.starts_with(':')) edges.push_back(&edge);
  }
  std::sort(edges.begin(), edges.end(), [](const NetEdge* a, const NetEdge* b) { return a->id < b->id; });
  if (edges.size() == in_order.size()) {
    for (std::size_t i = 0; i < edges.size(); ++i) found.road_of.emplace(edges[i]->id, in_order[i]);
  }

  std::map<std::string, std::string> edge_of;  // by a road's id
  for (const auto& [edge, road] : found.road_of) edge_of.emplace(road.attribute("id").value(), edge);
  std::map<ConnectionKey, ConnectingLane> lanes;
  for (const pugi::xml_node& road : connecting) {
    const std::string from = edge_of[LinkedRoad(road, "predecessor")], to = edge_of[LinkedRoad(road, "successor")];
    for (const pugi::xml_node& lane : RightLanes(road)) {
      lanes.emplace(ConnectionKey(from, to, LinkedLane(lane, "predecessor"), LinkedLane(lane, "successor")),
                    ConnectingLane{nullptr, road, lane, lane.attribute("id").as_int()});
    }
  }
  for (const NetConnection& connection : net.connections) {
    const NetEdge *from = net.Edge(connection.from), *to = net.Edge(connection.to);
    if (from == nullptr || to == nullptr) continue;
    const auto way =
        lanes.find(ConnectionKey(connection.from, connection.to, LaneId(connection.from_lane, from->lanes.size()),
                                 LaneId(connection.to_lane, to->lanes.size())));
    if (way == lanes.end()) continue;
    found.ways.push_back(way->second);
    found.ways.back().connection = &connection;
  }
  return found;
}

}  // namespace rodeira::sumo
