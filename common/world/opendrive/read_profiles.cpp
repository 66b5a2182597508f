// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

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

void ReadShapes(const Node& profile, network::LateralProfile& lateral) {
  std::map<double, std::vector<Node>> by_s;
  double before = -1e300;
  for (const Node& shape : profile.Children("shape")) {
    const double s = shape.Number("s");
    if (s < before)
      shape.Wrong("road.lateral.shape.elem_asc_order",
                  fmt::format("<shape> of s {:.6g} stands behind one of s {:.6g}", s, before));
    before = s;
    by_s[s].push_back(shape);
  }
  for (const auto& [s, records] : by_s)
    lateral.shapes.push_back({s, ReadCubics(records, "t", 0.0, "road.lateral.shape.elem_asc_order")});
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
