// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/section_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "common/core/base/suggest.hpp"
#include "common/world/design/line_reader.hpp"
#include "common/world/design/section_schema.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredList;
using config::DeclaredMap;
using config::Map;
using geometry::CubicTable;
using network::Lane;
using network::LaneType;

// A section's keys, of which those that are left out stand in its template.
struct Keys {
  DeclaredMap own, other;
  bool Has(std::string_view key) const { return own.map().Has(key) || other.map().Has(key); }
  const DeclaredMap& With(std::string_view key) const {
    return other.map().Has(key) && !own.map().Has(key) ? other : own;
  }
};

struct Falls {
  CubicTable left, right;  // of the lanes, outward
};

Falls ReadFalls(const Keys& keys) {
  if (keys.Has("crossfalls")) {
    const DeclaredMap& map = keys.With("crossfalls");
    const auto left = ReadKnots(map, "crossfalls", "left"), right = ReadKnots(map, "crossfalls", "right");
    if (left.empty())
      map.map().Problem("crossfalls", "config.too_few", "'crossfalls' has no points; at least one was expected");
    return {Eased(left), Eased(right)};
  }
  const DeclaredMap crossfall = keys.With("crossfall").Child("crossfall");
  const std::string kind = crossfall.Word("kind");
  const double fall = crossfall.Number("fall");
  return {Constant(kind == "right" ? -fall : fall), Constant(kind == "left" ? -fall : fall)};
}

// A lane before it has its number.
struct Strip {
  Lane lane;
  CubicTable fall;
  double kerb_m = 0.0;
};

Strip MakeStrip(LaneType type, CubicTable width, const Material& material, CubicTable fall) {
  Strip strip;
  strip.lane.type = type;
  strip.lane.width = std::move(width);
  strip.lane.materials.push_back({0.0, std::string(SurfaceName(material.surface)), material.friction, std::nullopt,
                                  material.texture, material.texture_width_m, material.texture_height_m});
  strip.fall = std::move(fall);
  return strip;
}

Strip ReadLane(const DeclaredMap& item, int id, const Context& context, const Falls& falls) {
  const std::string name = item.Word("type");
  const LaneType type = network::LaneTypeByName(name).value_or(LaneType::kDriving);
  const bool paved = type != LaneType::kNone && type != LaneType::kMedian;
  const bool walked = type == LaneType::kSidewalk || type == LaneType::kWalking || type == LaneType::kCurb;
  const Material& material = context.MaterialOf(item, "material", !paved ? "grass" : walked ? "concrete" : "asphalt");
  CubicTable fall = id > 0 ? falls.left : falls.right;
  if (const auto own = item.OptionalNumber("fall")) fall = Constant(*own);
  Strip strip =
      MakeStrip(type, ReadTable(item, "width_m", "widths", "width_m", IfAbsent::kProblem), material, std::move(fall));
  strip.kerb_m = item.Number("kerb_m");
  if (const auto speed_kmh = item.OptionalNumber("speed_limit_kmh"))
    strip.lane.speeds.push_back({0.0, *speed_kmh / 3.6});
  const bool with_s = (id < 0) != context.left_hand;
  const std::string direction = item.Word("direction", with_s ? "along" : "against");
  strip.lane.direction = direction == "along" ? 1 : direction == "both" ? 0 : -1;
  return strip;
}

// The lanes of both sides, from inside outward.
using Sides = std::map<int, Strip>;

Sides ReadLanes(const Keys& keys, const Context& context, const Falls& falls) {
  const Map& map = keys.With("lanes").MapWith("lanes");
  Sides sides;
  const DeclaredList lanes(map.Items("lanes"), config::FindKey(TemplateKeys(), "lanes")->of.front());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const DeclaredMap item = lanes.At(i);
    const int id = static_cast<int>(item.Integer("id"));
    if (id == 0)
      item.map().Problem("id",
                         "a lane's 'id' is 0; negative ones lie to the right of the axis, positive ones to the left");
    if (!sides.emplace(id, ReadLane(item, id, context, falls)).second)
      item.map().Problem("id", "config.duplicate_name", fmt::format("lane {} appears twice", id));
  }
  if (map.Has("lanes") && lanes.size() == 0)
    map.Problem("lanes", "config.too_few", "'lanes' is empty; a road needs at least one lane");
  for (const auto& [id, strip] : sides) {
    const int inner = id > 0 ? id - 1 : id + 1;
    if (id != 0 && inner != 0 && !sides.contains(inner)) {
      map.Problem("lanes", fmt::format("there is a lane {} but no lane {} between it and the axis", id, inner));
    }
  }
  return sides;
}

void AddBorders(const Keys& keys, bool left, const Context& context, const Falls& falls, std::vector<Strip>& side) {
  const DeclaredMap shoulder = keys.With("shoulders").Child("shoulders").Child(left ? "left" : "right");
  const CubicTable width = ReadTable(shoulder, "width_m", "widths", "width_m", IfAbsent::kDefault);
  const Material& paving = context.MaterialOf(shoulder, "material", "asphalt");
  CubicTable fall = left ? falls.left : falls.right;
  if (const auto own = shoulder.OptionalNumber("fall")) fall = Constant(*own);
  if (!width.zero()) side.push_back(MakeStrip(LaneType::kShoulder, width, paving, std::move(fall)));
  const DeclaredMap verge = keys.With("verge").Child("verge");
  const CubicTable grass_width = ReadTable(verge, "width_m", "widths", "width_m", IfAbsent::kDefault);
  const Material& grass = context.MaterialOf(verge, "material", "grass");
  const double verge_fall = verge.Number("fall");
  if (!grass_width.zero()) side.push_back(MakeStrip(LaneType::kNone, grass_width, grass, Constant(verge_fall)));
}

// Numbers, heights and the surface across.
void Lay(std::vector<Strip>& side, bool left, bool left_hand, network::LaneSection& section,
         network::CrossSectionSurface& surface) {
  double raised = 0.0;
  int id = 0;
  for (Strip& strip : side) {
    id += left ? 1 : -1;
    raised += strip.kerb_m;
    strip.lane.id = id;
    if (strip.lane.type == LaneType::kShoulder || strip.lane.type == LaneType::kNone) {
      if (strip.lane.direction == 1) strip.lane.direction = left == left_hand ? 1 : -1;
    }
    if (raised != 0.0) strip.lane.heights.push_back({0.0, raised, raised});
    network::SurfaceStrip across;
    across.relative = true;
    across.has_width = true;
    across.width = strip.lane.width;
    across.coefficients[1] = Sum({}, strip.fall, -1.0);
    (left ? surface.left : surface.right).push_back(std::move(across));
    (left ? section.left : section.right).push_back(std::move(strip.lane));
  }
}

void ReadEarthwork(const Keys& keys, network::Earthwork& earthwork) {
  const DeclaredMap slopes = keys.With("slopes").Child("slopes");
  earthwork.cut = slopes.Number("cut");
  earthwork.fill = slopes.Number("fill");
  earthwork.reach_m = slopes.Number("reach_m");
}

Keys FindKeys(const DeclaredMap& road, const Context& context) {
  const DeclaredMap section = road.Child("section");
  const std::string name = section.Text("template", "");
  if (name.empty())
    return {section, DeclaredMap(section.MapWith("template").OptionalChild("template"), TemplateKeys())};
  const auto found = context.templates.find(name);
  if (found != context.templates.end()) {
    // A road may say all of a template's keys itself: they are known even where none asks for them.
    const Map other = found->second.Child(name);
    std::vector<std::string> known;
    for (const config::Key& key : TemplateKeys()) known.push_back(key.name);
    for (const std::string& key : other.Keys()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        other.Problem(key, "config.unknown_name",
                      fmt::format("'{}' is no key of a template{}", key, base::DidYouMean(key, known)));
      }
    }
    return {section, DeclaredMap(other, TemplateKeys())};
  }
  std::vector<std::string> names;
  for (const auto& [known, map] : context.templates) names.push_back(known);
  section.map().Problem("template", "config.unknown_name",
                        fmt::format("there is no template '{}'{}", name, base::DidYouMean(name, names)));
  constexpr std::string_view kUsual = "rural";  // what is missing for want of it is not told
  return {section, DeclaredMap(context.templates.find(std::string(kUsual))->second.Child(kUsual), TemplateKeys())};
}

}  // namespace

void ReadSection(const DeclaredMap& road, Context& context, double length_m, network::RoadSpec& spec) {
  const Keys keys = FindKeys(road, context);
  const Falls falls = ReadFalls(keys);
  Sides sides = ReadLanes(keys, context, falls);
  spec.left_hand = context.left_hand;
  spec.lane_offset = ReadTable(keys.With(keys.Has("offset_m") ? "offset_m" : "offsets"), "offset_m", "offsets", "t_m",
                               IfAbsent::kDefault);
  spec.lateral.surface.t_offset = spec.lane_offset;
  network::LaneSection section;
  for (const bool left : {true, false}) {
    std::vector<Strip> side;
    for (int id = left ? 1 : -1; sides.contains(id); id += left ? 1 : -1) side.push_back(std::move(sides[id]));
    AddBorders(keys, left, context, falls, side);
    Lay(side, left, context.left_hand, section, spec.lateral.surface);
  }
  spec.sections.assign(1, std::move(section));
  spec.earthwork.emplace();
  ReadEarthwork(keys, *spec.earthwork);
  if (road.map().Has("lines"))
    ReadLines(road, false, length_m, spec);
  else
    ReadLines(keys.With("lines"), !keys.own.map().Has("lines"), length_m, spec);
}

CubicTable EdgeOf(const network::RoadSpec& spec, int lane) {
  CubicTable edge = spec.lane_offset;
  const auto& side = lane > 0 ? spec.sections[0].left : spec.sections[0].right;
  for (int i = 0; i < std::abs(lane); ++i)
    edge = Sum(edge, side[static_cast<std::size_t>(i)].width, lane > 0 ? 1.0 : -1.0);
  return edge;
}

}  // namespace rodeira::design
