// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/road_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/core/config/either.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/world/design/axis_reader.hpp"
#include "common/world/design/furniture_reader.hpp"
#include "common/world/design/laid_reader.hpp"
#include "common/world/design/marking_reader.hpp"
#include "common/world/design/profile_reader.hpp"
#include "common/world/design/section_reader.hpp"
#include "common/world/design/station.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredMap;
using config::Map;

constexpr double kSharpest = 0.95;  // curvature times the distance of the inner edge

double PlanLength(const std::vector<geometry::PlanElement>& elements) {
  return elements.empty() ? 1.0 : elements.back().s_m + elements.back().length_m;
}

// 'place': where on another road a station of this one lies, and how it is turned against it. Returns the height there.
std::optional<double> ReadPlacing(const DeclaredMap& declared, const std::vector<RoadDesign>& before,
                                  std::vector<geometry::PlanElement>& elements) {
  const Map& road = declared.map();
  if (!road.Has("place")) return std::nullopt;
  const DeclaredMap place = declared.Child("place");
  if (road.Has("start"))
    road.Problem("place", "config.conflicting_keys", "a road has either a 'start' or a 'place' on another road");
  const std::string id = place.Text("road");
  const double s = place.Number("s_m"), turn = place.Number("turn_deg") * geometry::kPi / 180.0;
  const double own_s = Station(place, "own_s_m", PlanLength(elements), 0.0);
  if (!place.map().Has("road")) return std::nullopt;  // a problem already
  std::vector<std::string> ids;
  for (const RoadDesign& other : before) {
    ids.push_back(other.spec.id);
    if (other.spec.id != id) continue;
    if (other.elements.empty()) return std::nullopt;
    const auto axis = geometry::PlanAxis::Make(other.elements);
    if (!axis) return std::nullopt;
    if (s > axis->length_m()) {
      place.map().Problem("s_m", fmt::format("'s_m' is {}; road '{}' is {:.3f} m long", s, id, axis->length_m()));
      return std::nullopt;
    }
    const geometry::PlanPoint at = axis->Evaluate(s);
    Place(elements, own_s, at.p_W, at.heading_rad + turn);
    return other.spec.elevation.Value(s);
  }
  place.map().Problem("road", "world.unknown_road",
                      fmt::format("there is no road '{}' before this one{}", id, base::DidYouMean(id, ids)));
  return std::nullopt;
}

void ReadSpeeds(const DeclaredMap& road, network::RoadSpec& spec) {
  const std::string kind = road.Word("kind");
  const auto knots = ReadKnots(road, "speed_limits", "speed_kmh");
  network::RoadType type{0.0, kind, "", std::nullopt};
  if (const auto speed_kmh = road.OptionalNumber("speed_limit_kmh")) type.speed_mps = *speed_kmh / 3.6;
  if (knots.empty() || knots[0].s_m > 0.0) spec.types.push_back(type);
  for (const Knot& knot : knots) {
    type.s_m = knot.s_m;
    type.speed_mps = knot.value / 3.6;
    spec.types.push_back(type);
  }
}

}  // namespace

RoadDesign ReadRoad(const DeclaredMap& keys, Context& context, const std::vector<RoadDesign>& before) {
  const Map& map = keys.map();
  RoadDesign design{{}, {}, map};
  network::RoadSpec& spec = design.spec;
  spec.id = keys.Text("id");
  spec.name = keys.Text("name", spec.id);
  if (spec.id.find('/') != std::string::npos)
    map.Problem("id", "a road's id holds no '/': the parts between junctions are named with it");
  for (const RoadDesign& other : before) {
    if (other.spec.id == spec.id)
      map.Problem("id", "config.duplicate_name", fmt::format("there is a road '{}' already", spec.id));
  }
  AxisReading axis = ReadAxis(keys, context.move);
  context.warnings.insert(context.warnings.end(), axis.warnings.begin(), axis.warnings.end());
  design.elements = std::move(axis.elements);
  const std::optional<double> met = ReadPlacing(keys, before, design.elements);
  const double length = PlanLength(design.elements);
  spec.length_m = length;
  (void)config::RejectConflictingKeys(map, "vertical", "z_m");
  if (map.Has("vertical")) {
    if (axis.elevation)
      map.Problem("vertical", "config.conflicting_keys",
                  "the points of this road have heights; without them 'vertical' counts");
    std::vector<geometry::GradePoint> grades = ReadGrades(keys.MapWith("vertical"));
    bool ascending = !grades.empty();
    for (std::size_t i = 1; i < grades.size(); ++i) {
      ascending = ascending && grades[i].s_m > grades[i - 1].s_m && grades[i].parabola_m >= 0.0;
    }
    if (ascending) {
      const std::vector<std::string> kinks = GradeWarnings(map, grades);
      context.warnings.insert(context.warnings.end(), kinks.begin(), kinks.end());
    }
    spec.elevation = ascending ? Elevation(geometry::VerticalProfile(std::move(grades)), length) : Constant(0.0);
  } else if (axis.elevation) {
    spec.elevation = std::move(*axis.elevation);
  } else {
    spec.elevation = Constant(keys.Number("z_m", met.value_or(0.0)));
  }
  spec.superelevation = ReadSuperelevation(keys);
  ReadSpeeds(keys, spec);
  const std::string rule = keys.Word("rule", context.left_hand ? "left" : "right");
  Context own = context;
  own.left_hand = rule == "left";
  ReadSection(keys, own, length, spec);
  ReadFurniture(keys, own, length, spec, context.warnings);
  ReadMarkings(keys, length, spec);
  design.laid = ReadLaid(keys, own, length, spec);
  return design;
}

std::optional<network::Road> BuildRoad(const RoadDesign& design) {
  auto axis = design.elements.empty() ? std::nullopt : geometry::PlanAxis::Make(design.elements);
  if (!axis) {
    design.map.Problem("axis", "the axis stands still somewhere, or turns too often");
    return std::nullopt;
  }
  return network::Road(design.spec, std::move(*axis));
}

void CheckBends(const RoadDesign& design, const network::Road& road) {
  const int left_lane = static_cast<int>(design.spec.sections[0].left.size());
  const int right_lane = -static_cast<int>(design.spec.sections[0].right.size());
  const geometry::CubicTable left = EdgeOf(design.spec, left_lane), right = EdgeOf(design.spec, right_lane);
  const bool points = design.map.Has("points");
  const auto folds = [&](const geometry::PlanElement& element, double s, double k) {
    const double inner = k > 0.0 ? left.Value(s) : right.Value(s);
    if (k * inner <= kSharpest) return false;
    // A corner between points is rounded by an arc: one with a large enough radius passes its point farther away.
    std::string help;
    if (points && element.kind == geometry::PlanElement::Kind::kClothoid) {
      const double turn = std::fabs(k) * element.length_m, radius = std::fabs(inner) / kSharpest;
      help = fmt::format(
          "; a corner of {:.0f} degrees needs 'within_m' {:.2f} or more between longer pieces, or 'smooth: true'",
          turn * 180.0 / geometry::kPi,
          std::ceil(100.0 * radius * std::tan(0.5 * turn) * std::tan(0.25 * turn)) / 100.0);
    }
    design.map.Problem(
        points ? "points" : "axis", "world.road_does_not_fit",
        fmt::format(
            "the edge of road '{}' {:.2f} m to the {} folds at s = {:.0f} m: the bend there has a radius of {:.6g} m{}",
            design.spec.id, std::fabs(inner), k > 0.0 ? "left" : "right", s, 1.0 / std::fabs(k), help));
    return true;
  };
  // Every metre, and at both ends of each element by its own formula, however short it is.
  for (const geometry::PlanElement& element : design.elements) {
    if (element.kind == geometry::PlanElement::Kind::kClothoid &&
        folds(element, element.s_m, element.curvature_start_1pm))
      return;
    const int steps = std::max(1, static_cast<int>(std::ceil(element.length_m)));
    for (int i = 0; i < steps; ++i) {
      const double s = element.s_m + element.length_m * (i + 0.5) / steps;
      if (folds(element, s, road.axis().Evaluate(s).curvature_1pm)) return;
    }
    if (folds(element, element.s_m + element.length_m, geometry::PlanAxis::End(element).curvature_1pm)) return;
  }
}

}  // namespace rodeira::design
