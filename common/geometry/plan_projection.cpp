// The nearest point of a plan curve: which panels come into question (a grid within reach, a tree beyond), and the
// exact foot on one panel.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry/plan_curve.hpp"

namespace rodeira::geometry {
namespace {

constexpr double kSlack_m = 1e-6;  // far above all rounding: no panel that could be the nearest is left out
constexpr double kSmallestCell_m = 4.0;
constexpr double kMostCells = 4e6;

double SquaredDistanceToBox(const Eigen::Vector2d& p, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const double dx = std::max({low.x() - p.x(), 0.0, p.x() - high.x()});
  const double dy = std::max({low.y() - p.y(), 0.0, p.y() - high.y()});
  return dx * dx + dy * dy;
}

double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double u = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - u * along).norm();
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
      const Eigen::Vector2d margin = Eigen::Vector2d::Constant(panel.bulge_m + kSlack_m);
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
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m_);
  const Eigen::Vector2d size = high_W_ - low_W_ + 2.0 * reach;
  grid_.origin_W = low_W_ - reach;
  grid_.cell_m = std::max(kSmallestCell_m, std::sqrt(size.x() * size.y() / kMostCells));
  grid_.columns = static_cast<int>(size.x() / grid_.cell_m) + 1;
  grid_.rows = static_cast<int>(size.y() / grid_.cell_m) + 1;
  const std::size_t cells = static_cast<std::size_t>(grid_.columns) * grid_.rows;
  const double half_diagonal = grid_.cell_m * std::sqrt(0.5);
  // Calls visit(cell, panel, distance from the cell's centre to the panel's chord) for all pairs that may matter.
  const auto for_near = [&](const auto& visit) {
    for (std::uint32_t k = 0; k < panels_.size(); ++k) {
      const Panel& panel = panels_[k];
      // A panel is among the nearest of a cell within reach only up to this distance from the centre.
      const double radius = reach_m_ + 3.0 * half_diagonal + 4.0 * bulge;
      const auto index = [&](double value, double origin, int count) {
        return std::clamp(static_cast<int>(std::floor((value - origin) / grid_.cell_m)), 0, count - 1);
      };
      const Eigen::Vector2d low = panel.begin_W.cwiseMin(panel.end_W);
      const Eigen::Vector2d high = panel.begin_W.cwiseMax(panel.end_W);
      const int column_low = index(low.x() - radius, grid_.origin_W.x(), grid_.columns);
      const int column_high = index(high.x() + radius, grid_.origin_W.x(), grid_.columns);
      const int row_low = index(low.y() - radius, grid_.origin_W.y(), grid_.rows);
      const int row_high = index(high.y() + radius, grid_.origin_W.y(), grid_.rows);
      for (int row = row_low; row <= row_high; ++row) {
        for (int column = column_low; column <= column_high; ++column) {
          const Eigen::Vector2d centre = grid_.origin_W + grid_.cell_m * Eigen::Vector2d(column + 0.5, row + 0.5);
          const double distance = DistanceToSegment(centre, panel.begin_W, panel.end_W);
          if (distance <= radius) visit(static_cast<std::size_t>(row) * grid_.columns + column, k, distance);
        }
      }
    }
  };
  std::vector<double> nearest(cells, std::numeric_limits<double>::infinity());  // an upper bound for the centre
  for_near([&](std::size_t cell, std::uint32_t k, double distance) {
    nearest[cell] = std::min(nearest[cell], distance + panels_[k].bulge_m + kSlack_m);
  });
  const auto chosen = [&](std::size_t cell, std::uint32_t k, double distance) {
    const double bulge = panels_[k].bulge_m + kSlack_m;
    const bool cell_in_reach = nearest[cell] - 2.0 * bulge <= reach_m_ + half_diagonal;
    return cell_in_reach && distance - bulge <= nearest[cell] + 2.0 * half_diagonal;
  };
  grid_.first.assign(cells + 1, 0);
  for_near([&](std::size_t cell, std::uint32_t k, double distance) {
    if (chosen(cell, k, distance)) ++grid_.first[cell + 1];
  });
  for (std::size_t cell = 0; cell < cells; ++cell) grid_.first[cell + 1] += grid_.first[cell];
  grid_.panels.resize(grid_.first[cells]);
  std::vector<std::uint32_t> next(grid_.first.begin(), grid_.first.end() - 1);
  for_near([&](std::size_t cell, std::uint32_t k, double distance) {
    if (chosen(cell, k, distance)) grid_.panels[next[cell]++] = k;
  });
}

int PlanCurve::CellOf(double x_m, double y_m) const {
  const double column = (x_m - grid_.origin_W.x()) / grid_.cell_m;
  const double row = (y_m - grid_.origin_W.y()) / grid_.cell_m;
  if (!(column >= 0.0 && column < grid_.columns && row >= 0.0 && row < grid_.rows)) return -1;
  return static_cast<int>(row) * grid_.columns + static_cast<int>(column);
}

bool PlanCurve::MayReach(double x_m, double y_m) const {
  const int cell = CellOf(x_m, y_m);
  return cell >= 0 && grid_.first[cell] != grid_.first[cell + 1];
}

// The nearest point with u in [from, to], where the squared distance has one minimum at most.
void PlanCurve::NearestWithin(const Eigen::Vector2d& p, std::uint32_t index, double from, double to, Best& best) const {
  const Panel& panel = panels_[index];
  Eigen::Vector2d at, tangent;
  const auto ahead = [&](double u) {  // how far p lies ahead of the point at u; falls through 0 at a foot
    if (u == -panel.half_m) at = panel.begin_W, tangent = panel.begin_tangent_W;
    else if (u == panel.half_m) at = panel.end_W, tangent = panel.end_tangent_W;
    else panel.Point(u, at, tangent);
    return (p - at).dot(tangent);
  };
  const auto offer = [&](double u) {
    const double squared = (p - at).squaredNorm();
    if (squared < best.squared_m2 || (squared == best.squared_m2 && index < best.panel)) best = {squared, index, u};
  };
  double low = from, high = to;
  const double ahead_low = ahead(low);
  offer(low);
  const double ahead_high = ahead(high);
  offer(high);
  if (!(ahead_low > 0.0 && ahead_high < 0.0)) return;
  double u = low + (high - low) * (ahead_low / (ahead_low - ahead_high));
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double value = ahead(u);
    (value > 0.0 ? low : high) = u;
    const double curvature = panel.curvature_1pm + panel.curvature_rate_1pm2 * u;
    const Eigen::Vector2d away = p - at;
    const double slope = 1.0 - curvature * (tangent.x() * away.y() - tangent.y() * away.x());
    double next = u + value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::fabs(next - u);
    u = next;
    if (change <= 1e-9) break;  // Newton: what is left is below 1e-15 m
  }
  ahead(u);
  offer(u);
}

void PlanCurve::Nearest(const Eigen::Vector2d& p, std::uint32_t index, Best& best) const {
  const Panel& panel = panels_[index];
  const double steepest = std::fabs(panel.curvature_1pm) + std::fabs(panel.curvature_rate_1pm2) * panel.half_m;
  const double distance = (p - panel.middle_W).norm() + panel.half_m;
  if (steepest * distance < 0.9) return NearestWithin(p, index, -panel.half_m, panel.half_m, best);
  // Near or beyond a centre of curvature the distance may have more than one minimum on the panel.
  constexpr int kParts = 8;
  for (int part = 0; part < kParts; ++part) {
    const double from = panel.half_m * (2.0 * part / kParts - 1.0);
    const double to = panel.half_m * (2.0 * (part + 1) / kParts - 1.0);
    NearestWithin(p, index, from, to, best);
  }
}

void PlanCurve::NearestInTree(const Eigen::Vector2d& p, std::size_t node, std::uint32_t begin, std::uint32_t end, Best& best) const {
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
  if (left_m2 <= right_m2) visit_left(), visit_right();
  else visit_right(), visit_left();
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
  if (best.panel + 1 == panels_.size() && best.u_m == panel.half_m) foot.s_m = length_m_, foot.beyond_m = std::max(along, 0.0);
  return foot;
}

Foot PlanCurve::Project(double x_m, double y_m) const {
  const Eigen::Vector2d p(x_m, y_m);
  Best best{std::numeric_limits<double>::infinity(), 0, 0.0};
  const int cell = CellOf(x_m, y_m);
  if (cell >= 0 && grid_.first[cell] != grid_.first[cell + 1]) {
    for (std::uint32_t i = grid_.first[cell]; i < grid_.first[cell + 1]; ++i) Nearest(p, grid_.panels[i], best);
  } else {
    NearestInTree(p, 0, 0, static_cast<std::uint32_t>(panels_.size()), best);
  }
  return FootAt(p, best);
}

}  // namespace rodeira::geometry
