// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/point_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::driver {
namespace {

constexpr std::size_t kBoxed = 8;

// How far x lies outside of [low, high].
double Outside(double low, double high, double x) { return std::max(0.0, std::max(low - x, x - high)); }

}  // namespace

struct PointBoxes::Search {
  Eigen::Vector2d p_W;
  std::optional<double> z_m;
  double level_m;
  std::size_t nearest = 0;
  double least_m2 = std::numeric_limits<double>::infinity();

  void TestPoint(std::size_t i, const Eigen::Vector3d& point_W) {
    if (z_m && std::fabs(point_W.z() - *z_m) > level_m) return;
    const double squared = (point_W.head<2>() - p_W).squaredNorm();
    if (squared < least_m2 || (squared == least_m2 && i < nearest)) nearest = i, least_m2 = squared;
  }
};

PointBoxes::PointBoxes(std::vector<Eigen::Vector3d> points_W) : points_W_(std::move(points_W)) {
  RODEIRA_ASSERT(!points_W_.empty());
  std::vector<Box> below;
  for (const Eigen::Vector3d& p_W : points_W_) below.push_back({p_W, p_W});
  do {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (i % kBoxed == 0) boxes.push_back(below[i]);
      boxes.back() = {boxes.back().low_W.cwiseMin(below[i].low_W), boxes.back().high_W.cwiseMax(below[i].high_W)};
    }
    levels_.push_back(boxes);
    below = std::move(boxes);
  } while (below.size() > 1);
}

double PointBoxes::Squared(const Box& box, const Eigen::Vector2d& p_W) {
  const double dx = Outside(box.low_W.x(), box.high_W.x(), p_W.x()),
               dy = Outside(box.low_W.y(), box.high_W.y(), p_W.y());
  return dx * dx + dy * dy;
}

// A box is passed over if its nearest point is farther than the nearest point so far. Rounding keeps the order of sums
// and squares, so that no point of such a box would be nearer.
void PointBoxes::LookInto(Search& search, std::size_t level, std::size_t box) const {
  const Box& bounds = levels_[level][box];
  if (search.z_m && Outside(bounds.low_W.z(), bounds.high_W.z(), *search.z_m) > search.level_m) return;
  if (Squared(bounds, search.p_W) > search.least_m2) return;
  const std::size_t size = level == 0 ? points_W_.size() : levels_[level - 1].size();
  for (std::size_t i = kBoxed * box; i < std::min(kBoxed * (box + 1), size); ++i) {
    if (level == 0)
      search.TestPoint(i, points_W_[i]);
    else
      LookInto(search, level - 1, i);
  }
}

std::optional<std::size_t> PointBoxes::Nearest(const Eigen::Vector2d& p_W, std::optional<double> z_m, double level_m,
                                               std::size_t likely) const {
  Search search{p_W, z_m, level_m};
  const std::size_t first = std::min(likely, points_W_.size() - 1);
  search.TestPoint(first, points_W_[first]);
  LookInto(search, 0, first / kBoxed);
  LookInto(search, levels_.size() - 1, 0);
  return std::isinf(search.least_m2) ? std::nullopt : std::optional(search.nearest);
}

std::size_t PointBoxes::Likely(const Eigen::Vector2d& p_W) const {
  std::size_t box = 0;
  for (std::size_t level = levels_.size() - 1; level-- > 0;) {
    const std::size_t end = std::min(kBoxed * (box + 1), levels_[level].size());
    std::size_t nearest = kBoxed * box;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = nearest; i < end; ++i) {
      const double squared = Squared(levels_[level][i], p_W);
      if (squared < least) nearest = i, least = squared;
    }
    box = nearest;
  }
  return kBoxed * box;
}

}  // namespace rodeira::driver
