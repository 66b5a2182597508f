// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/design/element_name.hpp"
#include "common/world/design/profile_reader.hpp"

namespace rodeira::road {
namespace {

using config::List;
using config::Map;
using config::Range;

constexpr double kSmallestRadius_m = 5.0;
constexpr Range kElementLength_m = {0.01, 100'000.0};
constexpr Range kCoordinate_m = {-1e8, 1e8};
constexpr Range kFall = {-0.2, 0.2};

// 1/radius; positive to the left.
double ReadCurvature(const Map& map, std::string_view key) {
  const double radius = map.Number(key);
  if (std::fabs(radius) >= kSmallestRadius_m && std::fabs(radius) <= 1e7) return 1.0 / radius;
  map.Problem(key, "config.out_of_range",
              fmt::format("'{}' is {}; at least {} m to the left (positive) or right (negative) was expected", key,
                          radius, kSmallestRadius_m));
  return 0.0;
}

geometry::PlanPiece ReadPiece(const Map& item) {
  geometry::PlanPiece piece{1.0, 0.0, 0.0};
  const design::ElementName name = design::ReadElementName(item);
  if (name.kind.empty()) {
    piece.length_m =
        kElementLength_m.high;  // so that nothing that stands along it seems to stand behind the road's end
  } else if (name.kind == "line") {
    piece.length_m = item.Child(name.key).Number("length_m", kElementLength_m);
  } else if (name.kind == "arc") {
    const Map arc = item.Child(name.key);
    piece.length_m = arc.Number("length_m", kElementLength_m);
    piece.curvature_start_1pm = piece.curvature_end_1pm = ReadCurvature(arc, "radius_m");
  } else {
    const Map clothoid = item.Child(name.key);
    piece.length_m = clothoid.Number("length_m", kElementLength_m);
    // A radius left out is a straight end.
    if (clothoid.Has("radius_start_m")) piece.curvature_start_1pm = ReadCurvature(clothoid, "radius_start_m");
    if (clothoid.Has("radius_end_m")) piece.curvature_end_1pm = ReadCurvature(clothoid, "radius_end_m");
    if (!clothoid.Has("radius_start_m") && !clothoid.Has("radius_end_m")) {
      clothoid.Problem("length_m", "config.missing_key",
                       "a clothoid needs 'radius_start_m' or 'radius_end_m'; one left out is a straight end");
    }
  }
  return piece;
}

void ReadAxis(const Map& map, RoadSpec& road) {
  const Map start = map.Child("start");
  road.start_W = {start.Number("x_m", kCoordinate_m, 0.0), start.Number("y_m", kCoordinate_m, 0.0)};
  road.heading_rad = geometry::WrapAngle(start.Number("heading_deg", {-360.0, 360.0}, 0.0) * geometry::kPi / 180.0);
  const List axis = map.Items("axis");
  for (std::size_t i = 0; i < axis.size(); ++i) road.pieces.push_back(ReadPiece(axis.At(i)));
  if (map.Has("axis") && axis.size() == 0)
    map.Problem("axis", "config.too_few", "the axis has no elements; at least one was expected");
}

void ReadLanes(const Map& map, SectionSpec& section) {
  const List lanes = map.Items("lanes");
  std::set<int> ids;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Map item = lanes.At(i);
    Lane lane;
    lane.id = static_cast<int>(item.Integer("id", -20, 20));
    lane.width_m = item.Number("width_m", {1.0, 20.0});
    lane.speed_limit_mps = item.Number("speed_limit_kmh", {1.0, 400.0}) / 3.6;
    // Traffic keeps to the right unless told otherwise.
    lane.direction =
        item.Choice("direction", {"along", "against"}, lane.id < 0 ? "along" : "against") == "along" ? 1 : -1;
    if (lane.id == 0)
      item.Problem("id", "a lane's 'id' is 0; negative ones lie to the right of the axis, positive ones to the left");
    if (!ids.insert(lane.id).second)
      item.Problem("id", "config.duplicate_name", fmt::format("lane {} appears twice", lane.id));
    section.lanes.push_back(lane);
  }
  if (map.Has("lanes") && lanes.size() == 0) map.Problem("lanes", "config.too_few", "a road needs at least one lane");
  for (const int id : ids) {
    const int inner = id > 0 ? id - 1 : id + 1;
    if (id != 0 && inner != 0 && !ids.contains(inner))
      map.Problem("lanes", fmt::format("there is a lane {} but no lane {} between it and the axis", id, inner));
  }
  std::sort(section.lanes.begin(), section.lanes.end(), [](const Lane& a, const Lane& b) { return a.id < b.id; });
}

Shoulder ReadShoulder(const Map& map, double lane_fall) {
  Shoulder shoulder;
  shoulder.width_m = map.Number("width_m", {0.0, 20.0}, 0.0);
  shoulder.surface = ReadSurface(map, "surface", ground::Surface::kAsphalt);
  shoulder.fall = map.Number("fall", kFall, lane_fall);
  return shoulder;
}

void ReadSection(const Map& map, SectionSpec& section) {
  ReadLanes(map, section);
  section.surface = ReadSurface(map, "surface", ground::Surface::kAsphalt);
  const Map crossfall = map.OptionalChild("crossfall");
  const std::string kind = crossfall.Choice("kind", {"crown", "left", "right"}, "crown");
  const double fall = crossfall.Number("fall", {0.0, 0.2}, 0.025);
  section.fall_left = kind == "right" ? -fall : fall;
  section.fall_right = kind == "left" ? -fall : fall;
  const Map shoulders = map.OptionalChild("shoulders");
  section.left = ReadShoulder(shoulders.OptionalChild("left"), section.fall_left);
  section.right = ReadShoulder(shoulders.OptionalChild("right"), section.fall_right);
  const Map verge = map.OptionalChild("verge");
  section.verge.width_m = verge.Number("width_m", {0.0, 50.0}, 1.0);
  section.verge.fall = verge.Number("fall", {-0.5, 0.5}, 0.08);
  section.verge.surface = ReadSurface(verge, "surface", ground::Surface::kGrass);
  section.blend_m = map.Number("blend_m", {0.5, 1000.0}, 10.0);
}

void ReadMarks(const Map& map, double length_m, std::vector<Mark>& marks) {
  const List items = map.OptionalItems("marks");
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Map item = items.At(i);
    Mark mark;
    mark.t_m = item.Number("t_m", {-200.0, 200.0});
    mark.width_m = item.Number("width_m", {0.01, 2.0}, 0.1);
    mark.from_s_m = item.Number("from_s_m", {0.0, length_m}, 0.0);
    mark.to_s_m = item.Number("to_s_m", {0.0, length_m}, length_m);
    mark.colour =
        item.Choice("colour", {"white", "yellow"}, "white") == "white" ? MarkColour::kWhite : MarkColour::kYellow;
    if (item.Choice("kind", {"continuous", "dashed"}) == "dashed") {
      mark.stroke_m = item.Number("stroke_m", {0.1, 100.0});
      mark.gap_m = item.Number("gap_m", {0.1, 100.0});
    }
    if (!(mark.from_s_m < mark.to_s_m))
      item.Problem("to_s_m", "config.wrong_order", "a mark must end after its beginning: 'to_s_m' above 'from_s_m'");
    marks.push_back(mark);
  }
}

}  // namespace

ground::Surface ReadSurface(const Map& map, std::string_view key, ground::Surface default_value) {
  using ground::Surface;
  const std::vector<Surface> surfaces = {Surface::kAsphalt, Surface::kConcrete, Surface::kGravel, Surface::kGrass,
                                         Surface::kSoil};
  std::vector<std::string> names;
  for (const Surface surface : surfaces) names.emplace_back(SurfaceName(surface));
  const std::string name = map.Choice(key, names, SurfaceName(default_value));
  for (const Surface surface : surfaces) {
    if (SurfaceName(surface) == name) return surface;
  }
  return default_value;
}

RoadSpec ReadRoad(const Map& map) {
  RoadSpec road;
  road.id = map.Text("id");
  ReadAxis(map, road);
  road.grade_points = design::ReadGrades(map);
  ReadSection(map.Child("section"), road.section);
  double length = 0.0;
  for (const geometry::PlanPiece& piece : road.pieces) length += piece.length_m;
  ReadMarks(map, length, road.marks);
  return road;
}

}  // namespace rodeira::road
