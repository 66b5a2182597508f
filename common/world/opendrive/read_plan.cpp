// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/world/opendrive/measures.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::PlanElement;

void ReadPoly3(const Node& poly, PlanElement& element) {
  element.kind = PlanElement::Kind::kCubic;
  element.u = {0.0, 1.0, 0.0, 0.0};
  element.v = {poly.Number("a"), poly.Number("b"), poly.Number("c"), poly.Number("d")};
  element.p_end = geometry::GraphEnd(element);
}

void ReadParamPoly3(const Node& poly, PlanElement& element) {
  element.kind = PlanElement::Kind::kCubic;
  element.u = {poly.Number("aU"), poly.Number("bU"), poly.Number("cU"), poly.Number("dU")};
  element.v = {poly.Number("aV"), poly.Number("bV"), poly.Number("cV"), poly.Number("dV")};
  const std::string range = poly.Text("pRange", "normalized");
  if (range != "normalized" && range != "arcLength") {
    poly.Wrong("road.geometry.paramPoly3.range",
               fmt::format("pRange is '{}'; arcLength or normalized was expected", range));
  }
  element.p_end = range == "arcLength" ? element.length_m : 1.0;
}

void ReadKind(const Node& geometry, PlanElement& element) {
  if (geometry.Child("line")) return;
  if (const Node arc = geometry.Child("arc")) {
    element.curvature_start_1pm = element.curvature_end_1pm = arc.Number("curvature");
  } else if (const Node spiral = geometry.Child("spiral")) {
    element.curvature_start_1pm = spiral.Number("curvStart");
    element.curvature_end_1pm = spiral.Number("curvEnd");
  } else if (const Node poly3 = geometry.Child("poly3")) {
    ReadPoly3(poly3, element);
  } else if (const Node poly = geometry.Child("paramPoly3")) {
    ReadParamPoly3(poly, element);
  } else {
    geometry.Wrong("road.geometry.one_element", "<geometry> has none of line, arc, spiral, poly3 and paramPoly3");
  }
}

}  // namespace

std::vector<PlanElement> ReadPlanView(const Node& road, RoadLines& lines) {
  std::vector<PlanElement> elements;
  const std::size_t before = road.source().errors.size();
  for (const Node& geometry : road.Child("planView").Children("geometry")) {
    Within within(geometry.source());
    PlanElement element;
    element.s_m = geometry.Number("s");
    geometry.source().where.s_m = element.s_m;
    element.start_W = {geometry.Number("x"), geometry.Number("y")};
    element.heading_rad = geometry.Number("hdg");
    element.length_m = geometry.Number("length");
    if (!(element.start_W.cwiseAbs().maxCoeff() + element.length_m < 0.5 * network::Network::kFarthest_m)) {
      geometry.Wrong("road.geometry.position",
                     fmt::format("an element at ({:.6g}, {:.6g}) of {:.6g} m lies beyond all that can be surveyed",
                                 element.start_W.x(), element.start_W.y(), element.length_m));
      continue;
    }
    if (element.length_m < 0.0)
      geometry.Wrong("road.geometry.length", fmt::format("an element is {} m long", element.length_m));
    if (!(element.length_m > 1e-9)) continue;  // nothing of it can be driven on
    ReadKind(geometry, element);
    if (!elements.empty() && element.s_m < elements.back().s_m) {
      geometry.Wrong("road.geometry.elem_asc_order",
                     fmt::format("a <geometry> of s {:.6g} stands behind one of s {:.6g}; ascending order was expected",
                                 element.s_m, elements.back().s_m));
    }
    const double turned_rad =
        0.5 * std::fabs(element.curvature_start_1pm + element.curvature_end_1pm) * element.length_m;
    if (element.kind == PlanElement::Kind::kClothoid && turned_rad > 2.0 * geometry::kPi * kMostTurns) {
      geometry.Wrong("road.geometry.shape", fmt::format("this element turns {:.4g} times; at most {:.4g} were expected",
                                                        turned_rad / (2.0 * geometry::kPi), kMostTurns));
    } else if (!geometry::PlanAxis::Make({element})) {
      geometry.Wrong("road.geometry.shape", "this element stands still somewhere, or turns or is longer than any road");
    }
    elements.push_back(element);
    lines.elements.push_back(geometry.line());
  }
  if (elements.empty() && road.source().errors.size() == before)
    road.Wrong("road.geometry.one_element", "the road has no plan view");
  return elements;
}

}  // namespace rodeira::opendrive
