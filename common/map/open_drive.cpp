#include "common/map/open_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "common/map/border_paint.hpp"
#include "common/map/drive_piece.hpp"
#include "common/network/marking.hpp"

namespace rodeira::map {
namespace {

constexpr double kTolerance_m = 0.005;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

void Set(pugi::xml_node node, const char* name, double value) { node.append_attribute(name) = fmt::format("{}", value).c_str(); }
void Set(pugi::xml_node node, const char* name, std::string_view value) {
  node.append_attribute(name) = std::string(value).c_str();
}

void SetCubic(pugi::xml_node node, const Cubic1& c, const char* suffix = "") {
  for (std::size_t i = 0; i < c.size(); ++i) Set(node, (std::string(1, static_cast<char>('a' + i)) + suffix).c_str(), c[i]);
}

// The junction of each connection; kNone where the two roads are linked simply. Connections share a junction that leave the
// same lane or arrive at the same lane, and so on.
std::vector<std::size_t> JunctionsOf(const LaneMap& map, std::size_t& junctions) {
  std::vector<std::size_t> of(map.connections.size(), kNone);
  for (std::size_t first = 0; first < of.size(); ++first) {
    const MapConnection& link = map.connections[first];
    if (of[first] != kNone || (map.lanes[link.from].onward.size() == 1 && map.lanes[link.to].arriving.size() == 1)) continue;
    std::vector<std::size_t> open = {first};
    of[first] = junctions;
    while (!open.empty()) {
      const MapConnection connection = map.connections[open.back()];
      open.pop_back();
      for (const auto* beside : {&map.lanes[connection.from].onward, &map.lanes[connection.to].arriving}) {
        for (const std::size_t next : *beside) {
          if (of[next] == kNone) open.push_back(next);
          of[next] = junctions;
        }
      }
    }
    ++junctions;
  }
  return of;
}

class Writer {
 public:
  Writer(const LaneMap& map, const std::string& name) : map_(map), junction_of_(JunctionsOf(map, drive_.junctions)) {
    root_ = document_.append_child("OpenDRIVE");
    pugi::xml_node header = root_.append_child("header");
    Set(header, "revMajor", "1");
    Set(header, "revMinor", "7");
    Set(header, "name", name);
    Set(header, "vendor", "Rodeira");
  }

  base::Result<OpenDrive> Write() {
    for (const MapLane& lane : map_.lanes) {
      const auto pieces = FitLane(lane.shape, kTolerance_m, error_);
      if (!pieces) return base::WrongInput(fmt::format("lane {}: {}", lane.id, pieces.error().message));
      drive_.pieces += pieces.value().size();
      WriteRoad(lane, pieces.value());
    }
    for (std::size_t i = 0; i < map_.lights.size(); ++i) WriteController(map_.lights[i], i);
    for (std::size_t i = 0; i < drive_.junctions; ++i) WriteJunction(i);
    drive_.roads = map_.lanes.size();
    drive_.middle_error_m = error_.middle_m;
    drive_.border_error_m = error_.border_m;
    drive_.height_error_m = error_.height_m;
    std::ostringstream text;
    document_.save(text, " ", pugi::format_default, pugi::encoding_utf8);
    drive_.xml = text.str();
    return std::move(drive_);
  }

 private:
  void WriteRoad(const MapLane& lane, const std::vector<DrivePiece>& pieces) {
    pugi::xml_node road = root_.append_child("road");
    Set(road, "name", fmt::format("lane {}", lane.id));
    Set(road, "length", lane.shape.length_m());
    Set(road, "id", fmt::format("{}", lane.id));
    Set(road, "junction", "-1");
    Set(road, "rule", "RHT");
    pugi::xml_node link = road.append_child("link");
    const bool from_road = WriteLink(link, "predecessor", lane.arriving);
    const bool to_road = WriteLink(link, "successor", lane.onward);
    WriteGeometry(road, pieces);
    WriteLanes(road.append_child("lanes"), lane, pieces, from_road, to_road);
    const bool lit = std::any_of(map_.lights.begin(), map_.lights.end(), [&](const MapLight& l) { return &map_.lanes[l.lane] == &lane; });
    const bool stop = std::any_of(lane.onward.begin(), lane.onward.end(), [&](std::size_t i) { return map_.connections[i].stop; });
    const std::vector<MapSign> signs = SignsOf(lane, stop);
    if (!lit && !stop && signs.empty()) return;
    pugi::xml_node signals = road.append_child("signals");
    if (stop) WriteSignal(signals, lane, lane.shape.length_m(), fmt::format("{}", lane.id), "STOP", "206");
    for (std::size_t i = 0; i < signs.size(); ++i) {
      constexpr std::array<const char*, kSignKinds> kNames = {"STOP", "give way", "priority", "speed limit"}, kTypes = {"206", "205", "301", "274"};
      const auto kind = static_cast<std::size_t>(signs[i].kind);
      pugi::xml_node signal = WriteSignal(signals, lane, signs[i].s_m, fmt::format("{} sign {}", lane.id, i + 1), kNames[kind], kTypes[kind]);
      if (signs[i].kind == SignKind::kSpeedLimit) Set(signal, "value", signs[i].limit_kmh), Set(signal, "unit", "km/h");
    }
    if (lit) WriteSignal(signals, lane, lane.shape.length_m(), fmt::format("light {}", lane.id), "light", "1000001");
    WriteLinesAcross(signals, lane, stop || lit, signs);
  }

  // What is painted where one stops or gives way: before the sign, or at the end of the lane; nothing twice.
  static void WriteLinesAcross(pugi::xml_node signals, const MapLane& lane, bool stops_at_end, const std::vector<MapSign>& signs) {
    std::set<std::pair<double, bool>> lines;  // s, and whether one stops there
    const auto line = [&](double s_m, bool stops) { lines.emplace(std::max(s_m - kLineBefore_m, 0.0), stops); };
    if (stops_at_end) line(lane.shape.length_m(), true);
    for (const MapSign& sign : signs) {
      if (sign.kind == SignKind::kStop || sign.kind == SignKind::kGiveWay) line(sign.s_m, sign.kind == SignKind::kStop);
    }
    int number = 0;
    for (const auto& [s_m, stops] : lines) {
      const LanePoint at = lane.shape.At(s_m);
      pugi::xml_node signal = signals.append_child("signal");
      Set(signal, "s", s_m);
      Set(signal, "t", at.left_m);
      Set(signal, "id", fmt::format("{} line {}", lane.id, ++number));
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

  // Along the lane; none that says what a STOP flag says already.
  std::vector<MapSign> SignsOf(const MapLane& lane, bool stop) const {
    std::vector<MapSign> signs;
    for (const MapSign& sign : map_.signs) {
      if (&map_.lanes[sign.lane] == &lane && !(stop && sign.kind == SignKind::kStop)) signs.push_back(sign);
    }
    std::stable_sort(signs.begin(), signs.end(), [](const MapSign& a, const MapSign& b) { return a.s_m < b.s_m; });
    return signs;
  }

  // Whether it is a road, and not a junction, that lies there.
  bool WriteLink(pugi::xml_node link, const char* which, const std::vector<std::size_t>& connections) {
    if (connections.empty()) return false;
    const MapConnection& connection = map_.connections[connections.front()];
    const std::size_t junction = junction_of_[connections.front()];
    const bool before = std::string_view(which) == "predecessor";
    pugi::xml_node node = link.append_child(which);
    Set(node, "elementType", junction == kNone ? "road" : "junction");
    if (junction != kNone) {
      Set(node, "elementId", fmt::format("{}", junction + 1));
      return false;
    }
    Set(node, "elementId", fmt::format("{}", map_.lanes[before ? connection.from : connection.to].id));
    Set(node, "contactPoint", before ? "end" : "start");
    return true;
  }

  static void WriteGeometry(pugi::xml_node road, const std::vector<DrivePiece>& pieces) {
    pugi::xml_node plan = road.append_child("planView");
    pugi::xml_node heights = road.append_child("elevationProfile");
    for (const DrivePiece& piece : pieces) {
      pugi::xml_node geometry = plan.append_child("geometry");
      Set(geometry, "s", piece.s_m);
      Set(geometry, "x", piece.p_W.x());
      Set(geometry, "y", piece.p_W.y());
      Set(geometry, "hdg", piece.heading_rad);
      Set(geometry, "length", piece.length_m);
      pugi::xml_node cubic = geometry.append_child("paramPoly3");
      SetCubic(cubic, piece.u, "U");
      SetCubic(cubic, piece.v, "V");
      Set(cubic, "pRange", "arcLength");
      pugi::xml_node elevation = heights.append_child("elevation");
      Set(elevation, "s", piece.s_m);
      SetCubic(elevation, piece.z);
    }
  }

  // Dashes begin where the lane does; two lines lie to both sides of the border.
  static void WriteMark(pugi::xml_node lane, BorderType type) {
    const network::LineKind& paint = PaintOf(type);
    const bool dashed = paint.gap_m > 0.0;
    std::string name = paint.lines == 0 ? "none" : dashed ? "broken" : "solid";
    if (paint.lines == 2) name += " " + name;
    pugi::xml_node mark = lane.append_child("roadMark");
    Set(mark, "sOffset", 0.0);
    Set(mark, "type", name);
    Set(mark, "weight", paint.width_m >= network::kBoldWidth_m ? "bold" : "standard");
    Set(mark, "color", "standard");
    if (paint.lines == 0) return;
    Set(mark, "width", paint.width_m);
    pugi::xml_node lines = mark.append_child("type");
    Set(lines, "name", name);
    Set(lines, "width", paint.width_m);
    const double beside_m = paint.lines == 2 ? 0.5 * (paint.width_m + network::kLinesApart_m) : 0.0;
    for (int i = 0; i < paint.lines; ++i) {
      pugi::xml_node line = lines.append_child("line");
      Set(line, "length", paint.stroke_m);
      Set(line, "space", paint.gap_m);
      Set(line, "tOffset", i == 0 ? beside_m : -beside_m);
      Set(line, "sOffset", 0.0);
      Set(line, "width", paint.width_m);
    }
  }

  void WriteLanes(pugi::xml_node lanes, const MapLane& lane, const std::vector<DrivePiece>& pieces, bool from_road,
                  bool to_road) const {
    for (const DrivePiece& piece : pieces) {
      pugi::xml_node offset = lanes.append_child("laneOffset");
      Set(offset, "s", piece.s_m);
      SetCubic(offset, piece.left);
    }
    pugi::xml_node section = lanes.append_child("laneSection");
    Set(section, "s", 0.0);
    const auto append = [&section](const char* side, const char* id, const char* type) {
      pugi::xml_node node = section.append_child(side).append_child("lane");
      Set(node, "id", id);
      Set(node, "type", type);
      Set(node, "level", "false");
      return node;
    };
    WriteMark(append("center", "0", "none"), lane.left_type);
    pugi::xml_node right = append("right", "-1", "driving");
    pugi::xml_node link = right.append_child("link");
    if (from_road) Set(link.append_child("predecessor"), "id", "-1");
    if (to_road) Set(link.append_child("successor"), "id", "-1");
    for (const DrivePiece& piece : pieces) {
      pugi::xml_node width = right.append_child("width");
      Set(width, "sOffset", piece.s_m);
      SetCubic(width, piece.width);
    }
    WriteMark(right, lane.right_type);
    for (const MapSign& sign : SignsOf(lane, false)) {
      if (sign.kind != SignKind::kSpeedLimit) continue;
      pugi::xml_node speed = right.append_child("speed");
      Set(speed, "sOffset", sign.s_m);
      Set(speed, "max", sign.limit_kmh);
      Set(speed, "unit", "km/h");
    }
  }

  static pugi::xml_node WriteSignal(pugi::xml_node signals, const MapLane& lane, double s_m, const std::string& id, const char* name,
                                    const char* type) {
    const bool light = std::string_view(name) == "light";
    pugi::xml_node signal = signals.append_child("signal");
    Set(signal, "s", s_m);
    Set(signal, "t", lane.shape.At(s_m).right_m - 0.6);
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

  // OpenDRIVE has no times of lights: they stand in the data of users.
  void WriteController(const MapLight& light, std::size_t number) {
    const std::int32_t id = map_.lanes[light.lane].id;
    pugi::xml_node controller = root_.append_child("controller");
    Set(controller, "id", fmt::format("{}", number + 1));
    Set(controller, "name", fmt::format("lane {}", id));
    pugi::xml_node control = controller.append_child("control");
    Set(control, "signalId", fmt::format("light {}", id));
    Set(control, "type", "0");
    pugi::xml_node data = controller.append_child("userData");
    Set(data, "code", "rodeira:times");
    const network::LightTimes& times = light.times;
    Set(data, "value", fmt::format("{} {} {} {} {}", times.cycle_s, times.green_from_s, times.green_s, times.amber_s, times.red_amber_s));
  }

  void WriteJunction(std::size_t number) {
    pugi::xml_node junction = root_.append_child("junction");
    Set(junction, "id", fmt::format("{}", number + 1));
    Set(junction, "name", fmt::format("junction {}", number + 1));
    Set(junction, "type", "direct");
    int count = 0;
    for (std::size_t i = 0; i < map_.connections.size(); ++i) {
      if (junction_of_[i] != number) continue;
      pugi::xml_node connection = junction.append_child("connection");
      Set(connection, "id", fmt::format("{}", count++));
      Set(connection, "incomingRoad", fmt::format("{}", map_.lanes[map_.connections[i].from].id));
      Set(connection, "linkedRoad", fmt::format("{}", map_.lanes[map_.connections[i].to].id));
      Set(connection, "contactPoint", "start");
      pugi::xml_node link = connection.append_child("laneLink");
      Set(link, "from", "-1");
      Set(link, "to", "-1");
    }
  }

  const LaneMap& map_;
  OpenDrive drive_;
  std::vector<std::size_t> junction_of_;
  DriveError error_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace

base::Result<OpenDrive> ToOpenDrive(const LaneMap& map, const std::string& name) { return Writer(map, name).Write(); }

}  // namespace rodeira::map
