// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/read_net.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <pugixml.hpp>
#include <string_view>
#include <tuple>

namespace rodeira::sumo {
namespace {

// Whether a list of vehicle classes, divided by blanks, names a class.
bool Names(std::string_view list, std::string_view vehicle_class) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    const std::string_view word = list.substr(0, end);
    if (word == vehicle_class || word == "all") return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

NetLane ReadLane(const pugi::xml_node& lane) {
  const std::string_view allow = lane.attribute("allow").value(), disallow = lane.attribute("disallow").value();
  return {allow.empty() ? !Names(disallow, "passenger") : Names(allow, "passenger")};
}

// The direction of the last two different points of a shape "x,y[,z] x,y[,z] …".
double EndHeading(std::string_view shape) {
  std::vector<Eigen::Vector2d> points;
  while (!shape.empty()) {
    const std::size_t end = std::min(shape.find(' '), shape.size());
    const std::string word(shape.substr(0, end));
    Eigen::Vector2d point;
    if (std::sscanf(word.c_str(), "%lf,%lf", &point.x(), &point.y()) == 2 &&
        (points.empty() || (points.back() - point).norm() > 1e-3))
      points.push_back(point);
    shape.remove_prefix(std::min(end + 1, shape.size()));
  }
  if (points.size() < 2) return 0.0;
  const Eigen::Vector2d along = points.back() - points[points.size() - 2];
  return std::atan2(along.y(), along.x());
}

NetEdge ReadEdge(const pugi::xml_node& node) {
  NetEdge edge{node.attribute("id").value(),
               node.attribute("from").value(),
               node.attribute("to").value(),
               node.attribute("name").value(),
               std::string_view(node.attribute("function").value()) == "internal",
               {},
               0.0};
  for (const pugi::xml_node& lane : node.children("lane")) {
    edge.lanes.push_back(ReadLane(lane));
    edge.end_heading_rad = EndHeading(lane.attribute("shape").value());
  }
  return edge;
}

NetConnection ReadConnection(const pugi::xml_node& node) {
  const std::string_view state = node.attribute("state").value(), turn = node.attribute("dir").value();
  return {node.attribute("from").value(),
          node.attribute("to").value(),
          node.attribute("fromLane").as_int(),
          node.attribute("toLane").as_int(),
          node.attribute("via").value(),
          node.attribute("tl").value(),
          node.attribute("linkIndex").as_int(-1),
          state.empty() ? 'M' : state.front(),
          turn == "t" || turn == "T",
          {},
          -1};
}

LightProgram ReadProgram(const pugi::xml_node& node) {
  LightProgram program{node.attribute("id").value(),
                       node.attribute("type").as_string("static"),
                       node.attribute("offset").as_double(),
                       {}};
  for (const pugi::xml_node& phase : node.children("phase"))
    program.phases.push_back({phase.attribute("duration").as_double(), phase.attribute("state").value()});
  return program;
}

// The lanes inside a junction in the order of its requests.
std::vector<std::string> InternalLanes(std::string_view list) {
  std::vector<std::string> lanes;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (end > 0) lanes.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return lanes;
}

}  // namespace

const NetEdge* Net::Edge(const std::string& id) const {
  const auto found = index_.find(id);
  return found == index_.end() ? nullptr : &edges[found->second];
}

bool IsSet(const std::string& letters, int to) {
  const auto at = static_cast<std::size_t>(to);
  return to >= 0 && at < letters.size() && letters[letters.size() - 1 - at] == '1';
}

base::Result<Net> ReadNet(const std::filesystem::path& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(file.c_str());
  if (!parsed)
    return base::WrongInput("sumo.not_a_network", fmt::format("this is not XML: {}", parsed.description()),
                            file.string());
  const pugi::xml_node root = document.child("net");
  if (!root) return base::WrongInput("sumo.not_a_network", "the outermost element is not <net>", file.string());
  Net net;
  std::map<std::string, std::string> goes_on;                   // inside a junction: a lane, and the lane that follows
  std::map<std::string, std::pair<std::string, int>> requests;  // a lane inside, its junction and request
  for (const pugi::xml_node& node : root.children("edge")) {
    NetEdge edge = ReadEdge(node);
    net.index_.emplace(edge.id, net.edges.size());
    net.edges.push_back(std::move(edge));
  }
  for (const pugi::xml_node& node : root.children("junction")) {
    NetJunction junction{node.attribute("id").value(), node.attribute("type").value(), {}};
    if (junction.type == "internal") continue;  // a place to wait in the middle of a junction
    for (const pugi::xml_node& request : node.children("request"))
      junction.requests.push_back({request.attribute("response").value(), request.attribute("foes").value()});
    int number = 0;
    for (const std::string& lane : InternalLanes(node.attribute("intLanes").value()))
      requests[lane] = {junction.id, number++};
    net.junctions.emplace(junction.id, std::move(junction));
  }
  for (const pugi::xml_node& node : root.children("connection")) {
    NetConnection connection = ReadConnection(node);
    if (!connection.from.starts_with(':')) {
      net.connections.push_back(std::move(connection));
    } else if (!connection.via.empty()) {
      goes_on[fmt::format("{}_{}", connection.from, connection.from_lane)] = connection.via;
    }
  }
  // A way that waits in the middle of a junction is two lanes; the requests name the last one.
  for (NetConnection& connection : net.connections) {
    std::string last = connection.via;
    constexpr int kMaxParts = 8;
    for (int part = 1; part < kMaxParts && goes_on.contains(last); ++part) last = goes_on[last];
    if (const auto found = requests.find(last); found != requests.end())
      std::tie(connection.junction, connection.request) = found->second;
  }
  for (const pugi::xml_node& node : root.children("tlLogic")) {
    LightProgram program = ReadProgram(node);
    net.programs[program.id] = std::move(program);
  }
  return net;
}

}  // namespace rodeira::sumo
