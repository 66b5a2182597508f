// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/world/network/junction_grid.hpp"
#include "common/world/network/network.hpp"
#include "common/world/opendrive/source.hpp"

// How the elements of an OpenDRIVE file become the parts of a network. Each says what is wrong to the node's source.
namespace rodeira::opendrive {

struct Findings;

// Where something stands in the file, for checks that come later.
struct RoadLines {
  std::size_t road = 0;
  std::vector<std::size_t> elements;  // by plan view element
  std::vector<std::size_t> sections;  // by lane section
  pugi::xml_node node;                // the road's element, and those of the same parts
  std::vector<pugi::xml_node> element_nodes, section_nodes;
};

// A road as read, before its axis is built: its plan view is in `elements`.
struct RoadReading {
  network::RoadSpec spec;
  std::vector<geometry::PlanElement> elements;
  RoadLines lines;
};

// A piece of a junction's boundary: along a lane's outer edge (lane 0: along the middle), or across a road's end.
struct BoundarySegment {
  bool joint = false;
  std::string road;
  std::size_t line = 0;
  // Along: the lane, and where; infinite: to the road's end.
  int lane = 0;
  double from_s_m = 0.0, to_s_m = 0.0;
  // Across: at which end, the lanes that it reaches between, each to its outer edge (nothing: all), and how far inward
  // heights go over.
  network::End end = network::End::kStart;
  std::optional<int> first_lane, last_lane;
  double transition_m = 0.0;
};

// An object beside a junction's own line: its s and t, and those of its corners, are the line's.
struct JunctionObject {
  network::Object object;
  std::size_t line = 0;
};

// A road that people on foot cross others by.
struct CrossPath {
  std::string id, road;
  std::size_t line = 0;
};

// A junction as read, with what becomes its ground and its roads' objects later.
struct JunctionReading {
  network::Junction junction;
  std::size_t line = 0;
  std::vector<BoundarySegment> boundary;
  std::vector<JunctionObject> objects;
  std::vector<CrossPath> cross_paths;
  bool has_grid = false;
  std::vector<geometry::PlanElement> elements;  // of its reference line
  double grid_start_m = 0.0, grid_spacing_m = 0.0;
  std::vector<network::JunctionGridRow> grid_rows;
};

// Each reads one element of the file, with its children. What is wrong becomes a finding of the node's source, with its
// line, and reading goes on. Units are those of the file: metres, radians. ReadContact gives kStart where the attribute
// is missing or another word than "start" or "end".
network::End ReadContact(const Node& node, const char* attribute);
RoadReading ReadRoad(const Node& road);
// Adds each element's line to `lines`.
std::vector<geometry::PlanElement> ReadPlanView(const Node& road, RoadLines& lines);
void ReadProfiles(const Node& road, network::RoadSpec& spec);
void ReadLateral(const Node& road, network::LateralProfile& lateral);
void ReadLanes(const Node& road, network::RoadSpec& spec, RoadLines& lines);
// section_s_m: the station that the mark's sOffset is counted from.
network::RoadMark ReadMark(const Node& mark, double section_s_m);
void ReadSignals(const Node& road, network::RoadSpec& spec);
network::Object ReadObject(const Node& node);
void ReadObjects(const Node& road, network::RoadSpec& spec);
void ReadSurface(const Node& road, network::RoadSpec& spec);
JunctionReading ReadJunction(const Node& junction);
network::Controller ReadController(const Node& controller);
// Lights of controllers with an orientation that fits none of the lanes that their validity names, as in the towns of
// CARLA and RoadRunner, hold for these lanes: their orientation is turned, with one warning.
void TurnLights(const std::vector<network::Controller>& controllers, std::vector<RoadReading>& readings,
                Findings& findings);
// Lights with an upper end less than 1 m over the road, as in two towns of CARLA, are put at 2.2 m, with one warning.
void RaiseLights(std::vector<RoadReading>& readings, Findings& findings);
// Controllers that a junction names and that say no times take turns, in the order of the junctions: 20 s of green, 3 s
// of amber, 2 s of red for all. Junctions that share a controller, or that a short road joins, take turns together.
// Dark stay: lights for people on foot alone; with a warning, a controller with lights for ways from different sides,
// and one that crosses a controller with times in the file.
void TakeTurns(network::NetworkSpec& spec, Findings& findings);
// Files that are included and could not be read: an error for each.
void TellIncludes(const Node& root);
// A warning for each kind of element or attribute that says something about the world and is passed over; at the first
// of them.
void TellUnread(const Node& root);
// A warning for each element, attribute and word that OpenDRIVE does not know, with the nearest that it does; an error
// for an element that stands twice where it may stand once.
void TellUnknown(const Node& root);
// Records and things that begin beside their road or lane section, first widths that leave a lane without any, repeats
// below 0, ids that stand twice: an error below 0, where a number can have no meaning; otherwise a warning for each
// kind, at the first.
void CheckStations(const Node& root);
// Measures beyond those of measures.hpp, wherever a record of them is in force: an error for each.
void CheckMeasures(const Node& root);
// In m/s from the attributes 'max' or 'speed' and 'unit'; infinite: no limit; nothing: not said.
std::optional<double> ReadSpeed(const Node& speed, const char* attribute);

}  // namespace rodeira::opendrive
