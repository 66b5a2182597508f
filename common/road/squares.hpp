#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace rodeira::road {

// Which squares of the plane some boxes touch: tells quickly that none of them is at a point.
class Squares {
 public:
  struct Box {
    Eigen::Vector2d low_W, high_W;
  };

  Squares() = default;
  explicit Squares(std::span<const Box> boxes);

  // False: none of the boxes holds the point. True: maybe one does.
  bool MayHold(const Eigen::Vector2d& p_W) const {
    const double column = (p_W.x() - low_W_.x()) / side_m_, row = (p_W.y() - low_W_.y()) / side_m_;
    if (!(column >= 0.0 && column < static_cast<double>(columns_) && row >= 0.0 && row < static_cast<double>(rows_))) return false;
    return touched_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)] != 0;
  }

 private:
  double side_m_ = 32.0;
  Eigen::Vector2d low_W_ = Eigen::Vector2d::Zero();
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> touched_;  // by row and column
};

}  // namespace rodeira::road
