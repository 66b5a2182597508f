// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/axis_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/design/element_name.hpp"
#include "common/world/design/points.hpp"
#include "common/world/design/road_schema.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredMap;
using config::Map;
using config::Range;
using geometry::PlanElement;

constexpr double kSmallestRadius_m = 5.0;
constexpr Range kLength_m = {0.01, 100'000.0};
constexpr double kGap_m = 0.05;

double ReadCurvature(const DeclaredMap& keys, std::string_view key) {
  const Map& map = keys.MapWith(key);
  const double radius = map.Number(key);
  if (!map.Has(key)) return 1.0 / 1e7;  // a problem already
  if (std::fabs(radius) >= kSmallestRadius_m && std::fabs(radius) <= 1e7) return 1.0 / radius;
  map.Problem(key, "config.out_of_range",
              fmt::format("'{}' is {}; at least {} m to the left (positive) or right (negative) was expected", key,
                          radius, kSmallestRadius_m));
  return 1.0 / 1e7;
}

// s rho = A^2: the length over which the curvature changes as it does.
double ReadClothoidLength(const DeclaredMap& keys, double change_1pm) {
  const Map& map = keys.map();
  if (map.Has("a_m") == map.Has("length_m")) {
    map.Problem(map.Has("a_m") ? "a_m" : "", "config.conflicting_keys",
                "a clothoid has either a 'length_m' or a parameter 'a_m'");
    if (!map.Has("a_m")) return 1.0;
  }
  if (!map.Has("a_m")) return keys.RequiredNumber("length_m");
  const double a = keys.RequiredNumber("a_m");
  const double length = a * a * std::fabs(change_1pm);
  if (length >= kLength_m.low && length <= kLength_m.high) return length;
  map.Problem("a_m", fmt::format("'a_m' {} makes the clothoid {:.4g} m long; {} m to {} m was expected", a, length,
                                 kLength_m.low, kLength_m.high));
  return 1.0;
}

// Length and curvatures of one item.
PlanElement ReadElement(const Map& item) {
  PlanElement element;
  const ElementName name = ReadElementName(item);
  if (name.kind.empty()) {
    element.length_m = kLength_m.high;  // so that nothing that stands along it seems to stand behind the road's end
  } else if (name.kind == "line") {
    element.length_m = DeclaredMap(item.Child(name.key), ElementKeys("line")).Number("length_m");
  } else if (name.kind == "arc") {
    const DeclaredMap keys(item.Child(name.key), ElementKeys("arc"));
    const Map& arc = keys.map();
    element.curvature_start_1pm = element.curvature_end_1pm = ReadCurvature(keys, "radius_m");
    if (arc.Has("turn_deg")) {
      const double turn = keys.RequiredNumber("turn_deg") * geometry::kPi / 180.0;
      if (arc.Has("length_m"))
        arc.Problem("turn_deg", "config.conflicting_keys", "an arc has either a 'length_m' or an angle 'turn_deg'");
      element.length_m = turn / std::fabs(element.curvature_start_1pm);
      if (element.length_m > kLength_m.high)
        arc.Problem(
            "turn_deg", "config.out_of_range",
            fmt::format("the arc is {:.4g} m long; at most {} m was expected", element.length_m, kLength_m.high));
      element.length_m = std::min(element.length_m, kLength_m.high);
    } else {
      element.length_m = keys.RequiredNumber("length_m");
    }
  } else {
    const DeclaredMap keys(item.Child(name.key), ElementKeys("clothoid"));
    const Map& clothoid = keys.map();
    if (clothoid.Has("radius_start_m")) element.curvature_start_1pm = ReadCurvature(keys, "radius_start_m");
    if (clothoid.Has("radius_end_m")) element.curvature_end_1pm = ReadCurvature(keys, "radius_end_m");
    if (!clothoid.Has("radius_start_m") && !clothoid.Has("radius_end_m")) {
      clothoid.Problem("", "config.missing_key",
                       "a clothoid needs 'radius_start_m' or 'radius_end_m'; one left out is a straight end");
    }
    element.length_m = ReadClothoidLength(keys, element.curvature_end_1pm - element.curvature_start_1pm);
  }
  return element;
}

// Where an element that has coordinates of its own stands; gaps to the one before are closed or refused.
void ReadPlace(const Map& item, const geometry::PlanPoint& before, bool first, const terrain::GroundMove& move,
               PlanElement& element, AxisReading& axis) {
  const DeclaredMap from(item.Child("from"), ElementKeys("from"));
  Eigen::Vector2d p(from.Number("x_m"), from.Number("y_m"));
  double heading = geometry::WrapAngle(from.Number("heading_deg") * geometry::kPi / 180.0);
  if (move) move(p, heading);
  const double gap = (p - before.p_W).norm(), kink = std::fabs(geometry::WrapAngle(heading - before.heading_rad));
  element.start_W = p;
  element.heading_rad = before.heading_rad + geometry::WrapAngle(heading - before.heading_rad);
  if (first) return;
  if (gap > kGap_m || kink > kMaxKink_rad) {
    item.Problem(
        "from",
        fmt::format("the element begins {:.3f} m and {:.4f} rad away from where the one before ends, at s = {:.3f} m "
                    "({:.3f}, {:.3f}); up to {} m and {} rad are closed",
                    gap, kink, element.s_m, before.p_W.x(), before.p_W.y(), kGap_m, kMaxKink_rad));
  } else if (gap > 1e-6 || kink > 1e-6) {
    axis.warnings.push_back(fmt::format("{}: a gap of {:.4f} m and {:.5f} rad at s = {:.3f} m is closed",
                                        item.Place("from"), gap, kink, element.s_m));
  }
}

void ReadElements(const Map& road, const geometry::PlanPoint& start, const terrain::GroundMove& move,
                  AxisReading& axis) {
  const config::List items = road.Items("axis");
  if (road.Has("axis") && items.size() == 0)
    road.Problem("axis", "config.too_few", "the axis has no elements; at least one was expected");
  geometry::PlanPoint end = start;
  double s = 0.0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Map item = items.At(i);
    PlanElement element = ReadElement(item);
    element.length_m =
        std::clamp(element.length_m, kLength_m.low, kLength_m.high);  // what is outside is a problem already
    element.s_m = s;
    element.start_W = end.p_W;
    element.heading_rad = end.heading_rad;
    if (item.Has("from")) ReadPlace(item, end, i == 0, move, element, axis);
    const double jump = element.curvature_start_1pm - end.curvature_1pm;
    if (i > 0 && std::fabs(jump) > 1e-6 && element.length_m < kLength_m.high) {
      axis.warnings.push_back(
          fmt::format("{}: the curvature jumps by {:.5f} 1/m at s = {:.3f} m", items.Place(i), jump, s));
    }
    end = geometry::PlanAxis::End(element);
    s += element.length_m;
    axis.elements.push_back(element);
  }
}

}  // namespace

AxisReading ReadAxis(const DeclaredMap& declared, const terrain::GroundMove& move) {
  const Map& road = declared.map();
  AxisReading axis;
  if (road.Has("points") && road.Has("axis"))
    road.Problem("points", "config.conflicting_keys", "a road has either an 'axis' of elements or 'points'");
  if (road.Has("points")) {
    ReadPoints(declared.Child("points"), move, axis);
    return axis;
  }
  const DeclaredMap start = declared.Child("start");
  geometry::PlanPoint at;
  at.p_W = {start.Number("x_m"), start.Number("y_m")};
  at.heading_rad = geometry::WrapAngle(start.Number("heading_deg") * geometry::kPi / 180.0);
  if (move && start.map().Has("x_m")) move(at.p_W, at.heading_rad);
  ReadElements(declared.MapWith("axis"), at, move, axis);
  return axis;
}

void Place(std::vector<PlanElement>& elements, double own_s_m, const Eigen::Vector2d& to_W, double heading_rad) {
  if (elements.empty()) return;
  const auto axis = geometry::PlanAxis::Make(elements);
  if (!axis) return;
  const geometry::PlanPoint own = axis->Evaluate(own_s_m);
  const double turn = heading_rad - own.heading_rad;
  const double sine = std::sin(turn), cosine = std::cos(turn);
  for (PlanElement& element : elements) {
    const Eigen::Vector2d away = element.start_W - own.p_W;
    element.start_W = to_W + cosine * away + sine * geometry::Left(away);
    element.heading_rad += turn;
  }
}

}  // namespace rodeira::design
