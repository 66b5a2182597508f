#include "common/road/squares.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::road {
namespace {

constexpr double kMostSquares = 4e6;
constexpr double kSlack_m = 1e-3;  // far above all rounding

}  // namespace

Squares::Squares(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  Eigen::Vector2d high_W = boxes.front().high_W;
  low_W_ = boxes.front().low_W;
  for (const Box& box : boxes) {
    low_W_ = low_W_.cwiseMin(box.low_W);
    high_W = high_W.cwiseMax(box.high_W);
  }
  low_W_.array() -= kSlack_m;
  const Eigen::Vector2d size = high_W - low_W_ + Eigen::Vector2d::Constant(kSlack_m);
  side_m_ = std::max(side_m_, std::sqrt(size.x() * size.y() / kMostSquares));
  columns_ = static_cast<std::size_t>(size.x() / side_m_) + 1;
  rows_ = static_cast<std::size_t>(size.y() / side_m_) + 1;
  touched_.assign(columns_ * rows_, 0);
  const auto index = [&](double from_low_m) { return static_cast<std::size_t>(std::max(0.0, from_low_m) / side_m_); };
  for (const Box& box : boxes) {
    const Eigen::Vector2d low = box.low_W - low_W_ - Eigen::Vector2d::Constant(kSlack_m), high = box.high_W - low_W_ + Eigen::Vector2d::Constant(kSlack_m);
    for (std::size_t row = index(low.y()); row <= std::min(index(high.y()), rows_ - 1); ++row) {
      for (std::size_t column = index(low.x()); column <= std::min(index(high.x()), columns_ - 1); ++column) touched_[row * columns_ + column] = 1;
    }
  }
}

}  // namespace rodeira::road
