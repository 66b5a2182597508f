// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/core/base/suggest.hpp"
#include "common/world/network/sign_kinds.hpp"
#include "common/world/opendrive/measures.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

std::vector<network::LaneValidity> ReadValidity(const Node& node) {
  std::vector<network::LaneValidity> validity;
  for (const Node& range : node.Children("validity")) {
    const int from = range.Integer("fromLane"), to = range.Integer("toLane");
    validity.push_back({std::min(from, to), std::max(from, to)});
  }
  return validity;
}

// A sign of another catalogue, or a limit without its number, is no error: a plate stands there that cannot be read.
void CheckSign(const Node& node, const network::Signal& signal) {
  constexpr double kFlat_m = 0.05;  // what is no higher is paint
  const bool painted = signal.type == "1000003" || (signal.height_m > 0.0 && signal.height_m <= kFlat_m);
  if (signal.dynamic || painted || signal.type.empty() || signal.type == "-1" || network::IsBoard(signal)) return;
  const auto kind = network::SignKindOf(signal);
  if (kind && (*kind != "speed_limit" || !network::SignNumberOf(signal).empty())) return;
  const std::string what = kind ? "says no limit"
                                : fmt::format("is none that is known (type '{}', subtype '{}', country '{}')",
                                              signal.type, signal.subtype, signal.country);
  Source& source = node.source();
  source.warnings.push_back({"road.signal.type",
                             fmt::format("the sign '{}' {}: it is drawn as a grey plate", signal.id, what), node.line(),
                             source.where.road, source.where.lane, source.where.s_m});
}

void ReadSeen(const Node& node, network::Signal& signal) {
  for (const Node& at : node.Children("positionRoad")) {
    signal.seen = network::SeenAtRoad{
        at.Text("roadId"),         at.Number("s"),          at.Number("t"),        at.Number("zOffset", 0.0),
        at.Number("hOffset", 0.0), at.Number("pitch", 0.0), at.Number("roll", 0.0)};
  }
  for (const Node& at : node.Children("positionInertial")) {
    signal.seen = network::SeenInWorld{at.Number("x"),        at.Number("y"),          at.Number("z"),
                                       at.Number("hdg", 0.0), at.Number("pitch", 0.0), at.Number("roll", 0.0)};
  }
}

// What a signal says of itself, wherever it stands.
void ReadSign(const Node& node, network::Signal& signal) {
  signal.id = node.Text("id");
  signal.name = node.Text("name", "");
  signal.dynamic = node.Flag("dynamic", false);
  signal.country = node.Text("country", "");
  signal.type = node.Text("type", "-1");
  signal.subtype = node.Text("subtype", "-1");
  signal.unit = node.Text("unit", "");
  signal.text = node.Text("text", "");
  if (node.Has("value") && !node.Text("value", "").empty()) signal.value = node.Number("value");
  signal.height_m = node.Number("height", 0.0);
  signal.width_m = node.Number("width", 0.0);
  if (auto validity = ReadValidity(node); !validity.empty()) signal.validity = std::move(validity);
  std::vector<std::string> depends_on;
  for (const char* name : {"dependency", "signalDependency"}) {
    for (const Node& dependency : node.Children(name)) depends_on.push_back(dependency.Text("id"));
  }
  if (!depends_on.empty()) signal.depends_on = std::move(depends_on);
  for (const Node& semantics : node.Children("semantics")) {
    for (const Node& priority : semantics.Children("priority")) signal.priority = priority.Text("type", "");
  }
}

network::Signal ReadSignal(const Node& node) {
  network::Signal signal;
  ReadSign(node, signal);
  signal.s_m = node.Number("s");
  signal.t_m = node.Number("t");
  signal.z_offset_m = node.Number("zOffset", 0.0);
  signal.orientation = node.Text("orientation", "none");
  signal.h_offset_rad = node.Number("hOffset", 0.0);
  signal.pitch_rad = node.Number("pitch", 0.0);
  signal.roll_rad = node.Number("roll", 0.0);
  ReadSeen(node, signal);
  return signal;
}

constexpr double kUsualSign_m = 0.6;  // on a board, where a file says no measures

// What lies on a board has the board's place and its addressees unless it says so itself.
network::Signal OnBoard(const Node& node, const network::Signal& board) {
  network::Signal sign;
  sign.s_m = board.s_m, sign.t_m = board.t_m, sign.z_offset_m = board.z_offset_m;
  sign.orientation = board.orientation, sign.h_offset_rad = board.h_offset_rad, sign.pitch_rad = board.pitch_rad,
  sign.roll_rad = board.roll_rad;
  sign.seen = board.seen, sign.validity = board.validity, sign.depends_on = board.depends_on;
  sign.board = board.id, sign.board_left_m = node.Number("v", 0.0), sign.board_up_m = node.Number("z", 0.0);
  return sign;
}

// A signal's boards: each sign and each display on them as a signal of its own. A board without measures is as large as
// what is on it.
std::vector<network::Signal> ReadBoards(const Node& node, network::Signal& signal) {
  std::vector<network::Signal> on;
  for (const Node& board : node.Children("staticBoard")) {
    for (const Node& each : board.Children("sign")) {
      network::Signal sign = OnBoard(each, signal);
      ReadSign(each, sign);
      CheckSign(each, sign);
      on.push_back(std::move(sign));
    }
  }
  const std::vector<Node> displays = node.Children("vmsBoard");
  for (std::size_t i = 0; i < displays.size(); ++i) {
    network::Signal display = OnBoard(displays[i], signal);
    display.id = fmt::format("{}/{}", signal.id, i + 1);
    display.type = network::kDisplay;
    display.dynamic = true;
    display.width_m = displays[i].Number("displayWidth", 0.0),
    display.height_m = displays[i].Number("displayHeight", 0.0);
    const bool whole = signal.type == network::kDisplay && displays.size() == 1;  // the signal is the display
    if (!whole)
      on.push_back(std::move(display));
    else if (!(signal.width_m > 0.0 && signal.height_m > 0.0))
      signal.width_m = display.width_m, signal.height_m = display.height_m;
  }
  if (on.empty() || (signal.width_m > 0.0 && signal.height_m > 0.0)) return on;
  for (const network::Signal& each : on) {
    signal.width_m = std::max(signal.width_m,
                              2.0 * std::fabs(each.board_left_m) + (each.width_m > 0.0 ? each.width_m : kUsualSign_m));
    signal.height_m = std::max(signal.height_m, each.board_up_m + (each.height_m > 0.0 ? each.height_m : kUsualSign_m));
  }
  return on;
}

void WarnOf(const Node& node, std::string_view rule, std::string message) {
  const Source::Where& where = node.source().where;
  node.source().warnings.push_back(
      {std::string(rule), std::move(message), node.line(), where.road, where.lane, where.s_m});
}

network::Repeat ReadRepeat(const Node& node) {
  network::Repeat repeat;
  repeat.s_m = node.Number("s");
  repeat.length_m = node.Number("length");
  repeat.distance_m = node.Number("distance", 0.0);
  repeat.t_start_m = node.Number("tStart", 0.0);
  repeat.t_end_m = node.Number("tEnd", 0.0);
  repeat.z_start_m = node.Number("zOffsetStart", 0.0);
  repeat.z_end_m = node.Number("zOffsetEnd", 0.0);
  repeat.height_start_m = node.Number("heightStart", 0.0);
  repeat.height_end_m = node.Number("heightEnd", 0.0);
  repeat.width_start_m = node.Number("widthStart", 0.0);
  repeat.width_end_m = node.Number("widthEnd", 0.0);
  repeat.length_start_m = node.Number("lengthStart", 0.0);
  repeat.length_end_m = node.Number("lengthEnd", 0.0);
  repeat.radius_start_m = node.Number("radiusStart", 0.0);
  repeat.radius_end_m = node.Number("radiusEnd", 0.0);
  repeat.straight = node.Flag("detachFromReferenceLine", false);
  if (repeat.distance_m > 0.0 && repeat.distance_m < kShortestDistance_m) {
    WarnOf(
        node, "road.object.repeat.distance",
        fmt::format("<repeat> has a distance of {:.6g} m; 0 or at least {:.6g} m was expected: it goes on without gaps",
                    repeat.distance_m, kShortestDistance_m));
    repeat.distance_m = 0.0;
  }
  return repeat;
}

network::Outline ReadOutline(const Node& node) {
  network::Outline outline;
  outline.id = node.Text("id", "");
  outline.closed = node.Flag("closed", true);
  outline.fill = node.Text("fillType", "");
  for (const Node& corner : node.Children("cornerRoad")) {
    outline.corners.push_back({false, corner.Number("s"), corner.Number("t"), corner.Number("dz", 0.0),
                               corner.Number("height", 0.0), corner.Text("id", "")});
  }
  for (const Node& corner : node.Children("cornerLocal")) {
    outline.corners.push_back({true, corner.Number("u"), corner.Number("v"), corner.Number("z", 0.0),
                               corner.Number("height", 0.0), corner.Text("id", "")});
  }
  return outline;
}

// A mark on a side or at a corner that the object has not is no error: it is said, and not painted.
void ReadMarks(const Node& node, network::Object& object) {
  static const std::vector<std::string> kSides = {"left", "right", "front", "rear"};
  Source& source = node.source();
  const auto warn = [&](const Node& mark, const std::string& what) {
    source.warnings.push_back({"road.object.marking",
                               fmt::format("a mark of the object '{}' {}: it is not painted", object.id, what),
                               mark.line(), source.where.road, source.where.lane, source.where.s_m});
  };
  for (const Node& markings : node.Children("markings")) {
    for (const Node& each : markings.Children("marking")) {
      network::ObjectMark mark;
      mark.side = each.Text("side", "");
      for (const Node& corner : each.Children("cornerReference")) mark.corners.push_back(corner.Text("id"));
      mark.colour = each.Text("color", "white");
      mark.width_m = each.Number("width", 0.1);
      mark.stroke_m = each.Number("lineLength", 0.0);
      mark.gap_m = each.Number("spaceLength", 0.0);
      mark.start_offset_m = each.Number("startOffset", 0.0);
      mark.stop_offset_m = each.Number("stopOffset", 0.0);
      const bool sized = mark.width_m > 0.0 && mark.stroke_m >= 0.0 && mark.gap_m >= 0.0 &&
                         mark.start_offset_m >= 0.0 && mark.stop_offset_m >= 0.0;
      const auto has_corner = [&](const std::string& id) {
        return !object.outlines.empty() &&
               std::any_of(object.outlines.front().corners.begin(), object.outlines.front().corners.end(),
                           [&](const network::Corner& corner) { return corner.id == id; });
      };
      const auto lost = std::find_if_not(mark.corners.begin(), mark.corners.end(), has_corner);
      if (lost != mark.corners.end())
        warn(each, fmt::format("names the corner '{}', which its outline has not", *lost));
      else if (!sized)
        warn(each, "has a width that is not above 0, or a stroke, gap or offset below 0");
      else if (mark.corners.size() == 1)
        warn(each, "names one corner where it goes from corner to corner");
      else if (mark.corners.empty() && std::find(kSides.begin(), kSides.end(), mark.side) == kSides.end())
        warn(each, fmt::format("lies on the side '{}'{}", mark.side, base::DidYouMean(mark.side, kSides)));
      else
        object.marks.push_back(std::move(mark));
    }
  }
}

// A frame that has no outline, no width or not enough corners is no error: it is said, and not drawn.
void ReadBorders(const Node& node, network::Object& object) {
  static const std::vector<std::string> kTypes = {"concrete", "curb"};
  const auto& outlines = object.outlines;
  for (const Node& each : node.Child("borders").Children("border")) {
    network::ObjectBorder border;
    border.width_m = each.Number("width", 0.0);
    border.type = each.Text("type", "");
    for (const Node& corner : each.Children("cornerReference")) border.corners.push_back(corner.Text("id"));
    const bool whole = each.Flag("useCompleteOutline", true);
    const std::string id = each.Text("outlineId", "");
    const auto warn = [&](std::string_view rule, const std::string& what) {
      WarnOf(each, rule, fmt::format("a border of the object '{}' {}: it is not drawn", object.id, what));
    };
    const auto found = std::find_if(outlines.begin(), outlines.end(),
                                    [&](const network::Outline& outline) { return outline.id == id; });
    if (found == outlines.end()) {
      warn("road.object.borders.outline_id", fmt::format("is of the outline '{}', which it has not", id));
      continue;
    }
    border.outline = static_cast<std::size_t>(found - outlines.begin());
    const auto lost = std::find_if_not(border.corners.begin(), border.corners.end(), [&](const std::string& corner) {
      return std::any_of(found->corners.begin(), found->corners.end(),
                         [&](const network::Corner& of) { return of.id == corner; });
    });
    if (lost != border.corners.end())
      warn("road.object.borders", fmt::format("names the corner '{}', which its outline has not", *lost));
    else if (!whole && border.corners.size() < 2)
      warn("road.object.borders",
           fmt::format("names {} corners of its outline; two at least were expected", border.corners.size()));
    else if (!(border.width_m > 0.0))
      warn("road.object.borders", fmt::format("is {} m wide", border.width_m));
    else if (std::find(kTypes.begin(), kTypes.end(), border.type) == kTypes.end())
      warn("road.object.borders",
           fmt::format("is of the type '{}'{}", border.type, base::DidYouMean(border.type, kTypes)));
    else {
      if (whole && !border.corners.empty()) {
        WarnOf(each, "road.object.borders.useCompleteOutline_true",
               fmt::format("a border of the object '{}' goes along its complete outline and names corners: it goes "
                           "along all of it",
                           object.id));
        border.corners.clear();
      }
      object.borders.push_back(std::move(border));
    }
  }
}

// Of points with a radius, or with a width and a length; a line that mixes them, or has no extent, is said and not
// drawn.
void ReadSkeleton(const Node& node, network::Object& object) {
  for (const Node& line : node.Child("skeleton").Children("polyline")) {
    network::SkeletonLine points;
    const auto read = [&](const Node& vertex, bool local) {
      network::SkeletonPoint point{local, vertex.Number(local ? "u" : "s"), vertex.Number(local ? "v" : "t"),
                                   vertex.Number(local ? "z" : "dz", 0.0)};
      point.radius_m = vertex.Number("radius", 0.0), point.width_m = vertex.Number("width", 0.0),
      point.length_m = vertex.Number(vertex.Has("length") ? "length" : "height", 0.0);
      points.push_back(point);
    };
    for (const Node& vertex : line.Children("vertexRoad")) read(vertex, false);
    for (const Node& vertex : line.Children("vertexLocal")) read(vertex, true);
    const auto warn = [&](std::string_view rule, const std::string& what) {
      WarnOf(line, rule, fmt::format("a skeleton's line of the object '{}' {}: it is not drawn", object.id, what));
    };
    const auto round =
        std::count_if(points.begin(), points.end(), [](const network::SkeletonPoint& p) { return p.radius_m > 0.0; });
    const auto square = std::count_if(points.begin(), points.end(), [](const network::SkeletonPoint& p) {
      return p.width_m > 0.0 && p.length_m > 0.0;
    });
    const bool mixed = std::any_of(points.begin(), points.end(),
                                   [&](const network::SkeletonPoint& p) { return p.local != points.front().local; });
    const bool finite = std::all_of(points.begin(), points.end(), [](const network::SkeletonPoint& p) {
      return p.radius_m >= 0.0 && p.width_m >= 0.0 && p.length_m >= 0.0;
    });
    const auto count = static_cast<std::ptrdiff_t>(points.size());
    if (points.size() < 2)
      warn("road.object.skeleton.polyline_followed_by_vertex",
           fmt::format("has {} points; two at least were expected", points.size()));
    else if (mixed)
      warn("road.object.skeleton.vertex_road.polyline_elements", "has both <vertexRoad> and <vertexLocal>");
    else if (!finite || !((round == count && square == 0) || (round == 0 && square == count)))
      warn("road.object.skeleton.use_radius_or_width_length",
           "has points without a radius, or a width and a length, above 0; all were expected to have the one, or all "
           "the other");
    else
      object.skeleton.push_back(std::move(points));
  }
}

// The standard's types of objects, up to 1.8.
const std::vector<std::string>& ObjectTypes() {
  static const std::vector<std::string> types = {
      "none",     "obstacle",     "car",        "pole",    "tree",          "vegetation", "barrier",
      "building", "parkingSpace", "patch",      "railing", "trafficIsland", "crosswalk",  "streetLamp",
      "gantry",   "soundBarrier", "van",        "bus",     "trailer",       "bike",       "motorbike",
      "tram",     "train",        "pedestrian", "wind",    "roadMark",      "roadSurface"};
  return types;
}

// An unknown type is no error: it stands as a plain body.
void CheckType(const Node& node, const network::Object& object) {
  const auto& types = ObjectTypes();
  if (object.type == "-1" || std::find(types.begin(), types.end(), object.type) != types.end())
    return;  // -1: none, in older files
  Source& source = node.source();
  source.warnings.push_back({"road.object.type",
                             fmt::format("the object '{}' has the type '{}', which OpenDRIVE does not know{}",
                                         object.id, object.type, base::DidYouMean(object.type, types)),
                             node.line(), source.where.road, source.where.lane, source.where.s_m});
}

}  // namespace

network::Object ReadObject(const Node& node) {
  network::Object object;
  object.id = node.Text("id", "");
  object.name = node.Text("name", "");
  object.type = node.Text("type", "none");
  object.subtype = node.Text("subtype", "");
  object.orientation = node.Text("orientation", "none");
  object.s_m = node.Number("s");
  object.t_m = node.Number("t");
  object.z_offset_m = node.Number("zOffset", 0.0);
  object.hdg_rad = node.Number("hdg", 0.0);
  object.pitch_rad = node.Number("pitch", 0.0);
  object.roll_rad = node.Number("roll", 0.0);
  object.length_m = node.Number("length", 0.0);
  object.width_m = node.Number("width", 0.0);
  object.height_m = node.Number("height", 0.0);
  object.radius_m = node.Number("radius", 0.0);
  object.valid_length_m = node.Number("validLength", 0.0);
  object.dynamic = node.Flag("dynamic", false);
  for (const Node& repeat : node.Children("repeat")) object.repeats.push_back(ReadRepeat(repeat));
  for (const Node& outline : node.Children("outline")) object.outlines.push_back(ReadOutline(outline));
  for (const Node& outlines : node.Children("outlines")) {
    for (const Node& outline : outlines.Children("outline")) object.outlines.push_back(ReadOutline(outline));
  }
  object.validity = ReadValidity(node);
  for (const Node& material : node.Children("material")) {
    object.material.surface = material.Text("surface", "");
    if (material.Has("friction")) object.material.friction = material.Number("friction");
    object.material.colour = material.Text("roadMarkColor", "");
    if (object.material.friction && !(*object.material.friction >= 0.0))
      material.Wrong("road.object.material", fmt::format("a friction of {} was found", *object.material.friction));
  }
  if (const Node place = node.Child("parkingSpace")) object.access = place.Text("access", "");
  ReadMarks(node, object);
  ReadBorders(node, object);
  ReadSkeleton(node, object);
  CheckType(node, object);
  return object;
}

namespace {

// Everything is said with the s at which it stands.
template <class Read>
void Each(const Node& parent, const char* element, const Read& read) {
  for (const Node& node : parent.Children(element)) {
    Within within(node.source());
    if (node.Has("s")) node.source().where.s_m = node.Number("s");
    read(node);
  }
}

}  // namespace

void ReadSignals(const Node& road, network::RoadSpec& spec) {
  const Node list = road.Child("signals");
  Each(list, "signal", [&](const Node& node) {
    network::Signal signal = ReadSignal(node);
    std::vector<network::Signal> on_it = ReadBoards(node, signal);
    // A board by another name is one all the same, or what is on it would hang in the air.
    if (!on_it.empty() && !network::IsBoard(signal)) signal.type = network::kStaticBoard;
    CheckSign(node, signal);
    spec.signals.push_back(std::move(signal));
    spec.signals.insert(spec.signals.end(), std::make_move_iterator(on_it.begin()),
                        std::make_move_iterator(on_it.end()));
  });
  Each(list, "signalReference", [&](const Node& node) {
    spec.signal_references.push_back(
        {node.Number("s"), node.Number("t"), node.Text("id"), node.Text("orientation", "none"), ReadValidity(node)});
  });
}

void ReadObjects(const Node& road, network::RoadSpec& spec) {
  const Node list = road.Child("objects");
  Each(list, "object", [&](const Node& node) { spec.objects.push_back(ReadObject(node)); });
  Each(list, "objectReference", [&](const Node& node) {
    spec.object_references.push_back(
        {node.Number("s"), node.Number("t"), node.Text("id"), node.Text("orientation", "none")});
  });
  for (const bool bridge : {false, true}) {
    Each(list, bridge ? "bridge" : "tunnel", [&](const Node& node) {
      spec.structures.push_back({node.Text("id", ""), node.Text("name", ""), node.Text("type", ""), bridge,
                                 node.Number("s"), node.Number("length")});
    });
  }
}

}  // namespace rodeira::opendrive
