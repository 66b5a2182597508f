// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/geometry/plane.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::network {

// The part of a road's surface that belongs to one panel of its reference line, within a rectangle along the panel.
struct Band {
  std::uint32_t road = 0;
  std::uint32_t panel = 0;  // of the road's axis
  Eigen::Vector2d centre_W;
  Eigen::Vector2d along_W;  // unit length
  double half_along_m = 0.0, half_across_m = 0.0;
  // How far beyond its ends a point still belongs to it: what is closed at gaps and kinks of the reference line and
  // where another road goes on; no more than rounding where the next panel goes on smoothly, and knows the lanes' edges
  // better, or nothing goes on.
  double closed_before_m = 0.0, closed_behind_m = 0.0;

  // How far a point lies outside the rectangle: nothing of the band is nearer.
  double Distance(const Eigen::Vector2d& p_W) const;
  // Whether a point lies in the rectangle or on its edge.
  bool Holds(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2d away = p_W - centre_W;
    return std::fabs(away.dot(along_W)) <= half_along_m && std::fabs(geometry::Cross(along_W, away)) <= half_across_m;
  }
};

// Where the bands of all roads lie: a grid that tells which may hold a point, and a tree for what is nearest. Static,
// the same for the same roads; what it leaves out cannot be an answer, so that it changes none.
class BandIndex {
 public:
  static constexpr double kSlack_m = 1e-6;  // far above all rounding
  // closed_m: bands reach this far beyond the ends of their panels, for gaps that are closed.
  BandIndex(std::span<const Road> roads, double closed_m);

  const std::vector<Band>& bands() const { return bands_; }
  // The corners of a box that holds all bands; the origin without any.
  Eigen::Vector2d low_W() const { return nodes_.empty() ? Eigen::Vector2d::Zero() : nodes_[0].low; }
  Eigen::Vector2d high_W() const { return nodes_.empty() ? Eigen::Vector2d::Zero() : nodes_[0].high; }
  // Visits every band with (x, y) in its rectangle, and maybe a few others; ascending.
  template <class Visit>
  void Around(const Eigen::Vector2d& p_W, const Visit& visit) const {
    const double column = (p_W.x() - origin_W_.x()) / cell_m_, row = (p_W.y() - origin_W_.y()) / cell_m_;
    const std::span<const CellBand> listed = Listed(column, row);
    if (listed.empty()) return;
    const auto part = [](double value) { return static_cast<std::uint32_t>((value - std::floor(value)) * kParts); };
    const std::uint32_t here = std::uint32_t{1} << (part(row) * kParts + part(column));
    for (const CellBand& band : listed) {
      if ((band.parts & here) != 0) visit(band.band);
    }
  }
  // The one band with a rectangle that holds all of a box that is no wider than kWidest_m, where no other band holds
  // any of it; otherwise nothing, and maybe nothing too where a band's edge is near.
  static constexpr double kWidest_m = 2.0;
  std::optional<std::uint32_t> OnlyOne(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W) const;

  // Visits bands in an order that depends on the point alone, and leaves out those that are farther than `best`, which
  // visit(band) may lower.
  template <class Visit>
  void Nearest(const Eigen::Vector2d& p_W, double& best_m, const Visit& visit) const {
    if (!nodes_.empty()) Descend(p_W, 0, best_m, visit);
  }

 private:
  struct Node {
    Eigen::Vector2d low, high;
    std::uint32_t first = 0;  // of order_
    std::uint32_t count = 0;  // 0: an inner node; its left child follows it
    std::uint32_t right = 0;

    double Distance(const Eigen::Vector2d& p_W) const { return (low - p_W).cwiseMax(p_W - high).cwiseMax(0.0).norm(); }
  };
  // A band that lies in a cell, and in which of its kParts x kParts squares (row by row, a bit each): most that lie in
  // a cell are not at a point of it, and this tells so without another place in memory.
  struct CellBand {
    std::uint32_t band = 0, parts = 0;
  };
  static constexpr std::uint32_t kParts = 5;
  // So many cells a side are a block. Most blocks of a large map hold nothing, and have no cells.
  static constexpr std::size_t kBlock = 4;

  // Of the cell's block; its cells' numbers follow one another; 0 where nothing lies in the whole block.
  std::size_t CellOf(double column, double row) const {
    const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
    const std::uint32_t block = blocks_[y / kBlock * block_columns_ + x / kBlock];
    return block == 0 ? 0 : (block - 1) * kBlock * kBlock + y % kBlock * kBlock + x % kBlock + 1;
  }
  std::span<const CellBand> Listed(double column, double row) const {
    if (!(column >= 0.0 && column < columns_ && row >= 0.0 && row < rows_)) return {};
    const std::size_t cell = CellOf(column, row);
    return cell == 0 ? std::span<const CellBand>()
                     : std::span(cell_bands_).subspan(first_[cell - 1], first_[cell] - first_[cell - 1]);
  }
  void AddBands(std::span<const Road> roads, double closed_m);
  void BuildGrid();
  std::uint32_t PartsOf(const Band& band, const Eigen::Vector2d& cell_centre_W) const;
  std::uint32_t BuildTree(std::uint32_t first, std::uint32_t last, std::span<const Eigen::Vector2d> low,
                          std::span<const Eigen::Vector2d> high);
  template <class Visit>
  void Descend(const Eigen::Vector2d& p_W, std::uint32_t index, double& best_m, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (bands_[order_[i]].Distance(p_W) <= best_m) visit(order_[i]);
      }
      return;
    }
    const std::uint32_t left = index + 1, right = node.right;
    const double to_left = nodes_[left].Distance(p_W), to_right = nodes_[right].Distance(p_W);
    const bool left_first = to_left <= to_right;
    if (std::min(to_left, to_right) <= best_m) Descend(p_W, left_first ? left : right, best_m, visit);
    if (std::max(to_left, to_right) <= best_m) Descend(p_W, left_first ? right : left, best_m, visit);
  }

  std::vector<Band> bands_;
  Eigen::Vector2d origin_W_ = Eigen::Vector2d::Zero();
  double cell_m_ = 8.0;
  double columns_ = 0.0, rows_ = 0.0;  // whole numbers
  std::size_t block_columns_ = 0;
  std::vector<std::uint32_t> blocks_;  // by row and column; 0: nothing lies in it, otherwise its number, from 1
  std::vector<std::uint32_t>
      first_;  // per cell of those that hold something, where its bands begin in cell_bands_; one more at the end
  std::vector<CellBand> cell_bands_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace rodeira::network
