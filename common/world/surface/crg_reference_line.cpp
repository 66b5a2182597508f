// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_reference_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"

namespace rodeira::surface {
namespace {

constexpr std::size_t kLeaf = 8;     // segments
constexpr double kStraight = 1e-12;  // of the length: what the points of a straight line may lie beside it
constexpr double kNearZero = 1e-12;

Eigen::Vector2d LeftOf(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x()}; }

}  // namespace

CrgReferenceLine::CrgReferenceLine(double begin_u_m, double step_m, std::vector<Eigen::Vector2d> points_W)
    : begin_u_m_(begin_u_m), step_m_(step_m), points_(std::move(points_W)) {
  RODEIRA_ASSERT(points_.size() >= 2 && step_m_ > 0.0);
  const Eigen::Vector2d whole = points_.back() - points_.front();
  const double length = step_m_ * static_cast<double>(segments());
  straight_ = true;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d even = points_.front() + whole * (static_cast<double>(i) / static_cast<double>(segments()));
    straight_ = straight_ && (points_[i] - even).norm() <= kStraight * length + kNearZero;
  }
  if (!straight_) BuildTree(0, segments());
}

void CrgReferenceLine::BuildTree(std::size_t begin, std::size_t end) {
  const std::size_t node = tree_.size();
  tree_.push_back({points_[begin], points_[begin]});
  for (std::size_t i = begin + 1; i <= end; ++i) {
    tree_[node].low = tree_[node].low.cwiseMin(points_[i]);
    tree_[node].high = tree_[node].high.cwiseMax(points_[i]);
  }
  if (end - begin <= kLeaf) return;
  const std::size_t middle = begin + (end - begin) / 2;
  BuildTree(begin, middle);
  tree_[node].second = tree_.size();
  BuildTree(middle, end);
}

double CrgReferenceLine::Box::SquaredDistance(const Eigen::Vector2d& p) const {
  return (p - p.cwiseMax(low).cwiseMin(high)).squaredNorm();
}

void CrgReferenceLine::Search(const Eigen::Vector2d& p, std::size_t node, std::size_t begin, std::size_t end,
                              Nearest& best) const {
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector2d along = Along(i);
      const double share = std::clamp((p - points_[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double squared = (p - points_[i] - share * along).squaredNorm();
      if (squared < best.squared_m2 || (squared == best.squared_m2 && i < best.segment)) best = {squared, i};
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const std::size_t first = node + 1;
  const std::size_t second = tree_[node].second;
  const double to_first = tree_[first].SquaredDistance(p), to_second = tree_[second].SquaredDistance(p);
  const auto go = [&](bool to_the_first) {
    if ((to_the_first ? to_first : to_second) > best.squared_m2) return;
    if (to_the_first)
      Search(p, first, begin, middle, best);
    else
      Search(p, second, middle, end, best);
  };
  go(to_first <= to_second);
  go(!(to_first <= to_second));
}

Eigen::Vector2d CrgReferenceLine::Chord(std::size_t point) const {
  return points_[std::min(point + 1, segments())] - points_[point == 0 ? 0 : point - 1];
}

Eigen::Vector2d CrgReferenceLine::DirectionAt(double u_m) const {
  const double at = std::clamp((u_m - begin_u_m_) / step_m_, 0.0, static_cast<double>(segments() - 1));
  return Along(static_cast<std::size_t>(at)).normalized();
}

Eigen::Vector2d CrgReferenceLine::Position(double u_m, double v_m) const {
  const double last = static_cast<double>(segments());
  const double at = (u_m - begin_u_m_) / step_m_;
  const double inside = std::clamp(at, 0.0, last);
  const std::size_t i = std::min(static_cast<std::size_t>(inside), segments() - 1);
  const double share = inside - static_cast<double>(i);
  const Eigen::Vector2d direction = Along(i).normalized();
  const Eigen::Vector2d left = LeftOf(direction);
  // Along a crossing line, the distance beside the segment grows by the cosine of half the corner.
  const auto crossing = [&](std::size_t point) -> Eigen::Vector2d {
    const Eigen::Vector2d across = LeftOf(Chord(point).normalized());
    return points_[point] + (v_m / across.dot(left)) * across;
  };
  if (at < 0.0 || at > last)
    return points_[at < 0.0 ? 0 : segments()] + (at - inside) * step_m_ * direction + v_m * left;
  return (1.0 - share) * crossing(i) + share * crossing(i + 1);
}

CrgFoot CrgReferenceLine::FootBeyond(const Eigen::Vector2d& p, bool at_end) const {
  const Eigen::Vector2d direction = Along(at_end ? segments() - 1 : 0).normalized();
  const Eigen::Vector2d from = p - (at_end ? points_.back() : points_.front());
  return {(at_end ? end_u_m() : begin_u_m_) + from.dot(direction), from.dot(LeftOf(direction)), direction,
          LeftOf(direction)};
}

CrgFoot CrgReferenceLine::Project(double x_m, double y_m) const {
  const Eigen::Vector2d p(x_m, y_m);
  if (straight_) {
    const Eigen::Vector2d along = points_.back() - points_.front();
    const Eigen::Vector2d from = p - points_.front();
    const double a_metre =
        step_m_ * static_cast<double>(segments()) / along.squaredNorm();  // u a metre, over the length
    const Eigen::Vector2d left = LeftOf(along.normalized());
    return {begin_u_m_ + from.dot(along) * a_metre, from.dot(left), along * a_metre, left};
  }
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  Search(p, 0, 0, segments(), best);
  std::size_t i = best.segment;
  while (i + 1 < segments() && (p - points_[i + 1]).dot(Chord(i + 1)) > 0.0) ++i;
  while (i > 0 && (p - points_[i]).dot(Chord(i)) < 0.0) --i;

  // v is the distance beside the segment; u is shared by the distances to the two crossing lines, measured along the
  // segment.
  const Eigen::Vector2d along = Along(i), before = Chord(i), after = Chord(i + 1);
  const Eigen::Vector2d to_begin_slope = before / before.dot(along), to_end_slope = -after / after.dot(along);
  const double from_begin = (p - points_[i]).dot(to_begin_slope);
  const double to_end = (p - points_[i + 1]).dot(to_end_slope);
  if (i == 0 && from_begin < 0.0) return FootBeyond(p, false);
  if (i + 1 == segments() && to_end < 0.0) return FootBeyond(p, true);
  CrgFoot foot;
  foot.v_slope_W = LeftOf(along.normalized());
  foot.v_m = (p - points_[i]).dot(foot.v_slope_W);
  const double sum = from_begin + to_end;
  if (sum > kNearZero) {  // otherwise the crossing lines meet here: any u is as good
    foot.u_m = begin_u_m_ + step_m_ * (static_cast<double>(i) + std::clamp(from_begin / sum, 0.0, 1.0));
    foot.u_slope_W = step_m_ * (to_end * to_begin_slope - from_begin * to_end_slope) / (sum * sum);
  } else {
    foot.u_m = begin_u_m_ + step_m_ * (static_cast<double>(i) + 0.5);
    foot.u_slope_W = along.normalized();
  }
  return foot;
}

}  // namespace rodeira::surface
