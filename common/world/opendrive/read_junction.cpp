// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "common/world/opendrive/measures.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

// Heights between blanks.
std::vector<double> ReadHeights(const Node& node, const char* attribute) {
  const std::string text = node.Text(attribute, "");
  std::vector<double> numbers;
  for (const char *at = text.data(), *end = at + text.size(); at != end;) {
    if (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r') {
      ++at;
      continue;
    }
    double number = 0.0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number)) {
      node.Wrong("xml.attribute",
                 fmt::format("attribute '{}' of <{}> is '{}'; numbers were expected", attribute, node.name(), text));
      return {};
    }
    if (std::fabs(number) > kHighest_m) {
      node.Wrong("junctions.elevation_grid.height",
                 fmt::format("attribute '{}' of <{}> has a height of {:.6g} m; at most {:.6g} m was expected",
                             attribute, node.name(), number, kHighest_m));
      return {};
    }
    numbers.push_back(number);
    at = next;
  }
  return numbers;
}

// A number, or the beginning or the end of the road.
double ReadStation(const Node& node, const char* attribute) {
  const std::string text = node.Text(attribute, "");
  if (text == "begin" || text == "start") return 0.0;
  if (text == "end") return std::numeric_limits<double>::infinity();
  return node.Number(attribute);
}

BoundarySegment ReadSegment(const Node& node) {
  BoundarySegment segment;
  segment.line = node.line();
  segment.road = node.Text("roadId");
  const std::string type = node.Text("type");
  segment.joint = type == "joint";
  if (type == "lane") {
    segment.lane = node.Integer("boundaryLane");
    segment.from_s_m = ReadStation(node, "sStart");
    segment.to_s_m = ReadStation(node, "sEnd");
  } else if (segment.joint) {
    segment.end = ReadContact(node, "contactPoint");
    if (node.Has("jointLaneStart")) segment.first_lane = node.Integer("jointLaneStart");
    if (node.Has("jointLaneEnd")) segment.last_lane = node.Integer("jointLaneEnd");
    segment.transition_m = std::max(0.0, node.Number("transitionLength", 0.0));
  } else {
    node.Wrong("junctions.boundary.segment_type", fmt::format("type is '{}'; lane or joint was expected", type));
  }
  return segment;
}

// The reference line and the heights beside it.
void ReadGrid(const Node& junction, JunctionReading& reading) {
  const std::vector<Node> grids = junction.Children("elevationGrid");
  if (grids.empty()) return;
  const Node& grid = grids.front();
  if (grids.size() > 1)
    grids[1].Wrong("junctions.elevation_grid.only_one_elev_grid", "the junction has a second <elevationGrid>");
  reading.has_grid = true;
  reading.grid_start_m = grid.Number("sStart", 0.0);
  reading.grid_spacing_m = grid.Number("gridSpacing");
  for (const Node& node : grid.Children("elevation")) {
    const std::vector<double> centre = ReadHeights(node, "center");
    if (centre.size() != 1)
      node.Wrong("xml.attribute",
                 fmt::format("attribute 'center' of <elevation> holds {} numbers; one was expected", centre.size()));
    reading.grid_rows.push_back(
        {centre.empty() ? 0.0 : centre[0], ReadHeights(node, "left"), ReadHeights(node, "right")});
  }
  if (!junction.Child("planView")) {
    grid.Wrong("junctions.elevation_grid.perpendicular_vectors",
               "the junction has heights across a reference line, but no <planView> that would be it");
    return;
  }
}

// Objects beside the junction's own line (an example of the standard has no <objects> about them), and paths on foot.
void ReadObjects(const Node& junction, JunctionReading& reading) {
  for (const Node& parent : {junction.Child("objects"), junction}) {
    for (const Node& node : parent.Children("object")) reading.objects.push_back({ReadObject(node), node.line()});
  }
  for (const Node& node : junction.Children("crossPath"))
    reading.cross_paths.push_back({node.Text("id", ""), node.Text("crossingRoad"), node.line()});
}

}  // namespace

JunctionReading ReadJunction(const Node& junction) {
  JunctionReading reading;
  network::Junction& read = reading.junction;
  reading.line = junction.line();
  read.id = junction.Text("id");
  read.name = junction.Text("name", "");
  read.type = junction.Text("type", "default");
  for (const Node& node : junction.Children("connection")) {
    network::JunctionConnection connection;
    connection.id = node.Text("id", "");
    connection.incoming_road = node.Text("incomingRoad", "");
    connection.connecting_road = node.Text(node.Has("linkedRoad") ? "linkedRoad" : "connectingRoad", "");
    connection.contact = ReadContact(node, "contactPoint");
    for (const Node& link : node.Children("laneLink"))
      connection.lane_links.push_back({link.Integer("from"), link.Integer("to")});
    read.connections.push_back(std::move(connection));
  }
  for (const Node& node : junction.Children("priority"))
    read.priorities.push_back({node.Text("high", ""), node.Text("low", "")});
  std::vector<std::pair<double, std::string>> controllers;
  for (const Node& node : junction.Children("controller"))
    controllers.emplace_back(node.Number("sequence", 0.0), node.Text("id", ""));
  std::stable_sort(controllers.begin(), controllers.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [sequence, id] : controllers) read.controllers.push_back(std::move(id));
  for (const Node& segment : junction.Child("boundary").Children("segment"))
    reading.boundary.push_back(ReadSegment(segment));
  read.main_road = junction.Text("mainRoad", "");
  RoadLines lines;
  if (junction.Child("planView")) reading.elements = ReadPlanView(junction, lines);
  ReadGrid(junction, reading);
  ReadObjects(junction, reading);
  return reading;
}

}  // namespace rodeira::opendrive
