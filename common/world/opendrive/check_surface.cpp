// SPDX-License-Identifier: Apache-2.0
// What of one road's surface cannot be as the file says it: heights that jump along it, edges that fold in a bend,
// lanes narrower than nothing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/measures.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::CubicTable;
using network::Lane;
using network::LaneSection;
using network::LaneSpan;
using network::Network;
using network::Road;

constexpr double kSharpest = 0.95;  // curvature times the distance of the inner edge, as in world files
constexpr double kNarrow_m = -1e-3;

struct SurfaceChecker {
  const Network& network;
  std::span<const RoadLines> lines;
  const Tolerance& tolerance;
  Findings& findings;

  Finding At(std::size_t road, std::string rule, std::string message, std::optional<double> s_m,
             std::optional<int> lane = {}) const {
    return {std::move(rule), std::move(message), lines[road].road, network.roads()[road].id(), lane, s_m};
  }

  void Elevation(std::size_t index) const {
    const Road& road = network.roads()[index];
    const auto& records = road.spec().elevation.records();
    for (std::size_t i = 1; i < records.size(); ++i) {
      const double s = records[i].from;
      if (!(s > 0.0 && s < road.length_m()) || road.spec().ground != nullptr) continue;
      const double step = records[i].a - records[i - 1].Value(s);
      JudgeStep(At(index, "road.elevation.contact_point",
                   fmt::format("the elevation jumps by {:.4g} m from one record to the next; {}", step,
                               StepWords(step, StepMost(tolerance, tolerance.gap_m))),
                   s),
                step, StepMost(tolerance, tolerance.gap_m), findings);
    }
  }

  // Where bank and cross-section have records, the edges of what is driven on may jump although the elevation does not.
  void Across(std::size_t index) const {
    const Road& road = network.roads()[index];
    if (road.flat() || road.spec().ground != nullptr) return;
    std::set<double> stations;
    const auto add = [&](const CubicTable& table) {
      for (const auto& record : table.records()) stations.insert(record.from);
    };
    const network::LateralProfile& lateral = road.spec().lateral;
    for (const CubicTable* table :
         {&road.spec().superelevation, &lateral.crossfall_left, &lateral.crossfall_right, &lateral.surface.t_offset})
      add(*table);
    for (const auto* side : {&lateral.surface.left, &lateral.surface.right}) {
      for (const network::SurfaceStrip& strip : *side) {
        add(strip.width);
        for (const CubicTable& table : strip.coefficients) add(table);
      }
    }
    for (const double s : stations) {
      if (!(s > 0.0 && s < road.length_m())) continue;
      const double before = std::nextafter(s, 0.0);
      const std::uint32_t number = static_cast<std::uint32_t>(road.SectionIndex(s));
      const LaneSection& section = road.spec().sections[number];
      const geometry::PlanPoint at = road.axis().Evaluate(s);
      const double axis_step = road.spec().elevation.Value(s) - road.spec().elevation.Value(before);
      double most = 0.0, most_t = 0.0;
      for (const auto* side : {&section.left, &section.right}) {
        for (const Lane& lane : *side) {
          const LaneSpan span = *road.SpanAt(number, lane.id, s);
          for (const double t : {span.inner_t_m, span.outer_t_m}) {
            const double step = road.Surface(at, s, t, section, span).p_W.z() -
                                road.Surface(at, before, t, section, span).p_W.z() - axis_step;
            if (network::IsDrivable(lane.type) && std::fabs(step) > std::fabs(most)) most = step, most_t = t;
          }
        }
      }
      JudgeStep(At(index, "road.lateral.contact_point",
                   fmt::format("bank or cross-section jump: the road's surface by {:.4g} m at t {:.4g}; {}", most,
                               most_t, StepWords(most, StepMost(tolerance, LaneGap(tolerance)))),
                   s),
                most, StepMost(tolerance, LaneGap(tolerance)), findings);
    }
  }

  // Bank and cross-section together, at lanes' edges and where a shape has records.
  void Heights(std::size_t index) const {
    const Road& road = network.roads()[index];
    if (road.flat() || road.spec().ground != nullptr) return;
    const double steps = std::clamp(std::ceil(road.length_m()), 1.0, 1e6);
    double most = 0.0, most_s = 0.0, most_t = 0.0;
    const auto ask = [&](double s, double axis_z, double t) {
      const double above = road.Surface(s, t).p_W.z() - axis_z;
      if (!(std::fabs(above) <= std::fabs(most))) most = above, most_s = s, most_t = t;
    };
    for (double i = 0.0; i <= steps; i += 1.0) {
      const double s = road.length_m() * i / steps, axis_z = road.spec().elevation.Value(s);
      const auto number = static_cast<std::uint32_t>(road.SectionIndex(s));
      const LaneSection& section = road.spec().sections[number];
      double right = 0.0, left = 0.0;
      for (const auto* side : {&section.left, &section.right}) {
        for (const Lane& lane : *side) {
          const double t = road.SpanAt(number, lane.id, s)->outer_t_m;
          ask(s, axis_z, t);
          right = std::min(right, t), left = std::max(left, t);
        }
      }
      for (const network::Shape& shape : road.spec().lateral.shapes) {
        for (const auto& record : shape.height.records()) {
          if (record.from > right && record.from < left) ask(s, axis_z, record.from);
        }
      }
    }
    if (std::fabs(most) <= kAboveLine_m) return;
    findings.errors.push_back(
        At(index, "road.lateral.height",
           fmt::format("the road's surface lies {:.6g} m above its line at t {:.4g}; at most {:.6g} m was expected",
                       most, most_t, kAboveLine_m),
           most_s));
  }

  struct Fold {
    double s_m, t_m, curvature_1pm;
  };
  std::optional<Fold> FoldAt(const Road& road, double s, double curvature_1pm, bool drivable) const {
    const auto number = static_cast<std::uint32_t>(road.SectionIndex(s));
    const LaneSection& section = road.spec().sections[number];
    const auto& lanes = curvature_1pm > 0.0 ? section.left : section.right;
    for (const Lane& lane : lanes) {
      if (drivable && !network::IsDrivable(lane.type)) continue;
      const LaneSpan span = *road.SpanAt(number, lane.id, s);
      if (curvature_1pm * span.outer_t_m > kSharpest && span.width_m() > 1e-3)
        return Fold{s, span.outer_t_m, curvature_1pm};
    }
    return std::nullopt;
  }

  // Every metre, and at both ends of each element by its own formula, however short it is.
  std::optional<Fold> FirstFold(const Road& road, bool drivable) const {
    for (const geometry::PlanElement& element : road.axis().elements()) {
      const double end = std::min(element.s_m + element.length_m, road.length_m());
      if (element.kind == geometry::PlanElement::Kind::kClothoid) {
        if (const auto fold = FoldAt(road, element.s_m, element.curvature_start_1pm, drivable)) return fold;
      }
      const int steps = std::max(1, static_cast<int>(std::min(1e6, std::ceil(element.length_m))));
      for (int i = 0; i < steps; ++i) {
        const double s = element.s_m + element.length_m * (i + 0.5) / steps;
        if (s > road.length_m()) break;
        if (const auto fold = FoldAt(road, s, road.axis().Evaluate(s).curvature_1pm, drivable)) return fold;
      }
      if (const auto fold = FoldAt(road, end, geometry::PlanAxis::End(element).curvature_1pm, drivable)) return fold;
    }
    return std::nullopt;
  }

  // One warning a road: of lanes that are driven on where there are any.
  void Folds(std::size_t index) const {
    const Road& road = network.roads()[index];
    auto fold = FirstFold(road, true);
    const bool drivable = fold.has_value();
    if (!fold) fold = FirstFold(road, false);
    if (!fold) return;
    findings.warnings.push_back(
        At(index, "road.lane.fold",
           fmt::format("the edge of the lanes{} {:.2f} m to the {} folds: the bend there has a radius of {:.4g} m",
                       drivable ? " that are driven on" : "", std::fabs(fold->t_m), fold->t_m > 0.0 ? "left" : "right",
                       1.0 / std::fabs(fold->curvature_1pm)),
           fold->s_m));
  }

  void Widths(std::size_t index) const {
    const Road& road = network.roads()[index];
    for (std::uint32_t number = 0; number < road.spec().sections.size(); ++number) {
      const LaneSection& section = road.spec().sections[number];
      for (const auto* side : {&section.left, &section.right}) {
        for (const Lane& lane : *side) {
          double narrowest = kNarrow_m, narrowest_s = -1.0;
          const int steps = std::max(1, static_cast<int>(std::min(1e6, std::ceil(section.end_s_m - section.s_m))));
          for (int i = 0; i <= steps && !lane.width.empty(); ++i) {
            const double s = section.s_m + (section.end_s_m - section.s_m) * i / steps,
                         width = lane.width.Value(s);  // a span has none below 0
            if (width < narrowest) narrowest = width, narrowest_s = s;
          }
          if (narrowest_s < 0.0) continue;
          findings.warnings.push_back(
              {"road.lane.width",
               fmt::format("the lane is {:.4g} m wide here, its narrowest place; 0 or more was expected", narrowest),
               lines[index].sections[number], road.id(), lane.id, narrowest_s});
        }
      }
    }
  }
};

}  // namespace

void CheckSurfaces(const Network& network, std::span<const RoadLines> lines, const Tolerance& tolerance,
                   Findings& findings) {
  const SurfaceChecker checker{network, lines, tolerance, findings};
  for (std::size_t i = 0; i < network.roads().size(); ++i) {
    checker.Elevation(i);
    checker.Across(i);
    checker.Heights(i);
    checker.Folds(i);
    checker.Widths(i);
  }
}

}  // namespace rodeira::opendrive
