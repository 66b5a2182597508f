// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/right_of_way_signs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "common/world/sumo/signals.hpp"

namespace rodeira::sumo {
namespace {

constexpr double kSignBefore_m = 1.0;  // the end of the road

using Ways = std::map<std::string, std::vector<const ConnectingLane*>>;  // by junction

const NetRequest* RequestOf(const Net& net, const NetConnection& connection) {
  const auto junction = net.junctions.find(connection.junction);
  if (connection.request < 0 || junction == net.junctions.end()) return nullptr;
  const auto at = static_cast<std::size_t>(connection.request);
  return at < junction->second.requests.size() ? &junction->second.requests[at] : nullptr;
}

// Which connecting road goes before which: those with priority of each lane that meets the other one.
std::set<std::pair<std::string, std::string>> PairsOf(const Net& net, const std::vector<const ConnectingLane*>& ways) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const ConnectingLane* low : ways) {
    const NetRequest* request = RequestOf(net, *low->connection);
    if (request == nullptr) continue;
    for (const ConnectingLane* high : ways) {
      const NetRequest* other = RequestOf(net, *high->connection);
      if (other == nullptr || low->road == high->road || !IsSet(request->response, high->connection->request) ||
          IsSet(other->response, low->connection->request))
        continue;
      pairs.emplace(high->road.attribute("id").value(), low->road.attribute("id").value());
    }
  }
  std::set<std::pair<std::string, std::string>> clear;
  for (const auto& [high, low] : pairs) {
    if (!pairs.contains({low, high})) clear.emplace(high, low);
  }
  return clear;
}

std::size_t WritePairs(const Net& net, const Ways& ways, pugi::xml_node drive) {
  std::size_t count = 0;
  for (pugi::xml_node junction : drive.children("junction")) {
    const auto of = ways.find(junction.attribute("name").value());
    if (of == ways.end()) continue;
    for (const auto& [high, low] : PairsOf(net, of->second)) {
      pugi::xml_node priority = junction.append_child("priority");
      priority.append_attribute("high") = high.c_str();
      priority.append_attribute("low") = low.c_str();
      ++count;
    }
  }
  return count;
}

enum class Says { kNothing, kStop, kGiveWay, kMajor };

// What the signs before a junction say to an edge's traffic: a way that turns round says nothing.
Says SaysTo(const std::vector<const ConnectingLane*>& ways) {
  bool major = false, stop = false, minor = false;
  for (const ConnectingLane* way : ways) {
    if (way->connection->turns_round) continue;
    const char state = way->connection->state;
    major = major || state == 'M';
    stop = stop || state == 's' || state == 'w';
    minor = minor || state == 'm';
    if (state == '=' || state == 'Z') return Says::kNothing;  // the one from the right; in turns
  }
  if (major) return Says::kMajor;
  return stop ? Says::kStop : minor ? Says::kGiveWay : Says::kNothing;
}

bool HasLights(const std::vector<const ConnectingLane*>& ways) {
  return std::any_of(ways.begin(), ways.end(),
                     [](const ConnectingLane* way) { return !way->connection->light.empty(); });
}

void WriteSigns(const Net& net, const RoadEdges& edges, const std::string& id, Says says) {
  const pugi::xml_node road = edges.road_of.at(id);
  const int lanes = static_cast<int>(net.Edge(id)->lanes.size());
  const double right_m = RightEdgeOf(road, -lanes);
  SignalSpec sign;
  sign.id = id + " sign";
  sign.name = says == Says::kStop ? "STOP" : says == Says::kGiveWay ? "give way" : "priority";
  sign.type = says == Says::kStop ? "206" : says == Says::kGiveWay ? "205" : "301";
  sign.s_m = std::max(0.0, LengthOf(road) - kSignBefore_m), sign.t_m = -right_m - kBeside_m;
  sign.from_lane = -lanes, sign.to_lane = -1;
  WriteSignal(road, sign);
  if (says != Says::kMajor) WriteLineAcross(road, id + " line", says == Says::kStop, 0.0, right_m, -lanes, -1);
}

}  // namespace

RightOfWayWritten WriteRightOfWay(const Net& net, const RoadEdges& edges, pugi::xml_node drive) {
  Ways ways, by_edge;
  for (const ConnectingLane& way : edges.ways) {
    ways[way.connection->junction].push_back(&way);
    by_edge[way.connection->from].push_back(&way);
  }
  RightOfWayWritten written;
  written.pairs = WritePairs(net, ways, drive);
  std::map<std::string, std::map<std::string, Says>> said;  // by junction and edge
  for (const auto& [edge, of] : by_edge) {
    if (edges.road_of.contains(edge)) said[of.front()->connection->junction][edge] = SaysTo(of);
  }
  for (const auto& [junction, of] : said) {
    if (HasLights(ways[junction])) continue;
    const bool minor = std::any_of(of.begin(), of.end(), [](const auto& edge) {
      return edge.second == Says::kStop || edge.second == Says::kGiveWay;
    });
    if (!minor) continue;
    for (const auto& [edge, says] : of) {
      if (says == Says::kNothing) continue;
      WriteSigns(net, edges, edge, says);
      ++written.signs;
    }
  }
  return written;
}

}  // namespace rodeira::sumo
