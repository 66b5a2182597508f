// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/squares.hpp"

namespace rodeira::road {

Squares::Squares(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  Eigen::Vector2d low_W = boxes.front().low_W, high_W = boxes.front().high_W;
  for (const Box& box : boxes) low_W = low_W.cwiseMin(box.low_W), high_W = high_W.cwiseMax(box.high_W);
  grid_ = SquareGrid(low_W, high_W, SquareGrid::kMinSide_m);
  touched_.assign(grid_.size(), 0);
  for (const Box& box : boxes)
    grid_.Each(box.low_W, box.high_W, [&](std::size_t square, const Eigen::Vector2d&) { touched_[square] = 1; });
}

}  // namespace rodeira::road
