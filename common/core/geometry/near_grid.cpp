// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/near_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

constexpr double kSmallestCell_m = 4.0;
constexpr double kMaxCells = 2e6;

double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double u = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - u * along).norm();
}

}  // namespace

NearGrid::NearGrid(std::span<const Chord> chords, double reach_m) {
  RODEIRA_ASSERT(!chords.empty() && reach_m > 0.0);
  Eigen::Vector2d low = chords[0].begin_W, high = low;
  double bulge = 0.0;
  for (const Chord& chord : chords) {
    low = low.cwiseMin(chord.begin_W).cwiseMin(chord.end_W);
    high = high.cwiseMax(chord.begin_W).cwiseMax(chord.end_W);
    bulge = std::max(bulge, chord.bulge_m + kSearchMargin_m);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach_m + bulge);
  const Eigen::Vector2d size = high - low + 2.0 * margin;
  origin_W_ = low - margin;
  cell_m_ = std::max(kSmallestCell_m, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = std::floor(size.x() / cell_m_) + 1.0;
  rows_ = std::floor(size.y() / cell_m_) + 1.0;
  const auto cells = static_cast<std::size_t>(columns_ * rows_);

  // Let d be the distance from a cell's centre to the nearest chord and r half its diagonal. The curve is between
  // d - bulge and d + bulge away from the centre. A point of the cell within reach means d <= reach + r + bulge; the
  // piece nearest to any point of the cell has its chord within d + 2 r + 2 bulge of the centre.
  const double r = cell_m_ * std::sqrt(0.5);
  const std::vector<Near> pairs = Pairs(chords, reach_m + 3.0 * r + 3.0 * bulge);
  std::vector<double> nearest(cells, std::numeric_limits<double>::infinity());
  for (const Near& near : pairs) nearest[near.cell] = std::min(nearest[near.cell], near.distance_m);
  const auto chosen = [&](const Near& near) {
    return nearest[near.cell] <= reach_m + r + bulge && near.distance_m <= nearest[near.cell] + 2.0 * r + 2.0 * bulge;
  };
  first_.assign(cells + 1, 0);
  for (const Near& near : pairs) first_[near.cell + 1] += chosen(near) ? 1U : 0U;
  for (std::size_t cell = 0; cell < cells; ++cell) first_[cell + 1] += first_[cell];
  pieces_.resize(first_[cells]);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Near& near : pairs) {
    if (chosen(near)) pieces_[next[near.cell]++] = near.piece;
  }
}

std::vector<NearGrid::Near> NearGrid::Pairs(std::span<const Chord> chords, double radius_m) const {
  std::vector<Near> pairs;
  const auto index = [&](double value, double origin, double count) {
    return std::clamp(std::floor((value - origin) / cell_m_), 0.0, count - 1.0);
  };
  for (std::uint32_t piece = 0; piece < chords.size(); ++piece) {
    const Chord& chord = chords[piece];
    const Eigen::Vector2d low = chord.begin_W.cwiseMin(chord.end_W);
    const Eigen::Vector2d high = chord.begin_W.cwiseMax(chord.end_W);
    const double column_low = index(low.x() - radius_m, origin_W_.x(), columns_);
    const double column_high = index(high.x() + radius_m, origin_W_.x(), columns_);
    const double row_low = index(low.y() - radius_m, origin_W_.y(), rows_);
    const double row_high = index(high.y() + radius_m, origin_W_.y(), rows_);
    for (double row = row_low; row <= row_high; row += 1.0) {
      for (double column = column_low; column <= column_high; column += 1.0) {
        const Eigen::Vector2d centre = origin_W_ + cell_m_ * Eigen::Vector2d(column + 0.5, row + 0.5);
        const double distance = DistanceToSegment(centre, chord.begin_W, chord.end_W);
        if (distance <= radius_m) pairs.push_back({static_cast<std::size_t>(row * columns_ + column), piece, distance});
      }
    }
  }
  return pairs;
}

std::span<const std::uint32_t> NearGrid::Candidates(double x_m, double y_m) const {
  const double column = (x_m - origin_W_.x()) / cell_m_;
  const double row = (y_m - origin_W_.y()) / cell_m_;
  if (!(column >= 0.0 && column < columns_ && row >= 0.0 && row < rows_)) return {};
  const std::size_t cell =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  return std::span(pieces_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
}

}  // namespace rodeira::geometry
