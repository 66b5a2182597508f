// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/view/scene/terrain/lattice.hpp"
#include "common/view/scene/terrain/ribbon.hpp"

namespace rodeira::scene {

using Polygon = std::vector<Eigen::Vector2d>;  // convex, counter-clockwise

double Area(const Polygon& polygon);
// What of `polygon` lies outside of `hole`, as convex pieces.
std::vector<Polygon> Subtract(const Polygon& polygon, const std::array<Eigen::Vector2d, 4>& hole);

// Which cells of a lattice the ribbons touch.
class RibbonCover {
 public:
  RibbonCover(const Lattice& lattice, const std::vector<Ribbon>& ribbons);

  bool Touches(int column, int row) const {
    return touched_[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row)];
  }
  // What the ribbons leave of a triangle of the cell.
  std::vector<Polygon> Remainder(int column, int row, const Polygon& triangle) const;

 private:
  std::pair<std::size_t, std::size_t> Range(int column, int row) const;

  int rows_;
  std::vector<bool> touched_;  // by cell
  std::vector<std::array<Eigen::Vector2d, 4>> quads_;
  std::vector<std::pair<std::int64_t, std::uint32_t>> cells_;  // (cell, quad), ascending
};

}  // namespace rodeira::scene
