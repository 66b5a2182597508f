// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/repair_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/geometry/angle.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::PlanElement;

constexpr double kSameLength = 0.01;  // of a cubic's curve and its element, by the other reading of its range
constexpr double kMinLength_m = 0.01;

double EndOf(const PlanElement& element) { return element.s_m + element.length_m; }

// The road ends where an element does: what lies behind is taken out, its link too.
Repair EndAfter(Source& source, const RoadReading& road, std::size_t last) {
  const double end_m = EndOf(road.elements[last]);
  const Node node(&source, road.lines.node);
  Repair repair{RepairKind::kRoadEnded,
                fmt::format("the road ends there, at s {:.6g}", end_m),
                {node.Set("length", fmt::format("{}", end_m))}};
  for (std::size_t i = last + 1; i < road.elements.size(); ++i)
    repair.edits.push_back(Node(&source, road.lines.element_nodes[i]).Remove());
  for (std::size_t i = 1; i < road.spec.sections.size(); ++i) {
    const pugi::xml_node section = road.lines.section_nodes[i];
    if (road.spec.sections[i].s_m >= end_m - kMinLength_m && section)
      repair.edits.push_back(Node(&source, section).Remove());
  }
  if (const Node link = node.Child("link").Child("successor")) repair.edits.push_back(link.Remove());
  return repair;
}

std::string Numbers(const PlanElement& element) {
  return fmt::format("s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"", element.s_m, element.start_W.x(),
                     element.start_W.y(), element.heading_rad, element.length_m);
}

double HeadingOf(const PlanElement& element) {
  return element.kind == PlanElement::Kind::kCubic ? element.heading_rad + std::atan2(element.v[1], element.u[1])
                                                   : element.heading_rad;
}

// The cubic from one place and heading to another, as an element of a file.
std::string Bridge(double s_m, double length_m, const geometry::PlanPoint& from, const PlanElement& to) {
  const double heading = from.heading_rad, turned = geometry::WrapAngle(HeadingOf(to) - heading);
  const Eigen::Vector2d between = to.start_W - from.p_W, along(std::cos(heading), std::sin(heading));
  const double u = between.dot(along), v = between.dot(Eigen::Vector2d(-along.y(), along.x()));
  const double far = std::hypot(u, v), out_u = far * std::cos(turned), out_v = far * std::sin(turned);
  PlanElement element;
  element.s_m = s_m, element.start_W = from.p_W, element.heading_rad = heading, element.length_m = length_m;
  return fmt::format(
      "<geometry {}><paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"{}\" cU=\"{}\" dU=\"{}\" aV=\"0\" bV=\"0\" "
      "cV=\"{}\" dV=\"{}\"/></geometry>",
      Numbers(element), far, 3.0 * u - 2.0 * far - out_u, far + out_u - 2.0 * u, 3.0 * v - out_v, out_v - 2.0 * v);
}

// The first part of a cubic element, `length_m` long. Its own stations go with the curve's length.
PlanElement FirstPart(const PlanElement& cubic, double length_m) {
  const double wanted_m = geometry::CubicLength(cubic, cubic.p_end) * length_m / cubic.length_m;
  double low = 0.0, high = cubic.p_end;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (geometry::CubicLength(cubic, middle) < wanted_m ? low : high) = middle;
  }
  PlanElement part = cubic;
  part.length_m = length_m, part.p_end = 1.0;
  double power = 1.0;
  for (std::size_t i = 0; i < 4; ++i, power *= low) part.u[i] *= power, part.v[i] *= power;
  return part;
}

std::string KindText(const PlanElement& element) {
  if (element.kind == PlanElement::Kind::kCubic) {
    const auto &u = element.u, &v = element.v;
    return fmt::format(
        "<paramPoly3 pRange=\"normalized\" aU=\"{}\" bU=\"{}\" cU=\"{}\" dU=\"{}\" aV=\"{}\" bV=\"{}\" cV=\"{}\" "
        "dV=\"{}\"/>",
        u[0], u[1], u[2], u[3], v[0], v[1], v[2], v[3]);
  }
  if (element.curvature_start_1pm != element.curvature_end_1pm)
    return fmt::format("<spiral curvStart=\"{}\" curvEnd=\"{}\"/>", element.curvature_start_1pm,
                       element.curvature_end_1pm);
  if (element.curvature_start_1pm != 0.0) return fmt::format("<arc curvature=\"{}\"/>", element.curvature_start_1pm);
  return "<line/>";
}

}  // namespace

Repair GapRepair(Source& source, const RoadReading& road, std::size_t next) {
  const PlanElement &before = road.elements[next - 1], &element = road.elements[next];
  const geometry::PlanPoint end = geometry::PlanAxis::End(before);
  const Eigen::Vector2d gap = element.start_W - end.p_W, along(std::cos(end.heading_rad), std::sin(end.heading_rad));
  const double ahead_m = gap.dot(along), aside_m = gap.dot(Eigen::Vector2d(-along.y(), along.x()));
  if (std::fabs(ahead_m) > kBridgedAlong_m || std::fabs(aside_m) > kBridgedAcross_m ||
      before.length_m < 2.0 * std::fabs(ahead_m))
    return EndAfter(source, road, next - 1);
  const std::string done = "it is bridged";
  const Node node(&source, road.lines.element_nodes[next - 1]);
  const bool is_cubic = before.kind == PlanElement::Kind::kCubic;
  if (before.length_m <= (is_cubic ? 2.0 : 1.0) * kBridge_m) {
    geometry::PlanPoint start;
    start.p_W = before.start_W, start.heading_rad = HeadingOf(before);
    return {RepairKind::kGapBridged, done, {node.Replace(Bridge(before.s_m, before.length_m, start, element))}};
  }
  PlanElement kept = before;
  if (is_cubic) {
    kept = FirstPart(before, before.length_m - kBridge_m);
  } else {
    kept.length_m = before.length_m - kBridge_m;
    kept.curvature_end_1pm = before.curvature_start_1pm +
                             (before.curvature_end_1pm - before.curvature_start_1pm) * kept.length_m / before.length_m;
  }
  return {RepairKind::kGapBridged,
          done,
          {node.Replace(fmt::format("<geometry {}>{}</geometry>", Numbers(kept), KindText(kept)) +
                        Bridge(EndOf(kept), kBridge_m, geometry::PlanAxis::End(kept), element))}};
}

Repair KinkRepair(Source& source, const RoadReading& road, std::size_t next, double kink_rad) {
  if (kink_rad > kFolded_rad) return EndAfter(source, road, next - 1);
  return {RepairKind::kKinkRounded,
          fmt::format("it is driven within 1 m, with a mean radius of {:.3g} m", 1.0 / kink_rad)};
}

Repair StationRepair(Source& source, const RoadReading& road, std::size_t next) {
  const PlanElement &before = road.elements[next - 1], &element = road.elements[next];
  if (std::fabs(element.s_m - EndOf(before)) <= kBridgedAlong_m)
    return {RepairKind::kIgnored, "it counts from there on"};
  // Where the line itself goes on, the stations behind are counted anew.
  Repair repair{RepairKind::kStationMoved, "the elements behind are counted on", {}};
  double s_m = EndOf(before);
  for (std::size_t i = next; i < road.elements.size(); ++i) {
    repair.edits.push_back(Node(&source, road.lines.element_nodes[i]).Set("s", fmt::format("{}", s_m)));
    s_m += road.elements[i].length_m;
  }
  repair.edits.push_back(Node(&source, road.lines.node).Set("length", fmt::format("{}", s_m)));
  return repair;
}

Repair CubicRepair(Source& source, const RoadReading& road, std::size_t index) {
  PlanElement element = road.elements[index];
  const Node node(&source, road.lines.element_nodes[index]);
  const Node cubic = node.Child("paramPoly3");
  if (cubic) {
    const bool by_length = cubic.Text("pRange", "normalized") == "arcLength";
    const double other_end = by_length ? 1.0 : element.length_m;
    const double curve_m = geometry::CubicLength(element, other_end);
    if (std::fabs(curve_m - element.length_m) <= kSameLength * element.length_m) {
      const char* range = by_length ? "normalized" : "arcLength";
      return {RepairKind::kRangeSwapped,
              fmt::format("its range is read as '{}', by which it is", range),
              {cubic.Set("pRange", range)}};
    }
  }
  return TakeOut(node);
}

Repair LengthRepair(Source& source, const RoadReading& road) {
  return {RepairKind::kLengthSet,
          "the elements count",
          {Node(&source, road.lines.node).Set("length", fmt::format("{}", EndOf(road.elements.back())))}};
}

Repair SectionRepair(Source& source, const RoadReading& road, std::size_t section) {
  if (!road.lines.section_nodes[section]) return {};
  const Node node(&source, road.lines.section_nodes[section]);
  if (section == 0) return {RepairKind::kStationMoved, "it begins with the road", {node.Set("s", "0")}};
  return {RepairKind::kSectionDropped, "the section is passed over", {node.Remove()}};
}

}  // namespace rodeira::opendrive
