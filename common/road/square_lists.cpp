#include "common/road/square_lists.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::road {
namespace {

constexpr double kMostSquares = 4e6;
constexpr double kSlack_m = 1e-3;  // far above all rounding

}  // namespace

SquareLists::SquareLists(std::span<const Strip> strips) {
  if (strips.empty()) return;
  Eigen::Vector2d high_W = strips.front().from_W;
  low_W_ = strips.front().from_W;
  double farthest_m = 0.0;
  for (const Strip& strip : strips) {
    low_W_ = low_W_.cwiseMin((strip.from_W.cwiseMin(strip.to_W).array() - strip.reach_m - kSlack_m).matrix());
    high_W = high_W.cwiseMax((strip.from_W.cwiseMax(strip.to_W).array() + strip.reach_m + kSlack_m).matrix());
    farthest_m = std::max(farthest_m, strip.reach_m);
  }
  const Eigen::Vector2d size = high_W - low_W_;
  // Where strips are wide squares are too, so that the lists stay short beside what is in them.
  side_m_ = std::max({side_m_, 0.5 * farthest_m, std::sqrt(size.x() * size.y() / kMostSquares)});
  columns_ = static_cast<std::size_t>(size.x() / side_m_) + 1;
  rows_ = static_cast<std::size_t>(size.y() / side_m_) + 1;
  const double half_diagonal_m = std::sqrt(0.5) * side_m_ + kSlack_m;
  const auto each_square = [&](const Strip& strip, const auto& use) {
    const auto index = [&](double from_low_m, std::size_t count) { return std::min(static_cast<std::size_t>(std::max(0.0, from_low_m) / side_m_), count - 1); };
    const Eigen::Vector2d low = (strip.from_W.cwiseMin(strip.to_W) - low_W_).array() - strip.reach_m - kSlack_m;
    const Eigen::Vector2d high = (strip.from_W.cwiseMax(strip.to_W) - low_W_).array() + strip.reach_m + kSlack_m;
    for (std::size_t row = index(low.y(), rows_); row <= index(high.y(), rows_); ++row) {
      for (std::size_t column = index(low.x(), columns_); column <= index(high.x(), columns_); ++column) {
        const Eigen::Vector2d middle_W = low_W_ + side_m_ * Eigen::Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        if (strip.FromWay(middle_W) <= strip.reach_m + half_diagonal_m) use(row * columns_ + column);
      }
    }
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Strip& strip : strips) each_square(strip, [&](std::size_t square) { ++first_[square + 1]; });
  for (std::size_t square = 0; square + 1 < first_.size(); ++square) first_[square + 1] += first_[square];
  strips_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < strips.size(); ++i) each_square(strips[i], [&](std::size_t square) { strips_[next[square]++] = i; });
}

}  // namespace rodeira::road
