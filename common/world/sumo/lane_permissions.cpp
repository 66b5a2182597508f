// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/lane_permissions.hpp"

#include <string>

namespace rodeira::sumo {
namespace {

void Deny(pugi::xml_node lane) {
  pugi::xml_node access = lane.append_child("access");
  access.append_attribute("sOffset") = "0";
  access.append_attribute("rule") = "deny";
  access.append_attribute("restriction") = "passengerCar";
}

bool ForCars(const NetEdge* edge, int lane) {
  const auto at = static_cast<std::size_t>(lane);
  return edge == nullptr || lane < 0 || at >= edge->lanes.size() || edge->lanes[at].for_cars;
}

// The lane inside a junction, ":c_2_1", as its edge and its number.
bool ForCars(const Net& net, const std::string& lane) {
  const std::size_t at = lane.rfind('_');
  if (at == std::string::npos) return true;
  return ForCars(net.Edge(lane.substr(0, at)), std::atoi(lane.c_str() + at + 1));
}

}  // namespace

std::size_t WritePermissions(const Net& net, const RoadEdges& edges) {
  std::size_t denied = 0;
  for (const auto& [id, road] : edges.road_of) {
    const NetEdge* edge = net.Edge(id);
    for (std::size_t i = 0; edge != nullptr && i < edge->lanes.size(); ++i) {
      const pugi::xml_node lane = edges.Lane(id, static_cast<int>(i));
      if (!lane || edge->lanes[i].for_cars) continue;
      Deny(lane);
      ++denied;
    }
  }
  for (const ConnectingLane& way : edges.ways) {
    const NetConnection& connection = *way.connection;
    if (!ForCars(net, connection.via) || !ForCars(net.Edge(connection.from), connection.from_lane) ||
        !ForCars(net.Edge(connection.to), connection.to_lane))
      Deny(way.lane);
  }
  return denied;
}

void WriteNames(const Net& net, const RoadEdges& edges) {
  for (const auto& [id, found] : edges.road_of) {
    pugi::xml_node road = found;
    const NetEdge* edge = net.Edge(id);
    std::string street = road.attribute("name").value();
    if (street.empty() && edge != nullptr) street = edge->street;
    road.attribute("name") = id.c_str();
    if (street.empty() || street == id) continue;
    pugi::xml_node data = road.append_child("userData");
    data.append_attribute("code") = "sumo:street";
    data.append_attribute("value") = street.c_str();
  }
}

}  // namespace rodeira::sumo
