// SPDX-License-Identifier: Apache-2.0
// The nearest point of a plan curve: which panels come into question (a grid within reach, a tree beyond), and the
// exact foot on one panel.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/geometry/plan_curve.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

double SquaredDistanceToBox(const Eigen::Vector2d& p, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const double dx = std::max({low.x() - p.x(), 0.0, p.x() - high.x()});
  const double dy = std::max({low.y() - p.y(), 0.0, p.y() - high.y()});
  return dx * dx + dy * dy;
}

}  // namespace

void PlanCurve::BuildTree() {
  const auto count = static_cast<std::uint32_t>(panels_.size());
  tree_.resize(2 * std::size_t{count} - 1);
  // Pre-order: the left half of a range follows its node, the right half follows all of the left.
  const auto build = [&](const auto& self, std::size_t node, std::uint32_t begin, std::uint32_t end) -> void {
    Box& box = tree_[node];
    if (end - begin == 1) {
      const Panel& panel = panels_[begin];
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(panel.bulge_m + kSearchMargin_m);
      box.low = panel.begin_W.cwiseMin(panel.end_W) - margin;
      box.high = panel.begin_W.cwiseMax(panel.end_W) + margin;
      return;
    }
    const std::uint32_t middle = begin + (end - begin) / 2;
    const std::size_t right = node + 2 * std::size_t{middle - begin};
    self(self, node + 1, begin, middle);
    self(self, right, middle, end);
    box.low = tree_[node + 1].low.cwiseMin(tree_[right].low);
    box.high = tree_[node + 1].high.cwiseMax(tree_[right].high);
  };
  build(build, 0, 0, count);
  low_W_ = tree_[0].low;
  high_W_ = tree_[0].high;
}

void PlanCurve::BuildGrid() {
  std::vector<Chord> chords;
  for (const Panel& panel : panels_) chords.push_back({panel.begin_W, panel.end_W, panel.bulge_m});
  grid_ = NearGrid(chords, reach_m_);
}

bool PlanCurve::MayReach(double x_m, double y_m) const { return !grid_.Candidates(x_m, y_m).empty(); }

void PlanCurve::Nearest(const Eigen::Vector2d& p, std::uint32_t index, Best& best) const {
  const PanelFoot foot = panels_[index].Nearest(p);
  if (foot.squared_m2 < best.squared_m2 || (foot.squared_m2 == best.squared_m2 && index < best.panel))
    best = {foot.squared_m2, index, foot.u_m};
}

void PlanCurve::NearestInTree(const Eigen::Vector2d& p, std::size_t node, std::uint32_t begin, std::uint32_t end,
                              Best& best) const {
  if (end - begin == 1) return Nearest(p, begin, best);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const std::size_t left = node + 1;
  const std::size_t right = node + 2 * std::size_t{middle - begin};
  const double left_m2 = SquaredDistanceToBox(p, tree_[left].low, tree_[left].high);
  const double right_m2 = SquaredDistanceToBox(p, tree_[right].low, tree_[right].high);
  const auto visit_left = [&] {
    if (left_m2 <= best.squared_m2) NearestInTree(p, left, begin, middle, best);
  };
  const auto visit_right = [&] {
    if (right_m2 <= best.squared_m2) NearestInTree(p, right, middle, end, best);
  };
  if (left_m2 <= right_m2)
    visit_left(), visit_right();
  else
    visit_right(), visit_left();
}

Foot PlanCurve::FootAt(const Eigen::Vector2d& p, const Best& best) const {
  const Panel& panel = panels_[best.panel];
  Foot foot;
  foot.at = panel.At(best.u_m);
  foot.s_m = std::clamp(panel.middle_s_m + best.u_m, 0.0, length_m_);
  const Eigen::Vector2d away = p - foot.at.p_W;
  foot.t_m = foot.at.tangent_W.x() * away.y() - foot.at.tangent_W.y() * away.x();
  foot.distance_m = std::sqrt(best.squared_m2);
  const double along = foot.at.tangent_W.dot(away);
  if (best.panel == 0 && best.u_m == -panel.half_m) foot.s_m = 0.0, foot.beyond_m = std::min(along, 0.0);
  if (best.panel + 1 == panels_.size() && best.u_m == panel.half_m)
    foot.s_m = length_m_, foot.beyond_m = std::max(along, 0.0);
  return foot;
}

Foot PlanCurve::Project(double x_m, double y_m) const {
  const Eigen::Vector2d p(x_m, y_m);
  Best best{std::numeric_limits<double>::infinity(), 0, 0.0};
  const auto candidates = grid_.Candidates(x_m, y_m);
  for (const std::uint32_t panel : candidates) Nearest(p, panel, best);
  if (candidates.empty()) NearestInTree(p, 0, 0, static_cast<std::uint32_t>(panels_.size()), best);
  return FootAt(p, best);
}

}  // namespace rodeira::geometry
