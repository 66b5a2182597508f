// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/world/road/square_grid.hpp"

namespace rodeira::road {

// For each square of the plane a list of the strips that touch it: what may reach a point is told without a search.
class SquareLists {
 public:
  // All places that are no farther than reach_m from the straight way between two places.
  struct Strip {
    Eigen::Vector2d from_W, to_W;
    double reach_m = 0.0;

    double FromWay(const Eigen::Vector2d& p_W) const {  // how far a place is from the way
      const Eigen::Vector2d way = to_W - from_W, to = p_W - from_W;
      const double length2 = way.squaredNorm();
      const double part = length2 > 0.0 ? std::clamp(to.dot(way) / length2, 0.0, 1.0) : 0.0;
      return (to - part * way).norm();
    }
  };

  SquareLists() = default;
  explicit SquareLists(std::span<const Strip> strips);

  // The numbers of all strips that hold the point, and of some beside it; ascending.
  std::span<const std::uint32_t> At(const Eigen::Vector2d& p_W) const {
    const auto square = grid_.At(p_W);
    if (!square) return {};
    return Of(*square);
  }
  const SquareGrid& grid() const { return grid_; }
  // Precondition: a square of grid().
  std::span<const std::uint32_t> Of(std::size_t square) const {
    return std::span(strips_).subspan(first_[square], first_[square + 1] - first_[square]);
  }

 private:
  SquareGrid grid_;
  std::vector<std::uint32_t> first_;  // by square, where a square's list begins in strips_; one more at the end
  std::vector<std::uint32_t> strips_;
};

}  // namespace rodeira::road
