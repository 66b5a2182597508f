// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/ribbon.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/road/stations.hpp"

namespace rodeira::scene {
namespace {

constexpr int kEndRows = 6;  // lines past an end of the road, over its blend

}  // namespace

std::array<Eigen::Vector2d, 4> Ribbon::Quad(std::size_t i) const {
  return {lines[i].At(right_t_m), lines[i + 1].At(right_t_m), lines[i + 1].At(left_t_m), lines[i].At(left_t_m)};
}

Ribbon LayRibbon(const road::Road& road, const RoadTolerance& tolerance) {
  Ribbon ribbon;
  ribbon.right_t_m = road.section().blend_right_m();
  ribbon.left_t_m = road.section().blend_left_m();
  const double blend = road.section().spec().blend_m;
  const auto add = [&](double s, double beyond) {
    const geometry::PlanPoint at = road.plan().Evaluate(s);
    ribbon.lines.push_back({s, beyond, at.p_W + beyond * at.tangent_W, at.left_W()});
  };
  for (int k = kEndRows; k > 0; --k) add(0.0, -blend * k / kEndRows);
  ribbon.first = ribbon.lines.size();
  for (const double s : road::Stations(road, tolerance.chord_m, tolerance.longest_m)) add(s, 0.0);
  ribbon.last = ribbon.lines.size() - 1;
  for (int k = 1; k <= kEndRows; ++k) add(road.length_m(), blend * k / kEndRows);
  return ribbon;
}

}  // namespace rodeira::scene
