// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "common/world/road/square_grid.hpp"

namespace rodeira::road {

// For each small square of the plane something that is made when a point in it is first asked for, by whichever thread
// asks, and then stays: a pure function of the square, so that it does not matter which thread made it. The squares
// part those of a grid evenly.
template <class Made>
class LazySquares {
 public:
  static constexpr double kMaxPerSide = 64.0;  // of a grid over roads that reach farther than any should

  LazySquares() = default;
  // Squares of about side_m, or larger ones where the grid's are more than kMaxPerSide times as long.
  LazySquares(const SquareGrid& grid, double side_m)
      : grid_(grid),
        per_side_(static_cast<std::size_t>(std::clamp(std::round(grid.side_m() / side_m), 1.0, kMaxPerSide))),
        blocks_(std::make_unique<std::atomic<Block*>[]>(grid.size())) {}
  LazySquares(LazySquares&&) = default;
  LazySquares& operator=(LazySquares&&) = default;
  ~LazySquares() {
    for (std::size_t i = 0; blocks_ != nullptr && i < grid_.size(); ++i) delete blocks_[i].load();
  }

  // No point of a square is farther from its middle.
  double radius_m() const {
    return std::sqrt(0.5) * grid_.side_m() / static_cast<double>(per_side_) + SquareGrid::kSlack_m;
  }
  // Of the square that the point lies in: make(the grid's square, its own middle), asked once or, where two threads
  // come together, twice. nullptr beside the grid.
  template <class Make>
  const Made* At(const Eigen::Vector2d& p_W, const Make& make) const {
    const auto square = grid_.At(p_W);
    if (!square) return nullptr;
    const double side_m = grid_.side_m() / static_cast<double>(per_side_);
    const Eigen::Vector2d corner_W = grid_.Corner(*square), from_corner = (p_W - corner_W) / side_m;
    const auto index = [&](double along) {
      return std::min(static_cast<std::size_t>(std::max(0.0, along)), per_side_ - 1);
    };
    const std::size_t column = index(from_corner.x()), row = index(from_corner.y());
    const Block& block = *Get(blocks_[*square], [&] { return std::make_unique<Block>(per_side_ * per_side_); });
    return Get(block.made[row * per_side_ + column], [&] {
      return std::make_unique<Made>(make(*square, corner_W + side_m * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                                                                      static_cast<double>(row) + 0.5)));
    });
  }

 private:
  struct Block {  // of one of the grid's squares
    explicit Block(std::size_t count) : made(count) {}
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    ~Block() {
      for (auto& one : made) delete one.load();
    }
    mutable std::vector<std::atomic<Made*>> made;
  };
  template <class Kept, class Make>
  static Kept* Get(std::atomic<Kept*>& at, const Make& make) {
    if (Kept* known = at.load(std::memory_order_acquire)) return known;
    std::unique_ptr<Kept> fresh = make();
    Kept* known = nullptr;
    if (at.compare_exchange_strong(known, fresh.get(), std::memory_order_acq_rel, std::memory_order_acquire))
      return fresh.release();
    return known;
  }

  SquareGrid grid_;
  std::size_t per_side_ = 1;
  std::unique_ptr<std::atomic<Block*>[]> blocks_;  // by the grid's square
};

}  // namespace rodeira::road
