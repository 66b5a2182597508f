// Where a reference line's curvature jumps. OpenDRIVE allows it and files are full of it, so the file is told of once.
#include <fmt/format.h>

#include <cmath>

#include "common/geometry/plane.hpp"
#include "common/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::PlanElement;

constexpr double kTold_1pm = 1e-4;       // a radius of 10 km beside a straight; less is what the digits of files leave
constexpr double kToldOfCubics_1pm = 2e-3;  // cubics are fits to something smooth, and meet no better

double StartCurvature(const PlanElement& element) {
  if (element.kind == PlanElement::Kind::kClothoid) return element.curvature_start_1pm;
  const Eigen::Vector2d first(element.u[1], element.v[1]), second(2.0 * element.u[2], 2.0 * element.v[2]);
  return geometry::Cross(first, second) / std::pow(first.norm(), 3);
}

}  // namespace

void TellCurvatureJumps(std::span<const RoadReading> roads, Findings& findings) {
  Finding most{"road.geometry.curvature", "", 0, "", {}, {}};
  double largest_1pm = 0.0;
  int places = 0;
  for (const RoadReading& road : roads) {
    for (std::size_t i = 1; i < road.elements.size(); ++i) {
      const double jump_1pm = StartCurvature(road.elements[i]) - geometry::PlanAxis::End(road.elements[i - 1]).curvature_1pm;
      const bool cubic = road.elements[i].kind == PlanElement::Kind::kCubic || road.elements[i - 1].kind == PlanElement::Kind::kCubic;
      if (!(std::fabs(jump_1pm) > (cubic ? kToldOfCubics_1pm : kTold_1pm))) continue;
      ++places;
      if (std::fabs(jump_1pm) <= std::fabs(largest_1pm)) continue;
      largest_1pm = jump_1pm;
      most.road = road.spec.id, most.line = road.lines.elements[i], most.s_m = road.elements[i].s_m;
    }
  }
  if (places == 0) return;
  most.message = fmt::format("the curvature jumps by {:.5f} 1/m", largest_1pm);
  if (places > 1) most.message += fmt::format(", the largest of {} jumps in the file", places);
  findings.warnings.push_back(most);
}

}  // namespace rodeira::opendrive
