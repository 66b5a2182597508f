// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tiles/slope_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rodeira::scene {

void SlopeSquares::Add(std::span<const Line3> lines, double reach_m) {
  constexpr double kSquare_m = kTile_m / kSide;
  std::array<std::int64_t, 4> last{1, 1, 0,
                                   0};  // columns and rows, from and to: neighbouring pieces mostly reach the same
  const auto number = [](double at_m) { return static_cast<std::int64_t>(std::floor(at_m / kSquare_m)); };
  for (const Line3& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Eigen::Vector2d low = line[i].head<2>().cwiseMin(line[i + 1].head<2>()).array() - reach_m,
                            high = line[i].head<2>().cwiseMax(line[i + 1].head<2>()).array() + reach_m;
      const std::array<std::int64_t, 4> range{number(low.x()), number(low.y()), number(high.x()), number(high.y())};
      if (range == last) continue;
      last = range;
      for (std::int64_t column = range[0]; column <= range[2];) {
        const TileKey first{TileOf(column * (kTileSteps / kSide)), 0};
        const std::int64_t next_column = std::min(range[2] + 1, (first.column + 1) * kSide);
        for (std::int64_t row = range[1]; row <= range[3];) {
          const TileKey key{first.column, TileOf(row * (kTileSteps / kSide))};
          const std::int64_t next_row = std::min(range[3] + 1, (key.row + 1) * kSide);
          Squares& squares = squares_[key];
          for (std::int64_t c = column; c < next_column; ++c) {
            for (std::int64_t r = row; r < next_row; ++r)
              squares.set(static_cast<std::size_t>((c - key.column * kSide) * kSide + r - key.row * kSide));
          }
          row = next_row;
        }
        column = next_column;
      }
    }
  }
}

bool SlopeSquares::Touch(const TileKey& tile, const tessellation::GridPoint& low,
                         const tessellation::GridPoint& high) const {
  const auto found = squares_.find(tile);
  if (found == squares_.end()) return false;
  const auto number = [](std::int32_t at) {
    return std::min(at / static_cast<std::int32_t>(kTileSteps / kSide), kSide - 1);
  };
  for (std::int32_t column = number(low.x); column <= number(high.x); ++column) {
    for (std::int32_t row = number(low.y); row <= number(high.y); ++row) {
      if (found->second.test(static_cast<std::size_t>(column * kSide + row))) return true;
    }
  }
  return false;
}

}  // namespace rodeira::scene
