// SPDX-License-Identifier: Apache-2.0
// Where reference lines' curvature jumps. OpenDRIVE allows it and files are full of it, so each road is told of once.
#include <fmt/format.h>

#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::PlanElement;
using network::End;
using network::Network;
using network::Road;

constexpr double kTold_1pm = 1e-4;  // a radius of 10 km beside a straight; less is what the digits of files leave
constexpr double kToldOfCubics_1pm = 2e-3;  // cubics are fits to something smooth, and meet no better

double StartCurvature(const PlanElement& element) {
  if (element.kind == PlanElement::Kind::kClothoid) return element.curvature_start_1pm;
  const Eigen::Vector2d first(element.u[1], element.v[1]), second(2.0 * element.u[2], 2.0 * element.v[2]);
  return geometry::Cross(first, second) / std::pow(first.norm(), 3);
}

bool IsJump(double jump_1pm, const PlanElement& a, const PlanElement& b) {
  const bool cubic = a.kind == PlanElement::Kind::kCubic || b.kind == PlanElement::Kind::kCubic;
  return std::fabs(jump_1pm) > (cubic ? kToldOfCubics_1pm : kTold_1pm);
}

// The jumps of one road, of which the largest is told.
struct Jumps {
  Finding most{"road.geometry.curvature", "", 0, "", {}, {}};
  double largest_1pm = 0.0;
  std::string at;
  int places = 0;

  void Take(double jump_1pm, double s_m, std::size_t line, std::string where = "") {
    ++places;
    if (std::fabs(jump_1pm) <= std::fabs(largest_1pm)) return;
    largest_1pm = jump_1pm, most.s_m = s_m, most.line = line, at = std::move(where);
  }
};

struct Ended {
  const PlanElement& element;
  double curvature_1pm;  // as seen along s
};

Ended Of(const Road& road, End end) {
  const auto& elements = road.axis().elements();
  if (end == End::kStart) return {elements.front(), StartCurvature(elements.front())};
  return {elements.back(), geometry::PlanAxis::End(elements.back()).curvature_1pm};
}

// From a road into the next one. In and out of junctions lanes go on, and reference lines need not.
void AtLink(const Network& network, std::size_t index, End end, std::size_t line, Jumps& jumps) {
  const Road& road = network.roads()[index];
  const auto& link = end == End::kStart ? road.spec().predecessor : road.spec().successor;
  const auto other = link && !link->junction ? network.FindRoad(link->id) : std::nullopt;
  if (!other || !road.spec().junction.empty()) return;
  const Road& next = network.roads()[*other];
  const auto& back = link->contact == End::kStart ? next.spec().predecessor : next.spec().successor;
  const bool told_by_other = back && !back->junction && back->id == road.id() && back->contact == end &&
                             std::pair(std::size_t{*other}, link->contact) < std::pair(index, end);
  if (!next.spec().junction.empty() || told_by_other) return;
  const Ended out = Of(road, end), in = Of(next, link->contact);
  const double turned = end == link->contact ? -1.0 : 1.0;
  const double jump_1pm = (turned * in.curvature_1pm - out.curvature_1pm) * (end == End::kEnd ? 1.0 : -1.0);
  if (IsJump(jump_1pm, out.element, in.element))
    jumps.Take(jump_1pm, end == End::kStart ? 0.0 : road.length_m(), line, fmt::format(" to road {}", next.id()));
}

}  // namespace

void TellCurvatureJumps(const Network& network, std::span<const RoadLines> lines, Findings& findings) {
  for (std::size_t index = 0; index < network.roads().size(); ++index) {
    const Road& road = network.roads()[index];
    const auto& elements = road.axis().elements();
    Jumps jumps;
    jumps.most.road = road.id();
    for (std::size_t i = 1; i < elements.size(); ++i) {
      const double jump_1pm = StartCurvature(elements[i]) - geometry::PlanAxis::End(elements[i - 1]).curvature_1pm;
      if (IsJump(jump_1pm, elements[i], elements[i - 1]))
        jumps.Take(jump_1pm, elements[i].s_m, lines[index].elements[i]);
    }
    for (const End end : {End::kStart, End::kEnd}) AtLink(network, index, end, lines[index].road, jumps);
    if (jumps.places == 0) continue;
    jumps.most.message = fmt::format("the curvature jumps by {:.5f} 1/m{}", jumps.largest_1pm, jumps.at);
    if (jumps.places > 1) jumps.most.message += fmt::format(", the largest of {} jumps of the road", jumps.places);
    findings.warnings.push_back(std::move(jumps.most));
  }
}

}  // namespace rodeira::opendrive
