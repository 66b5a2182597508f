// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road_network.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"
#include "common/world/design/profile_reader.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::road {
namespace {

using geometry::Cubic;
using geometry::CubicTable;

std::vector<geometry::PlanElement> Elements(const Road& road) {
  std::vector<geometry::PlanElement> elements;
  double s = 0.0;
  for (const geometry::PlanPiece& piece : road.plan().pieces()) {
    const geometry::PlanPoint at = road.plan().Evaluate(s);
    geometry::PlanElement element;
    element.s_m = s;
    element.length_m = piece.length_m;
    element.start_W = at.p_W;
    element.heading_rad = at.heading_rad;
    element.curvature_start_1pm = piece.curvature_start_1pm;
    element.curvature_end_1pm = piece.curvature_end_1pm;
    elements.push_back(element);
    s += piece.length_m;
  }
  return elements;
}

// The outermost strips go on over the blend: on the right that needs a record which begins at its outer edge.
network::LateralProfile LateralProfileOf(const Road& road) {
  std::vector<Cubic> records;
  for (const Band& band : road.section().bands())
    records.push_back({band.from_t_m, band.from_z_m, band.slope, 0.0, 0.0});
  const double blend_m = road.section().spec().blend_m;
  records.front().from -= blend_m, records.front().a -= records.front().b * blend_m;
  network::LateralProfile lateral;
  lateral.shapes.push_back({0.0, CubicTable(std::move(records))});
  return lateral;
}

network::Lane Strip(int id, network::LaneType type, double width_m, ground::Surface surface,
                    const FrictionTable& friction) {
  network::Lane lane;
  lane.id = id;
  lane.type = type;
  lane.width = design::Constant(width_m);
  lane.materials.push_back(
      {0.0, std::string(SurfaceName(surface)), friction[static_cast<std::size_t>(surface)], std::nullopt, {}});
  return lane;
}

// From inside outward: the lanes, the shoulder, the verge.
std::vector<network::Lane> Side(const Section& section, bool left, bool left_hand, const FrictionTable& friction) {
  std::vector<network::Lane> lanes;
  const int step = left ? 1 : -1;
  const int usual = left == left_hand ? 1 : -1;
  int id = step;
  for (; const Lane* lane = section.FindLane(id); id += step) {
    network::Lane strip = Strip(id, network::LaneType::kDriving, lane->width_m, section.spec().surface, friction);
    strip.direction = lane->direction;
    strip.speeds.push_back({0.0, lane->speed_limit_mps});
    lanes.push_back(std::move(strip));
  }
  const Shoulder& shoulder = left ? section.spec().left : section.spec().right;
  const Verge& verge = section.spec().verge;
  if (shoulder.width_m > 0.0) {
    lanes.push_back(Strip(id, network::LaneType::kShoulder, shoulder.width_m, shoulder.surface, friction));
    lanes.back().direction = usual;
    id += step;
  }
  if (verge.width_m > 0.0) {
    lanes.push_back(Strip(id, network::LaneType::kNone, verge.width_m, verge.surface, friction));
    lanes.back().direction = usual;
  }
  return lanes;
}

}  // namespace

network::Road AsNetworkRoad(const Road& road, const FrictionTable& friction) {
  network::RoadSpec spec;
  spec.id = spec.name = road.id();
  spec.length_m = road.length_m();
  spec.left_hand = std::all_of(road.lanes().begin(), road.lanes().end(),
                               [](const Lane& lane) { return lane.direction == (lane.id > 0 ? 1 : -1); });
  spec.elevation = design::Elevation(road.profile(), road.length_m());
  spec.lateral = LateralProfileOf(road);
  spec.earthwork.emplace();
  spec.earthwork->blend_m = spec.earthwork->reach_m = road.section().spec().blend_m;
  network::LaneSection section;
  section.left = Side(road.section(), true, spec.left_hand, friction);
  section.right = Side(road.section(), false, spec.left_hand, friction);
  spec.sections.push_back(std::move(section));
  for (const Mark& mark : road.marks()) {
    network::PaintedLine line{mark.from_s_m, mark.to_s_m, design::Constant(mark.t_m), mark.width_m, mark.stroke_m,
                              mark.gap_m,    "white"};
    if (mark.colour == MarkColour::kYellow) line.colour = "yellow";
    spec.lines.push_back(std::move(line));
  }
  auto axis = geometry::PlanAxis::Make(Elements(road));
  RODEIRA_ASSERT(axis.has_value());
  return network::Road(std::move(spec), std::move(*axis));
}

std::shared_ptr<const network::Network> AsNetwork(std::string name, std::string geo_reference,
                                                  std::span<const Road> roads, const FrictionTable& friction) {
  if (roads.empty()) return nullptr;
  network::NetworkSpec network;
  network.name = std::move(name), network.geo_reference = std::move(geo_reference);
  for (const Road& road : roads) network.roads.push_back(AsNetworkRoad(road, friction));
  return std::make_shared<const network::Network>(std::move(network));
}

}  // namespace rodeira::road
