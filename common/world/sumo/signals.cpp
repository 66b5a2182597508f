// SPDX-License-Identifier: Apache-2.0
#include "common/world/sumo/signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/lanes/approach.hpp"
#include "common/world/sumo/light_program.hpp"

namespace rodeira::sumo {
namespace {

constexpr double kLineBefore_m = 0.3;  // the end of the road
constexpr double kOverhead_m = 5.0;

void Set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name) = value.c_str();
}
// Lengths to a micrometre; no "-0".
void Set(pugi::xml_node node, const char* name, double value) { Set(node, name, fmt::format("{:.9g}", value + 0.0)); }

pugi::xml_node SignalsOf(pugi::xml_node road) {
  const pugi::xml_node signals = road.child("signals");
  return signals ? signals : road.append_child("signals");
}

void RemoveSignals(pugi::xml_node drive) {
  for (pugi::xml_node road : drive.children("road")) {
    for (pugi::xml_node old = road.child("signals").child("signal"); old; old = road.child("signals").child("signal"))
      road.child("signals").remove_child(old);
  }
  while (drive.remove_child("controller")) {
  }
  for (pugi::xml_node junction : drive.children("junction")) {
    while (junction.remove_child("controller")) {
    }
  }
}

bool ComeFromSides(const Net& net, const NetConnection& a, const NetConnection& b) {
  const NetEdge *from_a = net.Edge(a.from), *from_b = net.Edge(b.from);
  if (from_a == nullptr || from_b == nullptr) return true;
  const double turned = std::fabs(geometry::WrapAngle(from_a->end_heading_rad - from_b->end_heading_rad));
  return turned >= lanes::kSameDirection_rad && turned <= lanes::kHeadOn_rad;
}

// The phases in which a connection's green yields to a green that comes from another side.
std::vector<bool> HeldPhases(const Net& net, const LightProgram& program, const NetConnection& connection) {
  std::vector<bool> held(program.phases.size());
  const auto junction = net.junctions.find(connection.junction);
  if (connection.request < 0 || junction == net.junctions.end() ||
      static_cast<std::size_t>(connection.request) >= junction->second.requests.size())
    return held;
  const std::string& foes = junction->second.requests[static_cast<std::size_t>(connection.request)].foes;
  for (const NetConnection& other : net.connections) {
    if (other.light != connection.light || other.junction != connection.junction || !IsSet(foes, other.request) ||
        !ComeFromSides(net, connection, other))
      continue;
    for (std::size_t phase = 0; phase < held.size(); ++phase) {
      held[phase] = held[phase] || (IsYieldingGreen(program, phase, connection.light_index) &&
                                    IsGreen(program, phase, other.light_index));
    }
  }
  return held;
}

// The controllers of a network's lights: connections with lights that show the same share one.
class Controllers {
 public:
  Controllers(const Net& net, const RoadEdges& edges, const std::set<std::string>& dark, LightsWritten& written) {
    for (const ConnectingLane& way : edges.ways) {
      const NetConnection& connection = *way.connection;
      if (connection.light.empty()) continue;
      const auto program = net.programs.find(connection.light);
      if (program == net.programs.end() || dark.contains(connection.light) || !HasTimes(program->second)) {
        written.dark.insert(connection.light);
        continue;
      }
      const std::vector<bool> held = HeldPhases(net, program->second, connection);
      const auto times = TimesOf(program->second, connection.light_index, held);
      if (!times) continue;
      if (program->second.type != "static") written.actuated.insert(connection.light);
      if (std::find(held.begin(), held.end(), true) != held.end()) written.held.insert(connection.light);
      of_[&connection] = Controller(connection.light, *times, written);
    }
  }

  // The id of the controller; empty where the way has no light.
  std::string Of(const NetConnection& connection) const {
    const auto found = of_.find(&connection);
    return found == of_.end() ? std::string() : found->second;
  }
  void Control(const std::string& controller, const std::string& signal) { signals_[controller].push_back(signal); }

  void Write(pugi::xml_node drive, const LightsWritten& written) const {
    for (const auto& [key, id] : ids_) {
      const auto signals = signals_.find(id);
      if (signals == signals_.end()) continue;
      pugi::xml_node controller = drive.append_child("controller");
      Set(controller, "id", id);
      Set(controller, "name", written.light_of.at(id));
      for (const std::string& signal : signals->second) {
        pugi::xml_node control = controller.append_child("control");
        Set(control, "signalId", signal);
        Set(control, "type", "0");
      }
      pugi::xml_node data = controller.append_child("userData");
      Set(data, "code", "rodeira:times");
      Set(data, "value", key.second);
    }
  }

 private:
  using Key = std::pair<std::string, std::string>;  // the light, and its times as they are written

  static std::string Written(const network::LightTimes& times) {
    std::string text = fmt::format("{} {} {} {} {}", times.cycle_s, times.green_from_s, times.green_s, times.amber_s,
                                   times.red_amber_s);
    for (const network::LightGreen& green : times.more)
      text += fmt::format(" {} {} {} {}", green.from_s, green.green_s, green.amber_s, green.red_amber_s);
    return text;
  }

  std::string Controller(const std::string& light, const network::LightTimes& times, LightsWritten& written) {
    const Key key(light, Written(times));
    const auto found = ids_.find(key);
    if (found != ids_.end()) return found->second;
    std::string id = fmt::format("{}/{}", light, ++count_[light]);
    ids_.emplace(key, id);
    written.light_of[id] = light;
    return id;
  }

  std::map<const NetConnection*, std::string> of_;
  std::map<Key, std::string> ids_;
  std::map<std::string, int> count_;
  std::map<std::string, std::vector<std::string>> signals_;
};

constexpr double kLightWidth_m = 0.3, kLightHeight_m = 0.9;

SignalSpec Light(std::string id, std::string name) {
  SignalSpec spec;
  spec.id = std::move(id), spec.name = std::move(name), spec.type = "1000001";
  spec.dynamic = true, spec.width_m = kLightWidth_m, spec.height_m = kLightHeight_m;
  return spec;
}

// The lights of the ways that leave one edge.
void WriteEdge(const Net& net, const RoadEdges& edges, const std::string& id,
               const std::vector<const ConnectingLane*>& ways, Controllers& controllers) {
  const NetEdge& edge = *net.Edge(id);
  const pugi::xml_node road = edges.road_of.at(id);
  std::map<int, std::set<std::string>> by_lane;
  std::set<std::string> all;
  for (const ConnectingLane* way : ways) {
    const std::string controller = controllers.Of(*way->connection);
    by_lane[way->connection->from_lane].insert(controller);
    all.insert(controller);
  }
  if (all.size() == 1 && all.begin()->empty()) return;
  const int lanes = static_cast<int>(edge.lanes.size());
  const double length_m = LengthOf(road), right_m = RightEdgeOf(road, -lanes);
  WriteLineAcross(road, id + " line", true, 0.0, right_m, -lanes, -1);
  if (all.size() == 1) {
    SignalSpec light = Light(id, *all.begin());
    light.s_m = length_m, light.t_m = -right_m - kBeside_m, light.from_lane = -lanes, light.to_lane = -1;
    WriteSignal(road, light);
    controllers.Control(*all.begin(), light.id);
    return;
  }
  for (const auto& [index, shown] : by_lane) {
    if (shown.size() != 1 || shown.begin()->empty()) continue;
    const int lane = LaneId(index, edge.lanes.size());
    const double width_m = WidthOf(edges.Lane(id, index)), outer_m = RightEdgeOf(road, lane);
    SignalSpec light = Light(fmt::format("{}_{}", id, index), *shown.begin());
    const bool outermost = index == 0;
    light.s_m = length_m, light.from_lane = lane, light.to_lane = lane;
    light.t_m = outermost ? -outer_m - kBeside_m : -outer_m + 0.5 * width_m;
    light.above_m = outermost ? light.above_m : kOverhead_m;
    WriteSignal(road, light);
    controllers.Control(*shown.begin(), light.id);
  }
  for (const ConnectingLane* way : ways) {
    const std::string controller = controllers.Of(*way->connection);
    if (controller.empty() || by_lane[way->connection->from_lane].size() == 1) continue;
    SignalSpec light = Light(way->connection->via, controller);
    light.t_m = -RightEdgeOf(way->road, way->lane_id) + 0.5 * WidthOf(way->lane);
    light.above_m = kOverhead_m, light.from_lane = way->lane_id, light.to_lane = way->lane_id;
    WriteSignal(way->road, light);
    controllers.Control(controller, light.id);
  }
}

}  // namespace

double LengthOf(const pugi::xml_node& road) { return road.attribute("length").as_double(); }

double WidthOf(const pugi::xml_node& lane) { return lane.child("width").attribute("a").as_double(); }

double RightEdgeOf(const pugi::xml_node& road, int lane) {
  double edge_m = 0.0;
  for (const pugi::xml_node& other : RightLanes(road)) {
    if (other.attribute("id").as_int() >= lane) edge_m += WidthOf(other);
  }
  return edge_m;
}

void WriteSignal(pugi::xml_node road, const SignalSpec& spec) {
  pugi::xml_node signal = SignalsOf(road).append_child("signal");
  Set(signal, "s", fmt::format("{}", spec.s_m));  // exactly: it is not to lie beyond the end of the road
  Set(signal, "t", spec.t_m);
  Set(signal, "id", spec.id);
  Set(signal, "name", spec.name);
  Set(signal, "dynamic", spec.dynamic ? "yes" : "no");
  Set(signal, "orientation", "+");
  Set(signal, "zOffset", spec.above_m);
  Set(signal, "country", spec.dynamic ? "OpenDRIVE" : "DE");
  Set(signal, "type", spec.type);
  Set(signal, "subtype", "-1");
  if (spec.height_m > 0.0) Set(signal, "height", spec.height_m);
  if (spec.width_m > 0.0) Set(signal, "width", spec.width_m);
  pugi::xml_node validity = signal.append_child("validity");
  validity.append_attribute("fromLane") = spec.from_lane;
  validity.append_attribute("toLane") = spec.to_lane;
}

void WriteLineAcross(pugi::xml_node road, const std::string& id, bool stops, double left_m, double right_m,
                     int from_lane, int to_lane) {
  SignalSpec line;
  line.id = id, line.name = stops ? "stop line" : "give way line", line.type = stops ? "294" : "341";
  line.s_m = std::max(0.0, LengthOf(road) - kLineBefore_m);
  line.t_m = -left_m, line.above_m = 0.0, line.width_m = right_m - left_m;
  line.from_lane = from_lane, line.to_lane = to_lane;
  WriteSignal(road, line);
}

LightsWritten WriteLights(const Net& net, const RoadEdges& edges, pugi::xml_node drive,
                          const std::set<std::string>& dark) {
  RemoveSignals(drive);
  LightsWritten written;
  Controllers controllers(net, edges, dark, written);
  std::map<std::string, std::vector<const ConnectingLane*>> by_edge;
  for (const ConnectingLane& way : edges.ways) by_edge[way.connection->from].push_back(&way);
  for (const auto& [edge, ways] : by_edge) {
    if (edges.road_of.contains(edge)) WriteEdge(net, edges, edge, ways, controllers);
  }
  controllers.Write(drive, written);
  std::set<std::string> lights;
  for (const auto& [controller, light] : written.light_of) lights.insert(light);
  written.lights = lights.size();
  return written;
}

}  // namespace rodeira::sumo
