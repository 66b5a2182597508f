// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/square_lists.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::road {

SquareLists::SquareLists(std::span<const Strip> strips) {
  if (strips.empty()) return;
  const auto low_of = [](const Strip& strip) {
    return Eigen::Vector2d(strip.from_W.cwiseMin(strip.to_W).array() - strip.reach_m);
  };
  const auto high_of = [](const Strip& strip) {
    return Eigen::Vector2d(strip.from_W.cwiseMax(strip.to_W).array() + strip.reach_m);
  };
  Eigen::Vector2d low_W = low_of(strips.front()), high_W = high_of(strips.front());
  double farthest_m = 0.0;
  for (const Strip& strip : strips) {
    low_W = low_W.cwiseMin(low_of(strip)), high_W = high_W.cwiseMax(high_of(strip));
    farthest_m = std::max(farthest_m, strip.reach_m);
  }
  // Where strips are wide squares are too, so that the lists stay short beside what is in them.
  grid_ = SquareGrid(low_W, high_W, std::max(SquareGrid::kMinSide_m, 0.5 * farthest_m));
  const double half_diagonal_m = std::sqrt(0.5) * grid_.side_m() + SquareGrid::kSlack_m;
  const auto each_square = [&](const Strip& strip, const auto& use) {
    grid_.Each(low_of(strip), high_of(strip), [&](std::size_t square, const Eigen::Vector2d& middle_W) {
      if (strip.FromWay(middle_W) <= strip.reach_m + half_diagonal_m) use(square);
    });
  };
  first_.assign(grid_.size() + 1, 0);
  for (const Strip& strip : strips) each_square(strip, [&](std::size_t square) { ++first_[square + 1]; });
  for (std::size_t square = 0; square + 1 < first_.size(); ++square) first_[square + 1] += first_[square];
  strips_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < strips.size(); ++i)
    each_square(strips[i], [&](std::size_t square) { strips_[next[square]++] = i; });
}

}  // namespace rodeira::road
