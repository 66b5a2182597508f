// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/repair_plan.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::PlanElement;

constexpr double kRounding = 1e-9;     // what the sixteen digits of a file leave
constexpr double kNoGap = 1e-6;        // m and rad: what ASAM's checker passes is not worth a word
constexpr double kCubicLength = 1e-3;  // a cubic's length against its curve's
constexpr double kSparse = 0.5;        // more than half of the length off: the file says nonsense

// A gap or a kink between neighbours: nothing, a warning or an error, which is repaired.
template <class MakeRepair>
void Judge(Finding finding, double found, double allowed, Findings& findings, const MakeRepair& repair,
           double told = kRounding) {
  if (found > allowed) {
    finding.repair = repair();
    findings.errors.push_back(std::move(finding));
  } else if (found > told) {
    findings.warnings.push_back(std::move(finding));
  }
}

}  // namespace

std::string GapWords(double found, double most, double asam, std::string_view unit) {
  if (found > most) return fmt::format("at most {:.3g} {} was expected", most, unit);
  return fmt::format("it is closed, as up to {:.3g} {} are (by ASAM at most {:.3g})", most, unit, asam);
}

void CheckPlan(const RoadReading& road, const Tolerance& tolerance, Findings& findings) {
  const auto& elements = road.elements;
  const Tolerance strict = Tolerance::Strict();
  Source& source = *findings.source;
  bool is_counted = true;  // each element begins where the one before ends
  const auto first_node = [&] { return Node(&source, road.lines.element_nodes.front()); };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const PlanElement& element = elements[i];
    Finding finding{"", "", road.lines.elements[i], road.spec.id, std::nullopt, element.s_m};
    if (element.kind == PlanElement::Kind::kCubic) {
      const double curve = geometry::CubicLength(element, element.p_end);
      const double off = std::fabs(curve - element.length_m);
      finding.rule = "road.geometry.paramPoly3.length_match";
      finding.message = fmt::format("the curve is {:.6g} m long, the element says {:.6g} m", curve, element.length_m);
      Judge(
          finding, off, tolerance.strict ? kCubicLength : kSparse * element.length_m, findings,
          [&] { return CubicRepair(source, road, i); }, kCubicLength);
    }
    if (i == 0) {
      finding.rule = "road.geometry.elem_asc_order";
      finding.message = fmt::format("the first element begins at s {:.6g}; 0 was expected", element.s_m);
      Judge(finding, std::fabs(element.s_m), tolerance.gap_m, findings, [&] {
        return Repair{RepairKind::kStationMoved, "it begins with the road", {first_node().Set("s", "0")}};
      });
      continue;
    }
    const PlanElement& before = elements[i - 1];
    const double step = element.s_m - (before.s_m + before.length_m);
    finding.rule = "road.geometry.contact_s";
    finding.message = fmt::format("the element before ends at s {:.9g}, this one begins at {:.9g}",
                                  before.s_m + before.length_m, element.s_m);
    Judge(finding, std::fabs(step), tolerance.gap_m, findings, [&] { return StationRepair(source, road, i); });
    is_counted = is_counted && std::fabs(step) <= kBridgedAlong_m;
    const geometry::PlanPoint end = geometry::PlanAxis::End(before);
    const double gap = (end.p_W - element.start_W).norm();
    finding.rule = "road.geometry.contact_point";
    finding.message = fmt::format("a gap of {:.4g} m to the element before; {}", gap,
                                  GapWords(gap, tolerance.gap_m, strict.gap_m, "m"));
    Judge(
        finding, gap, tolerance.gap_m, findings, [&] { return GapRepair(source, road, i); }, kNoGap);
    const double heading = element.kind == PlanElement::Kind::kCubic
                               ? element.heading_rad + std::atan2(element.v[1], element.u[1])
                               : element.heading_rad;
    const double kink = std::fabs(geometry::WrapAngle(heading - end.heading_rad));
    finding.rule = "road.geometry.contact_heading";
    finding.message = fmt::format("a kink of {:.4g} rad from the element before; {}", kink,
                                  GapWords(kink, tolerance.kink_rad, strict.kink_rad, "rad"));
    Judge(
        finding, kink, tolerance.kink_rad, findings, [&] { return KinkRepair(source, road, i, kink); }, kNoGap);
  }
  if (elements.empty()) return;
  const double end = elements.back().s_m + elements.back().length_m;
  Finding finding{"road.length",
                  fmt::format("the road says {:.9g} m, its elements have {:.9g} m", road.spec.length_m, end),
                  road.lines.road,
                  road.spec.id,
                  {},
                  {}};
  // Elements that are counted anew bring the road's length with them.
  if (is_counted || !tolerance.repair) {
    Judge(finding, std::fabs(road.spec.length_m - end), tolerance.gap_m, findings,
          [&] { return LengthRepair(source, road); });
  }
  for (std::size_t i = 0; i < road.spec.sections.size(); ++i) {
    const double s = road.spec.sections[i].s_m;
    finding = {"road.lane.lane_section.s", "", road.lines.sections[i], road.spec.id, std::nullopt, s};
    finding.message = fmt::format("a lane section begins at s {:.6g}; the road is {:.6g} m long", s,
                                  std::min(road.spec.length_m, end));
    finding.repair = SectionRepair(source, road, i);
    if (s < -kRounding || s > std::min(road.spec.length_m, end) + kRounding) findings.errors.push_back(finding);
    if (i == 0 && s > tolerance.gap_m) {
      finding.message = fmt::format("the first lane section begins at s {:.6g}; 0 was expected", s);
      findings.errors.push_back(finding);
    }
  }
}

}  // namespace rodeira::opendrive
