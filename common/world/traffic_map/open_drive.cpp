// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/open_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "common/world/network/marking.hpp"
#include "common/world/traffic_map/border_paint.hpp"
#include "common/world/traffic_map/drive_piece.hpp"
#include "common/world/traffic_map/drive_signals.hpp"

namespace rodeira::traffic_map {
namespace {

constexpr double kLength_m = 0.5e-3;  // ASAM allows twice that between a curve and its element
void SetCubic(pugi::xml_node node, const Cubic1& c, const char* suffix = "") {
  for (std::size_t i = 0; i < c.size(); ++i)
    Set(node, (std::string(1, static_cast<char>('a' + i)) + suffix).c_str(), c[i]);
}

class Writer {
 public:
  Writer(const LaneMap& map, const std::string& name, Junctions kind)
      : map_(map),
        kind_(kind),
        tells_modes_(kind == Junctions::kDirect || !BeginsAndEndsAtItsEdge(map)),
        own_(map.left_hand ? "1" : "-1"),
        plan_(PlanRoads(map, kind)) {
    if (kind == Junctions::kCommon) bounds_.length_m = kLength_m;
    root_ = document_.append_child("OpenDRIVE");
    pugi::xml_node header = root_.append_child("header");
    Set(header, "revMajor", "1");
    Set(header, "revMinor", "7");
    Set(header, "name", name);
    Set(header, "vendor", "Rodeira");
  }

  base::Result<OpenDrive> Write() {
    for (const PlannedRoad& road : plan_.roads) {
      if (const auto written = WriteRoad(road); !written) return written.error();
    }
    for (std::size_t i = 0; i < map_.lights.size(); ++i) WriteController(map_, i, root_);
    for (std::size_t i = 0; i < plan_.junctions.size(); ++i) WriteJunction(i);
    drive_.roads = plan_.roads.size();
    drive_.junctions = plan_.junctions.size();
    drive_.middle_error_m = error_.middle_m;
    drive_.border_error_m = error_.border_m;
    drive_.height_error_m = error_.height_m;
    std::ostringstream text;
    document_.save(text, " ", pugi::format_default, pugi::encoding_utf8);
    drive_.xml = text.str();
    return std::move(drive_);
  }

 private:
  // A part of a road as cubics, which count their s along the road.
  struct FittedPart {
    RoadPart part;
    double s_m;
    std::vector<DrivePiece> pieces;
  };

  // The parts of a road one behind the other. Wrong input where a lane cannot be fitted.
  base::Result<std::vector<FittedPart>> Fit(const PlannedRoad& plan) {
    std::vector<FittedPart> parts;
    double s_m = 0.0;
    for (const RoadPart& part : plan.parts) {
      const MapLane& lane = map_.lanes[part.lane];
      auto pieces = FitLane(lane.shape, part.from_m, part.to_m, bounds_, error_);
      if (!pieces)
        return pieces.error().WithMessage(fmt::format("lane {}: {}", lane.id, pieces.error().message)).WithContext("");
      if (part.from_m != 0.0 || s_m != 0.0) {
        for (DrivePiece& piece : pieces.value()) piece.s_m += s_m - part.from_m;
      }
      drive_.pieces += pieces.value().size();
      parts.push_back({part, s_m, std::move(pieces).value()});
      s_m += part.length_m();
    }
    return parts;
  }

  base::Status WriteRoad(const PlannedRoad& plan) {
    const auto fitted = Fit(plan);
    if (!fitted) return fitted.error();
    const std::vector<FittedPart>& parts = fitted.value();
    pugi::xml_node road = root_.append_child("road");
    Set(road, "name", plan.name);
    Set(road, "length", parts.back().s_m + parts.back().part.length_m());
    Set(road, "id", fmt::format("{}", plan.id));
    Set(road, "junction", plan.junction == kNoJunction ? "-1" : fmt::format("{}", plan.junction + 1));
    Set(road, "rule", map_.left_hand ? "LHT" : "RHT");
    pugi::xml_node link = road.append_child("link");
    WriteLink(link, "predecessor", plan.before);
    WriteLink(link, "successor", plan.behind);
    WriteGeometry(road, parts);
    WriteLanes(road.append_child("lanes"), plan, parts);
    if (plan.own != kNoRoad) WriteSignals(map_, plan, road);
    return {};
  }

  void WriteLink(pugi::xml_node link, const char* which, const PlannedLink& planned) const {
    if (planned.junction == kNoJunction && planned.road == kNoRoad) return;
    pugi::xml_node node = link.append_child(which);
    Set(node, "elementType", planned.junction == kNoJunction ? "road" : "junction");
    if (planned.junction != kNoJunction) {
      Set(node, "elementId", fmt::format("{}", planned.junction + 1));
      return;
    }
    Set(node, "elementId", fmt::format("{}", plan_.roads[planned.road].id));
    Set(node, "contactPoint", std::string_view(which) == "predecessor" ? "end" : "start");
  }

  static void WriteGeometry(pugi::xml_node road, const std::vector<FittedPart>& parts) {
    pugi::xml_node plan = road.append_child("planView");
    pugi::xml_node heights = road.append_child("elevationProfile");
    for (const FittedPart& part : parts) {
      for (const DrivePiece& piece : part.pieces) {
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

  void WriteLanes(pugi::xml_node lanes, const PlannedRoad& plan, const std::vector<FittedPart>& parts) const {
    for (const FittedPart& part : parts) {
      for (const DrivePiece& piece : part.pieces) {
        pugi::xml_node offset = lanes.append_child("laneOffset");
        Set(offset, "s", piece.s_m);
        Cubic1 inner = piece.left;  // in left-hand traffic lanes lie to the left of the centre: it is the right border
        for (std::size_t i = 0; map_.left_hand && i < inner.size(); ++i) inner[i] -= piece.width[i];
        SetCubic(offset, inner);
      }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      WriteSection(lanes, parts[i], i > 0 || plan.before.road != kNoRoad,
                   i + 1 < parts.size() || plan.behind.road != kNoRoad, i == plan.own);
    }
  }

  // linked_*: the lane goes on there, and no junction decides into which. own: the road is this lane's.
  void WriteSection(pugi::xml_node lanes, const FittedPart& part, bool linked_before, bool linked_behind,
                    bool own) const {
    const MapLane& lane = map_.lanes[part.part.lane];
    pugi::xml_node section = lanes.append_child("laneSection");
    Set(section, "s", part.s_m);
    const auto append = [&section](const char* side, const char* id, const char* type) {
      pugi::xml_node node = section.append_child(side).append_child("lane");
      Set(node, "id", id);
      Set(node, "type", type);
      Set(node, "level", "false");
      return node;
    };
    // A section's sides stand from the left to the right.
    pugi::xml_node own_lane;
    if (map_.left_hand) own_lane = append("left", own_, "driving");
    WriteMark(append("center", "0", "none"), map_.left_hand ? lane.right_type : lane.left_type);
    if (!map_.left_hand) own_lane = append("right", own_, "driving");
    pugi::xml_node link = own_lane.append_child("link");
    if (linked_before) Set(link.append_child("predecessor"), "id", own_);
    if (linked_behind) Set(link.append_child("successor"), "id", own_);
    for (const DrivePiece& piece : part.pieces) {
      pugi::xml_node width = own_lane.append_child("width");
      Set(width, "sOffset", piece.s_m - part.s_m);
      SetCubic(width, piece.width);
    }
    WriteMark(own_lane, map_.left_hand ? lane.left_type : lane.right_type);
    WriteSpeeds(own_lane, part.part);
    if (own) WriteNeighbours(own_lane, part.part.lane);
    if (own && tells_modes_ && lane.mode != LaneMode::kNone) {  // OpenDRIVE has no word for it
      pugi::xml_node data = own_lane.append_child("userData");
      Set(data, "code", "rodeira:traffic");
      Set(data, "value", lane.mode == LaneMode::kStart ? "begins" : "ends");
    }
  }

  // Lanes beside on roads of their own, outside of junctions. OpenDRIVE has no word for them either.
  void WriteNeighbours(pugi::xml_node node, std::size_t lane) const {
    const auto is_own_road = [&](std::size_t of) {
      return plan_.roads[of].parts.size() == 1 && plan_.roads[of].junction == kNoJunction;
    };
    const auto write = [&](const char* code, const std::optional<std::size_t>& beside) {
      if (!beside || !is_own_road(lane) || !is_own_road(*beside)) return;
      pugi::xml_node data = node.append_child("userData");
      Set(data, "code", code);
      Set(data, "value", fmt::format("{} {}", own_, plan_.roads[*beside].id));
    };
    write("rodeira:left", map_.lanes[lane].left), write("rodeira:right", map_.lanes[lane].right);
  }

  // Limits that hold on the part: the last one before it, and those along it.
  void WriteSpeeds(pugi::xml_node lane, const RoadPart& part) const {
    std::vector<MapSign> limits;
    for (const MapSign& sign : SignsOf(map_, part.lane)) {
      if (sign.kind != SignKind::kSpeedLimit || sign.s_m >= part.to_m) continue;
      if (sign.s_m <= part.from_m) limits.clear();
      limits.push_back(sign);
    }
    for (const MapSign& sign : limits) {
      pugi::xml_node speed = lane.append_child("speed");
      Set(speed, "sOffset", std::max(0.0, sign.s_m - part.from_m));
      Set(speed, "max", sign.limit_kmh);
      Set(speed, "unit", "km/h");
    }
  }

  void WriteJunction(std::size_t number) {
    pugi::xml_node junction = root_.append_child("junction");
    Set(junction, "id", fmt::format("{}", number + 1));
    Set(junction, "name", fmt::format("junction {}", number + 1));
    Set(junction, "type", kind_ == Junctions::kDirect ? "direct" : "default");
    int count = 0;
    for (const PlannedWay& way : plan_.junctions[number]) {
      pugi::xml_node connection = junction.append_child("connection");
      Set(connection, "id", fmt::format("{}", count++));
      Set(connection, "incomingRoad", fmt::format("{}", plan_.roads[way.from].id));
      Set(connection, kind_ == Junctions::kDirect ? "linkedRoad" : "connectingRoad",
          fmt::format("{}", plan_.roads[way.to].id));
      Set(connection, "contactPoint", "start");
      pugi::xml_node link = connection.append_child("laneLink");
      Set(link, "from", own_);
      Set(link, "to", own_);
    }
  }

  const LaneMap& map_;
  Junctions kind_;
  bool tells_modes_;  // where vehicles begin and end
  const char* own_;   // the lane's number on its road
  FitBounds bounds_;
  RoadPlan plan_;
  OpenDrive drive_;
  DriveError error_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace

base::Result<OpenDrive> ToOpenDrive(const LaneMap& map, const std::string& name, Junctions junctions) {
  return Writer(map, name, junctions).Write();
}

}  // namespace rodeira::traffic_map
