// SPDX-License-Identifier: Apache-2.0
// Measures that nothing on earth has. A slip of the hand in one number puts a lane's edge a million kilometres away,
// and everything that looks at the ground between would never end.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "common/world/opendrive/cubic_extremes.hpp"
#include "common/world/opendrive/measures.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::Cubic;

// 0 where the attribute is absent or not a finite number. The reader of the element reports that.
double FiniteOrZero(const Node& node, const char* attribute) {
  const double value = node.xml().attribute(attribute).as_double(0.0);
  return std::isfinite(value) ? value : 0.0;
}

// What a kind of record says, and how large it may be.
struct Kind {
  const char* element;
  const char* from;  // the attribute of where a record begins
  std::string rule;
  std::string_view what;  // "the lane is {} wide here"
  std::string_view unit;
  double most;
};

class Measures {
 public:
  explicit Measures(Source& source) : source_(source) {}

  void Road(const Node& road) {
    Within within(source_);
    source_.where = {road.Text("id", ""), std::nullopt, std::nullopt};
    const double length = FiniteOrZero(road, "length");
    if (!(length > 0.0)) return;
    Records(road.Child("elevationProfile"),
            {"elevation", "s", "road.elevation", "the road is at a height of {} here", "m", kHighest_m}, 0.0, length);
    Records(
        road.Child("lateralProfile"),
        {"superelevation", "s", "road.lateral.superelevation", "the superelevation is {} here", "rad", kSteepest_rad},
        0.0, length);
    if (Crossfall(road.Child("lateralProfile"), "left", length) < kSteepest_rad)
      Crossfall(road.Child("lateralProfile"), "right", length);
    for (const Node& of : road.Child("lateralProfile").Child("crossSectionSurface").Children("tOffset"))
      Records(of,
              {"coefficients", "s", "road.lateral.css", "the cross-section lies {} beside the line", "m", kWidest_m},
              0.0, length);
    const double aside =
        Records(road.Child("lanes"),
                {"laneOffset", "s", "road.lane_offset", "the lanes begin {} beside the line here", "m", kWidest_m}, 0.0,
                length);
    Sections(road.Child("lanes").Children("laneSection"), length, aside);
    Objects(road.Child("objects"));
    for (const Node& signal : road.Child("signals").Children("signal")) Signal(signal);
    for (const Node& crg : road.Child("surface").Children("CRG")) Crg(crg);
  }

  void Junction(const Node& junction) {
    Objects(junction);
    Objects(junction.Child("objects"));
  }

 private:
  void Wrong(const Node& node, std::string_view rule, double s_m, std::string_view what, double found,
             std::string_view unit, double most) const {
    Within within(source_);
    source_.where.s_m = s_m;
    node.Wrong(rule, fmt::format("{}; at most {:.6g} {} was expected",
                                 fmt::format(fmt::runtime(what), fmt::format("{:.6g} {}", found, unit)), most, unit));
  }

  // Each record where it is in force, between 0 and the length of what it is of, which begins at `origin_m`; the
  // largest that is found, or that may be.
  double Records(const Node& parent, const Kind& kind, double origin_m, double length_m) {
    return Records(parent.Children(kind.element), kind, origin_m, length_m);
  }
  double Records(const std::vector<Node>& nodes, const Kind& kind, double origin_m, double length_m) {
    double largest = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double from = FiniteOrZero(nodes[i], kind.from),
                   next = i + 1 < nodes.size() ? FiniteOrZero(nodes[i + 1], kind.from) : length_m;
      const double low = i == 0 ? 0.0 : std::max(from, 0.0), high = std::min(next, length_m);
      if (low > high || (low == high && i + 1 < nodes.size())) continue;  // it counts nowhere
      const Cubic cubic{from, FiniteOrZero(nodes[i], "a"), FiniteOrZero(nodes[i], "b"), FiniteOrZero(nodes[i], "c"),
                        FiniteOrZero(nodes[i], "d")};
      const Extreme farthest = FarthestOf(cubic, low, high);
      largest = std::max(largest, std::min(std::fabs(farthest.value), kind.most));
      if (!(std::fabs(farthest.value) <= kind.most))
        Wrong(nodes[i], kind.rule, origin_m + farthest.at, kind.what, farthest.value, kind.unit, kind.most);
    }
    return largest;
  }

  // Of one side, or of both.
  double Crossfall(const Node& profile, std::string_view side, double length_m) {
    std::vector<Node> records;
    for (const Node& record : profile.Children("crossfall")) {
      if (const std::string of = record.Text("side", "both"); of == side || of == "both") records.push_back(record);
    }
    return Records(records,
                   {"crossfall", "s", "road.lateral.crossfall", "the crossfall is {} here", "rad", kSteepest_rad}, 0.0,
                   length_m);
  }

  void Sections(const std::vector<Node>& sections, double length_m, double aside_m) {
    for (std::size_t i = 0; i < sections.size(); ++i) {
      const double from = FiniteOrZero(sections[i], "s"),
                   to = i + 1 < sections.size() ? FiniteOrZero(sections[i + 1], "s") : length_m;
      Within within(source_);
      source_.where.s_m = from;
      for (const char* side : {"left", "center", "right"}) {
        double reach = aside_m;
        for (const Node& lane : sections[i].Child(side).Children("lane"))
          reach += Lane(lane, from, std::max(to - from, 0.0));
        if (!(reach <= kWidestSide_m))
          sections[i].Wrong(
              "road.lane.width",
              fmt::format("the lanes on the {} reach {:.6g} m from the line; at most {:.6g} m was expected", side,
                          reach, kWidestSide_m));
      }
    }
  }

  // How wide it is at most.
  double Lane(const Node& lane, double origin_m, double length_m) {
    Within within(source_);
    source_.where.lane = lane.xml().attribute("id").as_int();
    const double wide = Records(
        lane, {"width", "sOffset", "road.lane.width", "the lane is {} wide here", "m", kWidest_m}, origin_m, length_m);
    Records(lane,
            {"border", "sOffset", "road.lane.border", "the lane's border lies {} beside the line here", "m", kWidest_m},
            origin_m, length_m);
    for (const Node& height : lane.Children("height")) {
      for (const char* edge : {"inner", "outer"}) {
        const double found = FiniteOrZero(height, edge);
        if (!(std::fabs(found) <= kHighestLane_m))
          Wrong(height, "road.lane.height", origin_m + FiniteOrZero(height, "sOffset"),
                "the lane lies {} above the road here", found, "m", kHighestLane_m);
      }
    }
    for (const Node& mark : lane.Children("roadMark")) Mark(mark, origin_m + FiniteOrZero(mark, "sOffset"), length_m);
    return wide;
  }

  void Mark(const Node& mark, double s_m, double length_m) {
    const auto line = [&](const Node& of) {
      At(of, "width", "road.lane.roadMark", s_m, kWidestMark_m);
      At(of, "tOffset", "road.lane.roadMark", s_m, kWidest_m);
    };
    line(mark);
    for (const char* group : {"type", "explicit"}) {
      for (const Node& of : mark.Children(group)) {
        At(of, "width", "road.lane.roadMark", s_m, kWidestMark_m);
        for (const Node& each : of.Children("line")) line(each);
      }
    }
    Records(mark, {"sway", "ds", "road.lane.roadMark", "the mark lies {} beside its place here", "m", kWidest_m}, s_m,
            length_m);
  }

  void At(const Node& node, const char* attribute, std::string_view rule, double s_m, double most) const {
    const double found = FiniteOrZero(node, attribute);
    if (std::fabs(found) <= most) return;
    Wrong(node, rule, s_m, fmt::format("<{}> has a {} of {{}}", node.name(), attribute), found, "m", most);
  }

  void All(const Node& node, std::initializer_list<const char*> attributes, std::string_view rule, double s_m) const {
    for (const char* attribute : attributes) At(node, attribute, rule, s_m, kLargestThing_m);
  }

  void Objects(const Node& parent) const {
    for (const Node& object : parent.Children("object")) Object(object);
  }

  void Object(const Node& object) const {
    constexpr std::string_view kRule = "road.object.measures";
    const double s = FiniteOrZero(object, "s");
    All(object, {"t", "zOffset", "length", "width", "height", "radius"}, kRule, s);
    for (const Node& repeat : object.Children("repeat"))
      All(repeat,
          {"tStart", "tEnd", "zOffsetStart", "zOffsetEnd", "heightStart", "heightEnd", "widthStart", "widthEnd",
           "lengthStart", "lengthEnd", "radiusStart", "radiusEnd"},
          kRule, s);
    Corners(object, s);
    Corners(object.Child("outlines"), s);
    for (const Node& border : object.Child("borders").Children("border")) All(border, {"width"}, kRule, s);
    for (const Node& line : object.Child("skeleton").Children("polyline")) {
      for (const char* kind : {"vertexRoad", "vertexLocal"}) {
        for (const Node& vertex : line.Children(kind))
          All(vertex, {"t", "u", "v", "z", "dz", "radius", "width", "length", "height"}, kRule, s);
      }
    }
  }

  void Corners(const Node& parent, double s_m) const {
    for (const Node& outline : parent.Children("outline")) {
      for (const char* kind : {"cornerRoad", "cornerLocal"}) {
        for (const Node& corner : outline.Children(kind))
          All(corner, {"t", "u", "v", "z", "dz", "height"}, "road.object.measures", s_m);
      }
    }
  }

  void Signal(const Node& signal) const {
    constexpr std::string_view kRule = "road.signal.measures";
    const double s = FiniteOrZero(signal, "s");
    All(signal, {"t", "zOffset", "width", "height"}, kRule, s);
    for (const Node& at : signal.Children("positionRoad")) All(at, {"t", "zOffset"}, kRule, s);
    for (const Node& at : signal.Children("positionInertial")) {
      for (const char* attribute : {"x", "y"}) At(at, attribute, kRule, s, 0.5 * network::Network::kFarthest_m);
      At(at, "z", kRule, s, kHighest_m);
    }
    for (const char* kind : {"staticBoard", "vmsBoard"}) {
      for (const Node& board : signal.Children(kind)) {
        All(board, {"v", "z", "displayWidth", "displayHeight"}, kRule, s);
        for (const Node& sign : board.Children("sign")) All(sign, {"v", "z", "width", "height"}, kRule, s);
      }
    }
  }

  void Crg(const Node& crg) const {
    const double s = FiniteOrZero(crg, "sStart");
    At(crg, "tOffset", "road.surface.crg", s, kWidest_m);
    At(crg, "zOffset", "road.surface.crg", s, kHighest_m);
    if (const double scale = crg.xml().attribute("zScale").as_double(1.0); !(std::fabs(scale) <= kMaxScale))
      Wrong(crg, "road.surface.crg", s, "the measured surface's heights count {}", scale, "times", kMaxScale);
  }

  Source& source_;
};

}  // namespace

void CheckMeasures(const Node& root) {
  Measures measures(root.source());
  for (const Node& road : root.Children("road")) measures.Road(road);
  for (const Node& junction : root.Children("junction")) measures.Junction(junction);
}

}  // namespace rodeira::opendrive
