#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "common/base/suggest.hpp"
#include "common/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

using network::Lane;
using network::LaneSection;

template <class Record, class Read>
std::vector<Record> ReadRecords(const Node& lane, const char* element, double section_s_m, const Read& read) {
  std::vector<Record> records;
  for (const Node& node : lane.Children(element)) {
    Record record = read(node);
    record.s_m = section_s_m + node.Number("sOffset", 0.0);
    if (!records.empty() && record.s_m < records.back().s_m) {
      node.Wrong(fmt::format("road.lane.{}.elem_asc_order", element),
                 fmt::format("<{}> elements were expected in ascending order of sOffset", element));
      continue;
    }
    if (!records.empty() && record.s_m == records.back().s_m) records.back() = std::move(record);  // the last one counts
    else records.push_back(std::move(record));
  }
  return records;
}

network::LaneAccess ReadAccess(const Node& node) {
  network::LaneAccess access;
  access.rule = node.Text("rule", "");
  if (node.Has("restriction")) access.restrictions.push_back(node.Text("restriction", ""));
  for (const Node& restriction : node.Children("restriction")) access.restrictions.push_back(restriction.Text("type", ""));
  return access;
}

network::LaneMaterial ReadMaterial(const Node& node) {
  network::LaneMaterial material;
  material.surface = node.Text("surface", "");
  if (node.Has("friction")) material.friction = node.Number("friction");
  if (node.Has("roughness")) material.roughness = node.Number("roughness");
  if (material.friction && *material.friction < 0.0)
    node.Wrong("road.lane.material", fmt::format("a friction of {} was found", *material.friction));
  return material;
}

// A border's records are t of the outer edge. Files exist that count them positive on the right side too.
geometry::CubicTable ReadBorder(const Node& lane, double section_s_m, bool right) {
  geometry::CubicTable table = ReadCubics(lane.Children("border"), "sOffset", section_s_m, "road.lane.border.elem_asc_order");
  if (!right || table.empty() || table.records().front().a <= 0.0) return table;
  std::vector<geometry::Cubic> turned = table.records();
  for (geometry::Cubic& record : turned) record = {record.from, -record.a, -record.b, -record.c, -record.d};
  return geometry::CubicTable(turned);
}

void ReadLinks(const Node& node, Lane& lane) {
  for (const Node& link : node.Child("link").Children("predecessor")) lane.predecessors.push_back(link.Integer("id"));
  for (const Node& link : node.Child("link").Children("successor")) lane.successors.push_back(link.Integer("id"));
}

Lane ReadLane(const Node& node, double section_s_m, bool left_hand) {
  Lane lane;
  lane.id = node.Integer("id");
  Within within(node.source());
  node.source().where.lane = lane.id;
  const std::string type = node.Text("type", "none");
  if (const auto known = network::LaneTypeByName(type)) lane.type = *known;
  else
    node.Wrong("road.lane.type",
               fmt::format("the lane's type is '{}'{}", type, base::DidYouMean(type, network::LaneTypeNames())));
  lane.level = node.Flag("level", false);
  lane.direction = (lane.id < 0) == left_hand ? -1 : 1;
  const std::string direction = node.Text("direction", "standard");
  if (direction == "reversed") lane.direction = -lane.direction;
  if (direction == "both" || lane.type == network::LaneType::kBidirectional) lane.direction = 0;
  lane.width = ReadCubics(node.Children("width"), "sOffset", section_s_m, "road.lane.width.elem_asc_order");
  lane.border = ReadBorder(node, section_s_m, lane.id < 0);
  lane.heights = ReadRecords<network::LaneHeight>(node, "height", section_s_m, [](const Node& height) {
    return network::LaneHeight{0.0, height.Number("inner"), height.Number("outer")};
  });
  lane.marks = ReadRecords<network::RoadMark>(node, "roadMark", section_s_m,
                                              [&](const Node& mark) { return ReadMark(mark, section_s_m); });
  lane.speeds = ReadRecords<network::SpeedLimit>(node, "speed", section_s_m, [](const Node& speed) {
    return network::SpeedLimit{0.0, ReadSpeed(speed, "max").value_or(std::numeric_limits<double>::infinity())};
  });
  lane.materials = ReadRecords<network::LaneMaterial>(node, "material", section_s_m, ReadMaterial);
  lane.access = ReadRecords<network::LaneAccess>(node, "access", section_s_m, ReadAccess);
  ReadLinks(node, lane);
  if (lane.id == 0 && (!lane.width.empty() || !lane.border.empty())) {
    node.Wrong("road.lane.center_lane_no_width", "the centre lane has a width; none was expected");
  }
  return lane;
}

// The lanes of one side from inside outward, their ids without gaps.
std::vector<Lane> ReadSide(const Node& section_node, const char* side, double section_s_m, bool left_hand) {
  std::vector<Lane> lanes;
  const bool left = std::string_view(side) == "left";
  for (const Node& group : section_node.Children(side)) {
    for (const Node& node : group.Children("lane")) {
      Lane lane = ReadLane(node, section_s_m, left_hand);
      if (lane.id == 0 || (lane.id > 0) != left) {
        node.Wrong("road.lane.id",
                   fmt::format("a lane on the {} has the id {}; one {} 0 was expected", side, lane.id, left ? "above" : "below"));
        continue;
      }
      lanes.push_back(std::move(lane));
    }
  }
  std::stable_sort(lanes.begin(), lanes.end(), [](const Lane& a, const Lane& b) { return std::abs(a.id) < std::abs(b.id); });
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const int expected = (left ? 1 : -1) * static_cast<int>(i + 1);
    if (lanes[i].id == expected) continue;
    section_node.Wrong(
        "road.lane.id",
        fmt::format("lane {} was expected on the {}, and lane {} found; ids are counted from the centre without gaps", expected,
                    side, lanes[i].id));
    lanes.resize(i);
  }
  return lanes;
}

}  // namespace

std::optional<double> ReadSpeed(const Node& speed, const char* attribute) {
  const std::string text = speed.Text(attribute, "");
  if (text.empty() || text == "undefined") return std::nullopt;
  if (text == "no limit") return std::numeric_limits<double>::infinity();
  const std::string unit = speed.Text("unit", "m/s");
  const double factor = unit == "km/h" ? 1.0 / 3.6 : unit == "mph" ? 0.44704 : 1.0;
  if (unit != "m/s" && unit != "km/h" && unit != "mph")
    speed.Wrong("road.lane.speed", fmt::format("the unit is '{}'; m/s, km/h or mph was expected", unit));
  const double value = speed.Number(attribute) * factor;
  // A limit below 0 is how some tools say that there is none.
  return value < 0.0 ? std::numeric_limits<double>::infinity() : value;
}

void ReadLanes(const Node& road, network::RoadSpec& spec, RoadLines& lines) {
  const Node lanes = road.Child("lanes");
  spec.lane_offset = ReadCubics(lanes.Children("laneOffset"), "s", 0.0, "road.lane_offset.elem_asc_order");
  for (const Node& node : lanes.Children("laneSection")) {
    Within within(node.source());
    LaneSection section;
    section.s_m = node.Number("s");
    node.source().where.s_m = section.s_m;
    section.single_side = node.Flag("singleSide", false);
    section.left = ReadSide(node, "left", section.s_m, spec.left_hand);
    section.right = ReadSide(node, "right", section.s_m, spec.left_hand);
    const auto centres = node.Child("center").Children("lane");
    if (centres.size() != 1)
      node.Wrong("road.lane.center_lane", fmt::format("a lane section has {} centre lanes; one was expected", centres.size()));
    else section.centre = ReadLane(centres[0], section.s_m, spec.left_hand);
    if (!spec.sections.empty() && section.s_m <= spec.sections.back().s_m) {
      node.Wrong("road.lane.lane_section.elem_asc_order",
                 fmt::format("a <laneSection> of s {:.6g} stands behind one of s {:.6g}; ascending order was expected",
                             section.s_m, spec.sections.back().s_m));
      continue;
    }
    spec.sections.push_back(std::move(section));
    lines.sections.push_back(node.line());
  }
  if (spec.sections.empty()) {
    road.Wrong("road.lane.lane_section.one", "the road has no lane section");
    spec.sections.emplace_back();
    lines.sections.push_back(road.line());
  }
}

}  // namespace rodeira::opendrive
