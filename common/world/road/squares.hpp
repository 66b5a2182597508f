// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "common/world/road/square_grid.hpp"

namespace rodeira::road {

// Which squares of the plane some boxes touch: tells quickly that none of them is at a point.
class Squares {
 public:
  // Opposite corners, the smaller coordinates in low_W.
  struct Box {
    Eigen::Vector2d low_W, high_W;
  };

  Squares() = default;
  explicit Squares(std::span<const Box> boxes);

  // False: none of the boxes holds the point. True: maybe one does.
  bool MayHold(const Eigen::Vector2d& p_W) const {
    const auto square = grid_.At(p_W);
    return square && touched_[*square] != 0;
  }

 private:
  SquareGrid grid_;
  std::vector<std::uint8_t> touched_;  // by square
};

}  // namespace rodeira::road
