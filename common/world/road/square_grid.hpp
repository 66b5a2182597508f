// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rodeira::road {

// Squares of one size, side by side over a box of the plane, numbered row by row: what may be at a point is found by
// the number of its square.
class SquareGrid {
 public:
  static constexpr double kMinSide_m = 32.0;
  static constexpr double kSlack_m = 1e-3;  // far above all rounding

  SquareGrid() = default;  // without a square
  // Over the box and kSlack_m more. Squares have a side of at least side_m, and a longer one where there would be more
  // than four million.
  SquareGrid(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W, double side_m)
      : low_W_(low_W.array() - kSlack_m) {
    const Eigen::Vector2d size = (high_W.array() + kSlack_m).matrix() - low_W_;
    side_m_ = std::max(side_m, std::sqrt(size.x() * size.y() / 4e6));
    columns_ = static_cast<std::size_t>(size.x() / side_m_) + 1;
    rows_ = static_cast<std::size_t>(size.y() / side_m_) + 1;
  }

  std::size_t size() const { return columns_ * rows_; }
  double side_m() const { return side_m_; }
  // A square's lowest corner.
  Eigen::Vector2d Corner(std::size_t square) const {
    return low_W_ +
           side_m_ * Eigen::Vector2d(static_cast<double>(square % columns_), static_cast<double>(square / columns_));
  }
  // The square that a point lies in; nothing beside all of them.
  std::optional<std::size_t> At(const Eigen::Vector2d& p_W) const {
    const double column = (p_W.x() - low_W_.x()) / side_m_, row = (p_W.y() - low_W_.y()) / side_m_;
    if (!(column >= 0.0 && column < static_cast<double>(columns_) && row >= 0.0 && row < static_cast<double>(rows_)))
      return std::nullopt;
    return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  }
  // Visits every square that a box within that of the grid touches, and maybe some within kSlack_m of it: visit(square,
  // its middle).
  template <class Visit>
  void Each(const Eigen::Vector2d& low_W, const Eigen::Vector2d& high_W, const Visit& visit) const {
    const Eigen::Vector2d low = (low_W - low_W_).array() - kSlack_m, high = (high_W - low_W_).array() + kSlack_m;
    const auto index = [&](double from_low_m, std::size_t count) {
      return std::min(static_cast<std::size_t>(std::max(0.0, from_low_m) / side_m_), count - 1);
    };
    for (std::size_t row = index(low.y(), rows_); row <= index(high.y(), rows_); ++row) {
      for (std::size_t column = index(low.x(), columns_); column <= index(high.x(), columns_); ++column) {
        visit(row * columns_ + column,
              Eigen::Vector2d(low_W_ + side_m_ * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                                                 static_cast<double>(row) + 0.5)));
      }
    }
  }

 private:
  double side_m_ = kMinSide_m;
  Eigen::Vector2d low_W_ = Eigen::Vector2d::Zero();
  std::size_t columns_ = 0, rows_ = 0;
};

}  // namespace rodeira::road
