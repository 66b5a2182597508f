// SPDX-License-Identifier: Apache-2.0
// Where records and things are said to begin: on their road or in their lane section, and each with an id of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

constexpr double kStationRounding_m = 1e-6;  // comes from the digits of a file

// Warnings of one kind are one: the first, with how often.
class Told {
 public:
  void Add(const Node& node, const std::string& rule, const std::string& message) {
    auto [at, is_first] = of_.try_emplace(rule, Kind{order_.size(), 0});
    ++at->second.count;
    if (!is_first) return;
    const Source::Where& where = node.source().where;
    order_.push_back({rule, message, node.line(), where.road, where.lane, where.s_m});
  }

  void Tell(Source& source) {
    for (const auto& [rule, kind] : of_) {
      if (kind.count > 1) order_[kind.at].message += fmt::format(" ({} such)", kind.count);
    }
    source.warnings.insert(source.warnings.end(), order_.begin(), order_.end());
  }

 private:
  struct Kind {
    std::size_t at, count;
  };
  std::map<std::string, Kind> of_;
  std::vector<Finding> order_;
};

// Nothing where the attribute is absent or not a finite number. The reader of the element reports that.
std::optional<double> FiniteNumber(const Node& node, const char* attribute) {
  const pugi::xml_attribute found = node.xml().attribute(attribute);
  if (!found) return std::nullopt;
  const double value = found.as_double(std::nan(""));
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

class Stations {
 public:
  explicit Stations(Source& source) : source_(source) {}

  void Road(const Node& road) {
    Within within(source_);
    source_.where = {road.Text("id", ""), std::nullopt, std::nullopt};
    const auto length = FiniteNumber(road, "length");
    if (!length || !(*length > 0.0)) return;
    Records(road, "type", "road.type.s", *length);
    Records(road.Child("elevationProfile"), "elevation", "road.elevation.s", *length);
    for (const char* kind : {"superelevation", "crossfall", "shape"})
      Records(road.Child("lateralProfile"), kind, fmt::format("road.lateral.{}.s", kind), *length);
    Records(road.Child("lanes"), "laneOffset", "road.lane_offset.s", *length);
    for (const auto& [parent, kind] : {std::pair("elevationProfile", "elevation"),
                                       std::pair("lateralProfile", "superelevation"), std::pair("lanes", "laneOffset")})
      First(road.Child(parent).Child(kind), "s", fmt::format("road.{}.first", kind));
    for (const char* kind : {"object", "objectReference", "tunnel", "bridge"})
      CheckObjects(road.Child("objects"), kind, *length);
    for (const char* kind : {"signal", "signalReference"}) CheckObjects(road.Child("signals"), kind, *length);
    Ids(road.Child("objects"), "object", objects_);
    Ids(road.Child("signals"), "signal", signals_);
    Sections(road.Child("lanes").Children("laneSection"), *length);
  }

  void Tell() { told_.Tell(source_); }

 private:
  // Records count from where they begin; below 0 there is no road, and behind its end none counts.
  void Record(const Node& node, const char* attribute, const std::string& rule, double length_m, std::string_view of) {
    const auto at = FiniteNumber(node, attribute);
    if (!at) return;
    if (*at < -kStationRounding_m)
      node.Wrong(rule, fmt::format("<{}> begins at {} {:.6g}; 0 or more was expected", node.name(), attribute, *at),
                 {RepairKind::kIgnored, "it counts from there on"});
    if (*at > length_m + kStationRounding_m)
      told_.Add(node, rule,
                fmt::format("<{}> begins at {} {:.6g}, behind the end of its {} ({:.6g} m): it counts nowhere",
                            node.name(), attribute, *at, of, length_m));
  }

  void Records(const Node& parent, const char* element, const std::string& rule, double length_m) {
    for (const Node& node : parent.Children(element)) {
      Within within(source_);
      source_.where.s_m = FiniteNumber(node, "s");
      Record(node, "s", rule, length_m, "road");
    }
  }

  // A function is said from its beginning on; one that begins later and is 0 there says the same.
  void First(const Node& record, const char* attribute, const std::string& rule) {
    const auto at = FiniteNumber(record, attribute);
    const auto is_something = [&](const char* coefficient) {
      return FiniteNumber(record, coefficient).value_or(0.0) != 0.0;
    };
    if (!at || *at <= kStationRounding_m ||
        !(is_something("a") || is_something("b") || is_something("c") || is_something("d")))
      return;
    told_.Add(record, rule,
              fmt::format("the first <{}> begins at {} {:.6g}; 0 was expected: up to there it is read backwards",
                          record.name(), attribute, *at));
  }

  void CheckObjects(const Node& parent, const std::string& element, double length_m) {
    for (const Node& node : parent.Children(element.c_str())) {
      Within within(source_);
      const auto at = FiniteNumber(node, "s");
      source_.where.s_m = at;
      if (at && (*at < -kStationRounding_m || *at > length_m + kStationRounding_m))
        told_.Add(node, fmt::format("road.{}.s", element),
                  fmt::format("the {} '{}' is at s {:.6g}, and its road goes from 0 to {:.6g} m", element,
                              node.Text("id", ""), *at, length_m));
      for (const Node& repeat : node.Children("repeat")) Repeat(repeat);
    }
  }

  void Repeat(const Node& repeat) {
    for (const char* attribute : {"s", "length", "distance"}) {
      const auto value = FiniteNumber(repeat, attribute);
      if (value && *value < -kStationRounding_m)
        repeat.Wrong(fmt::format("road.object.repeat.{}", attribute),
                     fmt::format("<repeat> has a {} of {:.6g}; 0 or more was expected", attribute, *value));
    }
  }

  void Ids(const Node& parent, const std::string& element, std::map<std::string, std::string>& known) {
    for (const Node& node : parent.Children(element.c_str())) {
      Within within(source_);
      source_.where.s_m = FiniteNumber(node, "s");
      const std::string id = node.Text("id", "");
      const auto [first, is_new] = known.try_emplace(id, source_.where.road);
      if (!id.empty() && !is_new)
        told_.Add(
            node, fmt::format("ids.id_unique_in_class.{}", element),
            fmt::format("the id '{}' stands at two {}s, the first at road {}; ids of its own were expected for each",
                        id, element, first->second));
    }
  }

  void Sections(const std::vector<Node>& sections, double length_m) {
    for (std::size_t i = 0; i < sections.size(); ++i) {
      const double from = FiniteNumber(sections[i], "s").value_or(0.0);
      const double to = i + 1 < sections.size() ? FiniteNumber(sections[i + 1], "s").value_or(length_m) : length_m;
      Within within(source_);
      source_.where.s_m = from;
      for (const char* side : {"left", "center", "right"}) {
        for (const Node& lane : sections[i].Child(side).Children("lane")) Lane(lane, std::max(to - from, 0.0));
      }
    }
  }

  void Lane(const Node& lane, double length_m) {
    Within within(source_);
    source_.where.lane = lane.xml().attribute("id").as_int();
    for (const char* kind : {"width", "border", "height", "roadMark", "material", "speed", "access"}) {
      const std::string rule = fmt::format("road.lane.{}.s_offset", kind);
      for (const Node& record : lane.Children(kind)) Record(record, "sOffset", rule, length_m, "lane section");
    }
    for (const char* kind : {"width", "border"})
      First(lane.Child(kind), "sOffset", fmt::format("road.lane.{}.first", kind));
  }

  Source& source_;
  Told told_;
  std::map<std::string, std::string> objects_, signals_;  // the road of each id
};

}  // namespace

void CheckStations(const Node& root) {
  Stations stations(root.source());
  for (const Node& road : root.Children("road")) stations.Road(road);
  stations.Tell();
}

}  // namespace rodeira::opendrive
