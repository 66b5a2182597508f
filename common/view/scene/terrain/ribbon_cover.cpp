// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/terrain/ribbon_cover.hpp"

#include <algorithm>

namespace rodeira::scene {
namespace {

constexpr double kLeastArea_m2 = 1e-7;

// Positive to the left of the line from a to b: twice the triangle's area.
double Side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

// The part of the polygon where sign * Side >= 0.
Polygon ClipToSide(const Polygon& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& q = polygon[(i + 1) % polygon.size()];
    const double side_p = sign * Side(a, b, p), side_q = sign * Side(a, b, q);
    if (side_p >= 0.0) kept.push_back(p);
    if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0)) {
      kept.push_back(p + side_p / (side_p - side_q) * (q - p));
    }
  }
  return kept;
}

}  // namespace

double Area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) twice += Side(polygon[0], polygon[i], polygon[i + 1]);
  return 0.5 * twice;
}

std::vector<Polygon> Subtract(const Polygon& polygon, const std::array<Eigen::Vector2d, 4>& hole) {
  std::vector<Polygon> pieces;
  Polygon rest = polygon;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d& a = hole[k];
    const Eigen::Vector2d& b = hole[(k + 1) % 4];
    Polygon outside = ClipToSide(rest, a, b, -1.0);
    if (outside.size() >= 3 && Area(outside) > kLeastArea_m2) pieces.push_back(std::move(outside));
    rest = ClipToSide(rest, a, b, 1.0);
    if (rest.size() < 3 || Area(rest) <= kLeastArea_m2) {
      // Nothing is left inside: had the hole not been here at all, the polygon would be whole.
      return pieces;
    }
  }
  return pieces;
}

RibbonCover::RibbonCover(const Lattice& lattice, const std::vector<Ribbon>& ribbons)
    : rows_(lattice.rows()),
      touched_(static_cast<std::size_t>(lattice.columns()) * static_cast<std::size_t>(lattice.rows())) {
  for (const Ribbon& ribbon : ribbons) {
    for (std::size_t i = 0; i + 1 < ribbon.lines.size(); ++i) {
      const auto quad = ribbon.Quad(i);
      Eigen::Vector2d low = quad[0], high = quad[0];
      for (const Eigen::Vector2d& corner : quad) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      const Eigen::Vector2i first = lattice.CellAt(low.x(), low.y()), last = lattice.CellAt(high.x(), high.y());
      for (int column = first.x(); column <= last.x(); ++column) {
        for (int row = first.y(); row <= last.y(); ++row) {
          cells_.emplace_back(static_cast<std::int64_t>(column) * rows_ + row,
                              static_cast<std::uint32_t>(quads_.size()));
        }
      }
      quads_.push_back(quad);
    }
  }
  std::sort(cells_.begin(), cells_.end());
  for (const auto& [cell, quad] : cells_) touched_[static_cast<std::size_t>(cell)] = true;
}

std::pair<std::size_t, std::size_t> RibbonCover::Range(int column, int row) const {
  const std::int64_t cell = static_cast<std::int64_t>(column) * rows_ + row;
  const auto from = std::lower_bound(cells_.begin(), cells_.end(), std::pair(cell, std::uint32_t{0}));
  const auto to = std::lower_bound(from, cells_.end(), std::pair(cell + 1, std::uint32_t{0}));
  return {static_cast<std::size_t>(from - cells_.begin()), static_cast<std::size_t>(to - cells_.begin())};
}

std::vector<Polygon> RibbonCover::Remainder(int column, int row, const Polygon& triangle) const {
  std::vector<Polygon> pieces = {triangle};
  const auto [from, to] = Range(column, row);
  for (std::size_t i = from; i < to; ++i) {
    const auto& hole = quads_[cells_[i].second];
    std::vector<Polygon> left;
    for (const Polygon& piece : pieces) {
      double inside = Area(piece);
      std::vector<Polygon> outside = Subtract(piece, hole);
      for (const Polygon& part : outside) inside -= Area(part);
      if (inside <= kLeastArea_m2)
        left.push_back(piece);  // they do not overlap: the piece stays uncut
      else
        left.insert(left.end(), std::make_move_iterator(outside.begin()), std::make_move_iterator(outside.end()));
    }
    pieces = std::move(left);
  }
  return pieces;
}

}  // namespace rodeira::scene
