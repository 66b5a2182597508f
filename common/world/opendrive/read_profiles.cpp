// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::CubicTable;

void ReadCrossfall(const Node& profile, network::LateralProfile& lateral) {
  for (const bool left : {true, false}) {
    std::vector<Node> records;
    for (const Node& crossfall : profile.Children("crossfall")) {
      const std::string side = crossfall.Text("side", "both");
      if (side != "left" && side != "right" && side != "both") {
        crossfall.Wrong("road.lateral.crossfall", fmt::format("side is '{}'; left, right or both was expected", side));
      }
      if (side == "both" || (side == "left") == left) records.push_back(crossfall);
    }
    (left ? lateral.crossfall_left : lateral.crossfall_right) =
        ReadCubics(records, "s", 0.0, "road.lateral.crossfall.elem_asc_order");
  }
}

double TOf(const Node& shape) { return shape.xml().attribute("t").as_double(); }

// The profiles that a file gives at one s: one in any order of t, or several, of which each goes through t in one
// direction and the next one begins where that turns back.
std::vector<std::vector<Node>> ProfilesOf(const std::vector<Node>& records) {
  std::vector<double> ts;
  for (const Node& record : records) ts.push_back(TOf(record));
  std::sort(ts.begin(), ts.end());
  if (std::adjacent_find(ts.begin(), ts.end()) == ts.end()) return {records};
  std::vector<std::vector<Node>> profiles;
  double direction = 0.0;
  for (const Node& record : records) {
    const double step = profiles.empty() ? 0.0 : TOf(record) - TOf(profiles.back().back());
    if (profiles.empty() || step == 0.0 || step * direction < 0.0) {
      profiles.emplace_back();
      direction = 0.0;
    } else {
      direction = step;
    }
    profiles.back().push_back(record);
  }
  return profiles;
}

bool Same(const std::vector<Node>& a, const std::vector<Node>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Node& x, const Node& y) {
    for (const char* attribute : {"t", "a", "b", "c", "d"}) {
      if (x.xml().attribute(attribute).as_double() != y.xml().attribute(attribute).as_double()) return false;
    }
    return true;
  });
}

void TellSecondProfile(const std::vector<Node>& first, const std::vector<Node>& second, double s_m) {
  Within within(second.front().source());
  second.front().source().where.s_m = s_m;
  Repair repair{RepairKind::kStepKept, "the later one counts from there on", {}};
  if (Same(first, second)) {
    repair.kind = RepairKind::kDuplicateDropped, repair.done = "the second, which is the same, is passed over";
    for (const Node& record : second) repair.edits.push_back(record.Remove());
  }
  second.front().Wrong("road.lateral.shape.elem_asc_order",
                       fmt::format("a second profile of <shape>s begins at s {:.6g}, with t {:.6g}; one was expected",
                                   s_m, TOf(second.front())),
                       std::move(repair));
}

void ReadShapes(const Node& profile, network::LateralProfile& lateral) {
  std::map<double, std::vector<Node>> by_s;
  const std::vector<Node> nodes = profile.Children("shape");
  double before = -1e300;
  bool said = false;
  for (const Node& shape : nodes) {
    const double s = shape.Number("s");
    if (s < before && !said) {
      std::vector<std::size_t> order(nodes.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return nodes[a].xml().attribute("s").as_double() < nodes[b].xml().attribute("s").as_double();
      });
      shape.Wrong("road.lateral.shape.elem_asc_order",
                  fmt::format("<shape> of s {:.6g} stands behind one of s {:.6g}", s, before),
                  {RepairKind::kSorted, "they are read in the order of s", Reorder(nodes, order)});
      said = true;
    }
    before = s;
    by_s[s].push_back(shape);
  }
  for (const auto& [s, records] : by_s) {
    const std::vector<std::vector<Node>> profiles = ProfilesOf(records);
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      if (i > 0) TellSecondProfile(profiles[i - 1], profiles[i], s);
      lateral.shapes.push_back({s, ReadCubics(profiles[i], "t", 0.0, "road.lateral.shape.elem_asc_order")});
    }
  }
}

CubicTable Coefficients(const Node& element) {
  return ReadCubics(element.Children("coefficients"), "s", 0.0, "road.lateral.css.elem_asc_order");
}

void ReadCrossSectionSurface(const Node& profile, network::CrossSectionSurface& surface) {
  const Node css = profile.Child("crossSectionSurface");
  if (!css) return;
  surface.t_offset = Coefficients(css.Child("tOffset"));
  std::map<int, network::SurfaceStrip> strips;
  for (const Node& element : css.Child("surfaceStrips").Children("strip")) {
    const int id = element.Integer("id");
    network::SurfaceStrip strip;
    strip.relative = element.Text("mode", "independent") == "relative";
    strip.has_width = static_cast<bool>(element.Child("width"));
    strip.width = Coefficients(element.Child("width"));
    std::size_t power = 0;
    for (const char* name : {"constant", "linear", "quadratic", "cubic"})
      strip.coefficients[power++] = Coefficients(element.Child(name));
    if (id == 0 || !strips.emplace(id, strip).second)
      element.Wrong("road.lateral.css.strip_id", fmt::format("a strip's id is {}; another one was expected", id));
  }
  for (const auto& [id, strip] : strips) {
    if (id > 0)
      surface.left.push_back(strip);
    else
      surface.right.insert(surface.right.begin(), strip);
  }
}

}  // namespace

void ReadLateral(const Node& road, network::LateralProfile& lateral) {
  const Node profile = road.Child("lateralProfile");
  ReadCrossfall(profile, lateral);
  ReadShapes(profile, lateral);
  ReadCrossSectionSurface(profile, lateral.surface);
}

void ReadProfiles(const Node& road, network::RoadSpec& spec) {
  spec.elevation =
      ReadCubics(road.Child("elevationProfile").Children("elevation"), "s", 0.0, "road.elevation.elem_asc_order");
  spec.superelevation = ReadCubics(road.Child("lateralProfile").Children("superelevation"), "s", 0.0,
                                   "road.lateral.superelevation.elem_asc_order");
  ReadLateral(road, spec.lateral);
}

}  // namespace rodeira::opendrive
