// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <numeric>

#include "common/core/base/suggest.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

using network::Lane;
using network::LaneSection;

constexpr int kMaxMissing = 100;

double OffsetOf(const Node& node) { return node.xml().attribute("sOffset").as_double(0.0); }

// The first of a lane's records that stands behind one of a larger sOffset; null where none does.
const Node* OutOfOrder(const std::vector<Node>& nodes) {
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (OffsetOf(nodes[i]) < OffsetOf(nodes[i - 1])) return &nodes[i];
  }
  return nullptr;
}

Repair RecordsInOrder(const std::vector<Node>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return OffsetOf(nodes[a]) < OffsetOf(nodes[b]); });
  return {RepairKind::kSorted, "they are read in the order of sOffset", Reorder(nodes, order)};
}

template <class Record, class Read>
std::vector<Record> ReadRecords(const Node& lane, const char* element, double section_s_m, const Read& read) {
  std::vector<Record> records;
  const std::vector<Node> nodes = lane.Children(element);
  if (const Node* behind = OutOfOrder(nodes)) {
    behind->Wrong(fmt::format("road.lane.{}.elem_asc_order", element),
                  fmt::format("<{}> elements were expected in ascending order of sOffset", element),
                  RecordsInOrder(nodes));
  }
  for (const Node& node : nodes) {
    Record record = read(node);
    record.s_m = section_s_m + node.Number("sOffset", 0.0);
    if (!records.empty() && record.s_m < records.back().s_m) continue;  // said above
    if (!records.empty() && record.s_m == records.back().s_m)
      records.back() = std::move(record);  // the last one counts
    else
      records.push_back(std::move(record));
  }
  return records;
}

network::LaneAccess ReadAccess(const Node& node) {
  network::LaneAccess access;
  access.rule = node.Text("rule", "");
  if (node.Has("restriction")) access.restrictions.push_back(node.Text("restriction", ""));
  for (const Node& restriction : node.Children("restriction"))
    access.restrictions.push_back(restriction.Text("type", ""));
  return access;
}

// At one place several may stand, one for each of those that the rule is for.
std::vector<network::LaneAccess> ReadAccesses(const Node& lane, double section_s_m) {
  std::vector<network::LaneAccess> all;
  for (const Node& node : lane.Children("access")) {
    network::LaneAccess access = ReadAccess(node);
    access.s_m = section_s_m + node.Number("sOffset", 0.0);
    if (all.empty() || access.s_m > all.back().s_m) {
      all.push_back(std::move(access));
    } else if (access.s_m < all.back().s_m) {
      node.Wrong("road.lane.access.elem_asc_order", "<access> elements were expected in ascending order of sOffset",
                 RecordsInOrder(lane.Children("access")));
    } else if (access.rule == all.back().rule) {
      all.back().restrictions.insert(all.back().restrictions.end(), access.restrictions.begin(),
                                     access.restrictions.end());
    } else {
      const Source::Where& where = node.source().where;
      node.source().warnings.push_back(
          {"road.lane.access.no_mix_of_deny_or_allow",
           fmt::format("at one place the lane has a rule '{}' and a rule '{}': the second counts", all.back().rule,
                       access.rule),
           node.line(), where.road, where.lane, access.s_m});
      all.back() = std::move(access);
    }
  }
  return all;
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

// What the lanes of a section have in common.
struct Around {
  double section_s_m = 0.0;
  bool left_hand = false;
  bool offset = false;  // the centre lane lies beside the reference line
};

void Warn(const Node& node, std::string_view rule, std::string message) {
  const Source::Where& where = node.source().where;
  node.source().warnings.push_back(
      {std::string(rule), std::move(message), node.line(), where.road, where.lane, where.s_m});
}

// Whether the first number of a border that is not 0 is above it, and none of its places at the records' beginnings
// lies below 0.
bool IsPositive(const std::vector<geometry::Cubic>& records) {
  if (std::any_of(records.begin(), records.end(), [](const geometry::Cubic& r) { return r.a < 0.0; })) return false;
  for (const geometry::Cubic& r : records) {
    for (const double number : {r.a, r.b, r.c, r.d}) {
      if (number != 0.0) return number > 0.0;
    }
  }
  return false;
}

// A border's records are t of the outer edge. Files exist that count them positive on the right side too, where no lane
// can lie while the centre lane lies on the reference line.
geometry::CubicTable ReadBorder(const Node& lane, const Around& around, bool right) {
  geometry::CubicTable table =
      ReadCubics(lane.Children("border"), "sOffset", around.section_s_m, "road.lane.border.elem_asc_order");
  if (!right || around.offset || !IsPositive(table.records())) return table;
  Warn(lane.Child("border"), "road.lane.border",
       "the border of a lane on the right lies to the left of the reference line: it is read with its sign turned");
  std::vector<geometry::Cubic> turned = table.records();
  for (geometry::Cubic& record : turned) record = {record.from, -record.a, -record.b, -record.c, -record.d};
  return geometry::CubicTable(turned);
}

void ReadLinks(const Node& node, Lane& lane) {
  for (const Node& link : node.Child("link").Children("predecessor")) lane.predecessors.push_back(link.Integer("id"));
  for (const Node& link : node.Child("link").Children("successor")) lane.successors.push_back(link.Integer("id"));
}

constexpr const char *kLeft = "rodeira:left", *kRight = "rodeira:right";  // a neighbour on another road
constexpr const char* kTraffic = "rodeira:traffic";  // whether vehicles begin on the lane, or end there

void ReadTraffic(const Node& node, Lane& lane) {
  for (const Node& data : node.Children("userData")) {
    if (data.Text("code", "") != kTraffic) continue;
    const std::string what = data.Text("value", "");
    if (what == "begins")
      lane.traffic_begins = true;
    else if (what == "ends")
      lane.traffic_ends = true;
    else
      data.Wrong("rodeira.traffic",
                 fmt::format("of the lane's traffic '{}' was found; 'begins' or 'ends' was expected", what));
  }
}

// On which side another road's lane lies beside this one: "-1 12", lane and road.
void ReadBeside(const Node& node, Lane& lane) {
  for (const Node& data : node.Children("userData")) {
    const std::string code = data.Text("code", "");
    if (code != kLeft && code != kRight) continue;
    const std::string what = data.Text("value", "");
    network::LaneName name;
    const auto [end, problem] = std::from_chars(what.data(), what.data() + what.size(), name.lane);
    const auto blank = static_cast<std::size_t>(end - what.data());
    if (problem != std::errc() || name.lane == 0 || blank + 1 >= what.size() || what[blank] != ' ') {
      data.Wrong("rodeira.beside",
                 fmt::format("as the lane beside '{}' was found; a lane and its road ('-1 12') were expected", what));
      continue;
    }
    name.road = what.substr(blank + 1);
    (code == kLeft ? lane.left_beside : lane.right_beside) = name;
  }
}

Repair TypeRepair(const Node& node, const std::string& type) {
  const std::string nearest = base::NearestName(type, network::LaneTypeNames());
  const std::string read_as = nearest.empty() ? "none" : nearest;
  return {RepairKind::kValueReplaced, fmt::format("it is read as '{}'", read_as), {node.Set("type", read_as)}};
}

Repair WithoutWidth(const Node& node) {
  Repair repair{RepairKind::kWidthDropped, "it is passed over", {}};
  for (const char* record : {"width", "border"}) {
    for (const Node& each : node.Children(record)) repair.edits.push_back(each.Remove());
  }
  return repair;
}

// A lane with an id that is not the next one: a second one of an id is passed over, and an id that is left out is that
// of a lane without width.
Repair IdRepair(const Node& group, const Lane& lane, int expected) {
  if (std::abs(lane.id) < std::abs(expected)) {
    std::vector<Node> same;
    for (const Node& node : group.Children("lane")) {
      if (node.xml().attribute("id").as_int() == lane.id) same.push_back(node);
    }
    return {RepairKind::kDuplicateDropped, "the first of them counts", {same.back().Remove()}};
  }
  std::string missing;
  for (int id = expected; std::abs(id) < std::abs(lane.id) && std::abs(id - expected) < kMaxMissing;
       id += id > 0 ? 1 : -1)
    missing += fmt::format(
        "<lane id=\"{}\" type=\"none\" level=\"false\"><width sOffset=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
        id);
  return {RepairKind::kLaneAdded, "a lane without width takes each id that is left out", {group.Append(missing)}};
}

Lane ReadLane(const Node& node, const Around& around) {
  const double section_s_m = around.section_s_m;
  Lane lane;
  lane.id = node.Integer("id");
  Within within(node.source());
  node.source().where.lane = lane.id;
  const std::string type = node.Text("type", "none");
  if (const auto known = network::LaneTypeByName(type))
    lane.type = *known;
  else
    node.Wrong("road.lane.type",
               fmt::format("the lane's type is '{}'{}", type, base::DidYouMean(type, network::LaneTypeNames())),
               TypeRepair(node, type));
  lane.level = node.Flag("level", false);
  lane.direction = (lane.id < 0) == around.left_hand ? -1 : 1;
  const std::string direction = node.Text("direction", "standard");
  if (direction == "reversed") lane.direction = -lane.direction;
  if (direction == "both" || lane.type == network::LaneType::kBidirectional) lane.direction = 0;
  lane.width = ReadCubics(node.Children("width"), "sOffset", section_s_m, "road.lane.width.elem_asc_order");
  lane.border = ReadBorder(node, around, lane.id < 0);
  if (!lane.width.empty() && !lane.border.empty())
    Warn(node, "road.lane.border.exclusive_width_border", "the lane has both <width> and <border>: its widths count");
  lane.heights = ReadRecords<network::LaneHeight>(node, "height", section_s_m, [](const Node& height) {
    return network::LaneHeight{0.0, height.Number("inner"), height.Number("outer")};
  });
  lane.marks = ReadRecords<network::RoadMark>(node, "roadMark", section_s_m,
                                              [&](const Node& mark) { return ReadMark(mark, section_s_m); });
  lane.speeds = ReadRecords<network::SpeedLimit>(node, "speed", section_s_m, [](const Node& speed) {
    return network::SpeedLimit{0.0, ReadSpeed(speed, "max").value_or(std::numeric_limits<double>::infinity())};
  });
  lane.materials = ReadRecords<network::LaneMaterial>(node, "material", section_s_m, ReadMaterial);
  lane.access = ReadAccesses(node, section_s_m);
  ReadTraffic(node, lane);
  ReadBeside(node, lane);
  ReadLinks(node, lane);
  if (lane.id == 0 && (!lane.width.empty() || !lane.border.empty())) {
    node.Wrong("road.lane.center_lane_no_width", "the centre lane has a width; none was expected", WithoutWidth(node));
  }
  return lane;
}

// The lanes of one side from inside outward, their ids without gaps.
std::vector<Lane> ReadSide(const Node& section_node, const char* side, const Around& around) {
  std::vector<Lane> lanes;
  const bool left = std::string_view(side) == "left";
  for (const Node& group : section_node.Children(side)) {
    for (const Node& node : group.Children("lane")) {
      Lane lane = ReadLane(node, around);
      if (lane.id == 0 || (lane.id > 0) != left) {
        node.Wrong("road.lane.id",
                   fmt::format("a lane on the {} has the id {}; one {} 0 was expected", side, lane.id,
                               left ? "above" : "below"),
                   {RepairKind::kLaneDropped, "the lane is passed over", {node.Remove()}});
        continue;
      }
      lanes.push_back(std::move(lane));
    }
  }
  std::stable_sort(lanes.begin(), lanes.end(),
                   [](const Lane& a, const Lane& b) { return std::abs(a.id) < std::abs(b.id); });
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const int expected = (left ? 1 : -1) * static_cast<int>(i + 1);
    if (lanes[i].id == expected) continue;
    section_node.Wrong(
        "road.lane.id",
        fmt::format("lane {} was expected on the {}, and lane {} found; ids are counted from the centre without gaps",
                    expected, side, lanes[i].id),
        IdRepair(section_node.Child(side), lanes[i], expected));
    lanes.resize(i);
  }
  const auto wide = std::find_if(lanes.begin(), lanes.end(), [](const Lane& lane) { return !lane.width.empty(); });
  const auto bordered = std::find_if(lanes.begin(), lanes.end(), [](const Lane& lane) { return lane.bordered(); });
  if (wide != lanes.end() && bordered != lanes.end()) {
    Warn(section_node, "road.lane.border.exclusive_width_border",
         fmt::format("on the {} lane {} has a <width> and lane {} a <border>: each is read by what it has", side,
                     wide->id, bordered->id));
  }
  return lanes;
}

// Borders are t of the road; what a lane offset beside them means is not said.
void TellBorders(const Node& section_node, const LaneSection& section, const Around& around) {
  if (!around.offset) return;
  for (const auto* side : {&section.left, &section.right}) {
    for (const Lane& lane : *side) {
      if (!lane.bordered()) continue;
      return Warn(
          section_node, "road.lane.border.exclusive_offset_border",
          fmt::format("lane {} has a <border>, and the road a <laneOffset>: it moves the centre lane, and no border",
                      lane.id));
    }
  }
}

}  // namespace

namespace {

Repair OneCentre(const std::vector<Node>& centres) {
  Repair repair{RepairKind::kDuplicateDropped, "the first counts", {}};
  if (centres.empty()) repair.kind = RepairKind::kCentreLaneAdded, repair.done = "one without marks is read";
  for (std::size_t i = 1; i < centres.size(); ++i) repair.edits.push_back(centres[i].Remove());
  return repair;
}

// Sections by s; of several at one s the last counts.
Repair SectionsInOrder(const std::vector<Node>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto s = [&](std::size_t i) { return nodes[i].xml().attribute("s").as_double(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return s(a) < s(b); });
  Repair repair{RepairKind::kSorted, "they are read in the order of s", Reorder(nodes, order)};
  if (!repair.edits.empty()) return repair;
  repair.kind = RepairKind::kDuplicateDropped, repair.done = "of sections at one s the last counts";
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (s(i) == s(i + 1)) repair.edits.push_back(nodes[i].Remove());
  }
  return repair;
}

}  // namespace

std::optional<double> ReadSpeed(const Node& speed, const char* attribute) {
  const std::string text = speed.Text(attribute, "");
  if (text.empty() || text == "undefined") return std::nullopt;
  if (text == "no limit") return std::numeric_limits<double>::infinity();
  const std::string unit = speed.Text("unit", "m/s");
  const double factor = unit == "km/h" ? 1.0 / 3.6 : unit == "mph" ? 0.44704 : 1.0;
  if (unit != "m/s" && unit != "km/h" && unit != "mph")
    speed.Wrong("road.lane.speed", fmt::format("the unit is '{}'; m/s, km/h or mph was expected", unit),
                {RepairKind::kValueReplaced, "it is read as m/s"});
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
    const Around around{section.s_m, spec.left_hand, !spec.lane_offset.zero()};
    section.left = ReadSide(node, "left", around);
    section.right = ReadSide(node, "right", around);
    const auto centres = node.Child("center").Children("lane");
    if (centres.size() != 1)
      node.Wrong("road.lane.center_lane",
                 fmt::format("a lane section has {} centre lanes; one was expected", centres.size()),
                 OneCentre(centres));
    else
      section.centre = ReadLane(centres[0], around);
    TellBorders(node, section, around);
    if (!spec.sections.empty() && section.s_m <= spec.sections.back().s_m) {
      node.Wrong("road.lane.lane_section.elem_asc_order",
                 fmt::format("a <laneSection> of s {:.6g} stands behind one of s {:.6g}; ascending order was expected",
                             section.s_m, spec.sections.back().s_m),
                 SectionsInOrder(lanes.Children("laneSection")));
      continue;
    }
    spec.sections.push_back(std::move(section));
    lines.sections.push_back(node.line());
    lines.section_nodes.push_back(node.xml());
  }
  if (spec.sections.empty()) {
    road.Wrong("road.lane.lane_section.one", "the road has no lane section");
    spec.sections.emplace_back();
    lines.sections.push_back(road.line());
    lines.section_nodes.push_back({});
  }
}

}  // namespace rodeira::opendrive
