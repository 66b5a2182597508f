// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/drive_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "common/world/traffic_map/border_paint.hpp"

namespace rodeira::traffic_map {
namespace {

bool Stops(const LaneMap& map, const MapLane& lane) {
  return std::any_of(lane.onward.begin(), lane.onward.end(), [&](std::size_t i) { return map.connections[i].stop; });
}

// A lane's places on its own road.
class LaneOnRoad {
 public:
  LaneOnRoad(const LaneMap& map, const PlannedRoad& plan)
      : part_(plan.parts[plan.own]), lane_(map.lanes[part_.lane]), left_hand_(map.left_hand) {
    for (std::size_t i = 0; i < plan.own; ++i) before_m_ += plan.parts[i].length_m();
  }
  const MapLane& lane() const { return lane_; }
  bool is_left_hand() const { return left_hand_; }
  double length_m() const { return lane_.shape.length_m(); }
  LanePoint At(double s_m) const { return lane_.shape.At(Held(s_m)); }
  // What lies on a part that another road has stands at this one's end.
  double StationOf(double s_m) const { return before_m_ + Held(s_m) - part_.from_m; }

 private:
  double Held(double s_m) const { return std::clamp(s_m, part_.from_m, part_.to_m); }

  const RoadPart& part_;
  const MapLane& lane_;
  bool left_hand_;
  double before_m_ = 0.0;
};

pugi::xml_node WriteSignal(pugi::xml_node signals, const LaneOnRoad& lane, double s_m, const std::string& id,
                           const char* name, const char* type) {
  const bool light = std::string_view(name) == "light";
  pugi::xml_node signal = signals.append_child("signal");
  Set(signal, "s", lane.StationOf(s_m));
  Set(signal, "t", lane.is_left_hand() ? lane.At(s_m).left_m + 0.6 : lane.At(s_m).right_m - 0.6);
  Set(signal, "id", id);
  Set(signal, "name", name);
  Set(signal, "dynamic", light ? "yes" : "no");
  Set(signal, "orientation", "+");
  Set(signal, "zOffset", 2.0);
  Set(signal, "country", light ? "OpenDRIVE" : "DE");
  Set(signal, "type", type);
  Set(signal, "subtype", "-1");
  if (light) Set(signal, "height", 0.9), Set(signal, "width", 0.3);
  return signal;
}

// What is painted where one stops or gives way: before the sign, or at the end of the lane; nothing twice.
void WriteLinesAcross(pugi::xml_node signals, const LaneOnRoad& lane, bool stops_at_end,
                      const std::vector<MapSign>& signs) {
  std::set<std::pair<double, bool>> lines;  // s, and whether one stops there
  const auto line = [&](double s_m, bool stops) { lines.emplace(std::max(s_m - kLineBefore_m, 0.0), stops); };
  if (stops_at_end) line(lane.length_m(), true);
  for (const MapSign& sign : signs) {
    if (sign.kind == SignKind::kStop || sign.kind == SignKind::kGiveWay) line(sign.s_m, sign.kind == SignKind::kStop);
  }
  int number = 0;
  for (const auto& [s_m, stops] : lines) {
    const LanePoint at = lane.At(s_m);
    pugi::xml_node signal = signals.append_child("signal");
    Set(signal, "s", lane.StationOf(s_m));
    Set(signal, "t", at.left_m);
    Set(signal, "id", fmt::format("{} line {}", lane.lane().id, ++number));
    Set(signal, "name", stops ? "stop line" : "give way line");
    Set(signal, "dynamic", "no");
    Set(signal, "orientation", "+");
    Set(signal, "zOffset", 0.0);
    Set(signal, "country", "DE");
    Set(signal, "type", stops ? "294" : "341");
    Set(signal, "subtype", "-1");
    Set(signal, "width", at.width_m());
  }
}

}  // namespace

void Set(pugi::xml_node node, const char* name, double value) {
  node.append_attribute(name) = fmt::format("{}", value).c_str();
}
void Set(pugi::xml_node node, const char* name, std::string_view value) {
  node.append_attribute(name) = std::string(value).c_str();
}

std::vector<MapSign> SignsOf(const LaneMap& map, std::size_t lane) {
  const bool stop = Stops(map, map.lanes[lane]);
  std::vector<MapSign> signs;
  for (const MapSign& sign : map.signs) {
    if (sign.lane == lane && !(stop && sign.kind == SignKind::kStop)) signs.push_back(sign);
  }
  std::stable_sort(signs.begin(), signs.end(), [](const MapSign& a, const MapSign& b) { return a.s_m < b.s_m; });
  return signs;
}

void WriteSignals(const LaneMap& map, const PlannedRoad& plan, pugi::xml_node road) {
  const LaneOnRoad at(map, plan);
  const MapLane& lane = at.lane();
  const std::size_t index = plan.parts[plan.own].lane;
  const bool lit =
      std::any_of(map.lights.begin(), map.lights.end(), [&](const MapLight& light) { return light.lane == index; });
  const bool stop = Stops(map, lane);
  const std::vector<MapSign> signs = SignsOf(map, index);
  if (!lit && !stop && signs.empty()) return;
  pugi::xml_node signals = road.append_child("signals");
  if (stop) WriteSignal(signals, at, at.length_m(), fmt::format("{}", lane.id), "STOP", "206");
  for (std::size_t i = 0; i < signs.size(); ++i) {
    constexpr std::array<const char*, kSignKinds> kNames = {"STOP", "give way", "priority", "speed limit"},
                                                  kTypes = {"206", "205", "301", "274"};
    const auto kind = static_cast<std::size_t>(signs[i].kind);
    pugi::xml_node signal =
        WriteSignal(signals, at, signs[i].s_m, fmt::format("{} sign {}", lane.id, i + 1), kNames[kind], kTypes[kind]);
    if (signs[i].kind == SignKind::kSpeedLimit) Set(signal, "value", signs[i].limit_kmh), Set(signal, "unit", "km/h");
  }
  if (lit) WriteSignal(signals, at, at.length_m(), fmt::format("light {}", lane.id), "light", "1000001");
  WriteLinesAcross(signals, at, stop || lit, signs);
}

void WriteController(const LaneMap& map, std::size_t light, pugi::xml_node root) {
  const std::int32_t id = map.lanes[map.lights[light].lane].id;
  pugi::xml_node controller = root.append_child("controller");
  Set(controller, "id", fmt::format("{}", light + 1));
  Set(controller, "name", fmt::format("lane {}", id));
  pugi::xml_node control = controller.append_child("control");
  Set(control, "signalId", fmt::format("light {}", id));
  Set(control, "type", "0");
  pugi::xml_node data = controller.append_child("userData");
  Set(data, "code", "rodeira:times");
  const network::LightTimes& times = map.lights[light].times;
  Set(data, "value",
      fmt::format("{} {} {} {} {}", times.cycle_s, times.green_from_s, times.green_s, times.amber_s,
                  times.red_amber_s));
}

}  // namespace rodeira::traffic_map
