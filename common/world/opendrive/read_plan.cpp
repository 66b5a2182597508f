// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
               fmt::format("pRange is '{}'; arcLength or normalized was expected", range),
               {RepairKind::kValueReplaced, "it is read as normalized", {poly.Set("pRange", "normalized")}});
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
    geometry.Wrong("road.geometry.one_element", "<geometry> has none of line, arc, spiral, poly3 and paramPoly3",
                   {RepairKind::kReadAsLine, "it is read as a line", {geometry.Append("<line/>")}});
  }
}

Repair ElementsInOrder(const std::vector<Node>& nodes) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return nodes[a].xml().attribute("s").as_double() < nodes[b].xml().attribute("s").as_double();
  });
  return {RepairKind::kSorted, "they are read in the order of s", Reorder(nodes, order)};
}

// None of the road's elements has a length: the first is a line as long as the road.
void TellNoElements(const Node& road) {
  const std::vector<Node> nodes = road.Child("planView").Children("geometry");
  const double length_m = road.xml().attribute("length").as_double();
  if (nodes.empty() || !(length_m > 1e-9)) return road.Wrong("road.geometry.one_element", "the road has no plan view");
  const auto number = [&](const char* name) { return nodes.front().Text(name, "0"); };
  std::vector<Edit> edits{nodes.front().Replace(
      fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", number("x"),
                  number("y"), number("hdg"), length_m))};
  for (std::size_t i = 1; i < nodes.size(); ++i) edits.push_back(nodes[i].Remove());
  nodes.front().Wrong(
      "road.geometry.length",
      fmt::format("none of the road's {} elements has a length; the road is {:.6g} m long", nodes.size(), length_m),
      {RepairKind::kReadAsLine, "it is read as a line of the road's length", std::move(edits)});
}

// An element without length, where it stands.
struct EmptyElement {
  std::size_t line;
  double s_m;
};

void TellWithoutLength(Source& source, const std::vector<EmptyElement>& elements) {
  for (const EmptyElement& each : elements) {
    source.warnings.push_back({"road.geometry.length", "an element has no length: it is passed over", each.line,
                               source.where.road, std::nullopt, each.s_m});
  }
}

}  // namespace

std::vector<PlanElement> ReadPlanView(const Node& road, RoadLines& lines) {
  std::vector<PlanElement> elements;
  std::vector<EmptyElement> without_length;
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
                                 element.start_W.x(), element.start_W.y(), element.length_m),
                     TakeOut(road));
      continue;
    }
    if (element.length_m < 0.0)
      geometry.Wrong("road.geometry.length", fmt::format("an element is {} m long", element.length_m),
                     {RepairKind::kElementDropped, "it is passed over", {geometry.Remove()}, "geometry"});
    if (!(element.length_m > 1e-9)) {  // nothing of it can be driven on
      if (element.length_m >= 0.0) without_length.push_back({geometry.line(), element.s_m});
      continue;
    }
    ReadKind(geometry, element);
    if (!elements.empty() && element.s_m < elements.back().s_m) {
      geometry.Wrong("road.geometry.elem_asc_order",
                     fmt::format("a <geometry> of s {:.6g} stands behind one of s {:.6g}; ascending order was expected",
                                 element.s_m, elements.back().s_m),
                     ElementsInOrder(road.Child("planView").Children("geometry")));
    }
    const double turned_rad =
        0.5 * std::fabs(element.curvature_start_1pm + element.curvature_end_1pm) * element.length_m;
    if (element.kind == PlanElement::Kind::kClothoid && turned_rad > 2.0 * geometry::kPi * kMaxTurns) {
      geometry.Wrong("road.geometry.shape", fmt::format("this element turns {:.4g} times; at most {:.4g} were expected",
                                                        turned_rad / (2.0 * geometry::kPi), kMaxTurns));
    } else if (!(std::hypot(element.u[0], element.v[0]) < 0.5 * network::Network::kFarthest_m)) {
      geometry.Wrong(
          "road.geometry.position",
          fmt::format("this element's curve begins {:.6g} m from where the element does, beyond all that can "
                      "be surveyed",
                      std::hypot(element.u[0], element.v[0])));
    } else if (!geometry::PlanAxis::Make({element})) {
      geometry.Wrong("road.geometry.shape", "this element stands still somewhere, or turns or is longer than any road");
    }
    elements.push_back(element);
    lines.elements.push_back(geometry.line());
    lines.element_nodes.push_back(geometry.xml());
  }
  if (elements.empty() && road.source().errors.size() == before) TellNoElements(road);
  if (!elements.empty()) TellWithoutLength(road.source(), without_length);
  return elements;
}

}  // namespace rodeira::opendrive
