// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/sumo/read_net.hpp"
#include "common/world/sumo/road_edges.hpp"

namespace rodeira::sumo {

inline constexpr double kBeside_m = 0.6;  // signs and lights stand so far beside the road's edge

// What became of the lights, by their ids in SUMO.
struct LightsWritten {
  std::size_t lights = 0;                       // traffic lights with times
  std::map<std::string, std::string> light_of;  // by the id of a controller
  std::set<std::string> actuated;               // lights with phases of other lengths in SUMO by traffic
  std::set<std::string> held;                   // lights of which a green that yields to a crossing green is red
  std::set<std::string> dark;                   // lights without times
};

// Replaces netconvert's signals and controllers by lights that show what the programs say: one at the end of a road
// where all ways from it show the same, one at the end of a lane where its ways do, else one where each way begins.
// Lights named in `dark` stay dark.
LightsWritten WriteLights(const Net& net, const RoadEdges& edges, pugi::xml_node drive,
                          const std::set<std::string>& dark);

// A signal at s, for the lanes from..to, without dependencies; below `signals` of the road.
struct SignalSpec {
  std::string id, name, type;
  double s_m = 0.0, t_m = 0.0, above_m = 2.0, width_m = 0.0, height_m = 0.0;
  bool dynamic = false;
  int from_lane = 0, to_lane = 0;
};
// s, t, above (z offset), width and height in metres as OpenDRIVE's <signal> has them.
void WriteSignal(pugi::xml_node road, const SignalSpec& spec);

// A painted line across lanes, before the end of the road: "294" to stop at, "341" to give way at.
void WriteLineAcross(pugi::xml_node road, const std::string& id, bool stops, double left_m, double right_m,
                     int from_lane, int to_lane);

// The road's attribute, m; 0 where it has none.
double LengthOf(const pugi::xml_node& road);
// How far the right edge of a lane lies to the right of the reference line, at the road's beginning.
double RightEdgeOf(const pugi::xml_node& road, int lane);
// The first width record's constant part, m: netconvert writes no other.
double WidthOf(const pugi::xml_node& lane);

}  // namespace rodeira::sumo
