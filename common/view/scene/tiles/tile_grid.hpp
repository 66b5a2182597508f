// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <cstdint>

#include "common/core/tessellation/grid_point.hpp"

// The world's square tiles, with coordinates in integer steps. A step is below what can be seen, and large enough that
// a float represents every coordinate within a tile exactly. So two tiles share identical points on their common edge,
// anywhere on earth.
namespace rodeira::scene {

inline constexpr double kStep_m = 1.0 / 8192.0;
inline constexpr std::int64_t kTileSteps = std::int64_t{1} << 21;
inline constexpr double kTile_m = 256.0;

// A tile of kTile_m a side; column and row count from the world's origin, to the east and to the north.
struct TileKey {
  std::int64_t column = 0;
  std::int64_t row = 0;

  auto operator<=>(const TileKey&) const = default;
  Eigen::Vector2d south_west_W() const {
    return {static_cast<double>(column) * kTile_m, static_cast<double>(row) * kTile_m};
  }
};

// A place in the world, in steps.
struct WorldStep {
  std::int64_t x = 0;
  std::int64_t y = 0;

  auto operator<=>(const WorldStep&) const = default;
};

// The nearest step each way.
inline WorldStep ToSteps(const Eigen::Vector2d& p_W) {
  return {std::llround(p_W.x() / kStep_m), std::llround(p_W.y() / kStep_m)};
}
inline double RoundToStep(double z_m) { return std::round(z_m / kStep_m) * kStep_m; }

// Counted from the tile's south-west corner. Precondition: p lies in the tile or on its edge.
inline tessellation::GridPoint InTile(const TileKey& tile, const WorldStep& p) {
  return {static_cast<std::int32_t>(p.x - tile.column * kTileSteps),
          static_cast<std::int32_t>(p.y - tile.row * kTileSteps)};
}
// The inverse: in W.
inline Eigen::Vector2d ToWorld(const TileKey& tile, const tessellation::GridPoint& p) {
  return {static_cast<double>(tile.column * kTileSteps + p.x) * kStep_m,
          static_cast<double>(tile.row * kTileSteps + p.y) * kStep_m};
}
// Of a point counted in its tile.
inline bool IsOnTileEdge(const tessellation::GridPoint& p) {
  return p.x == 0 || p.y == 0 || p.x == kTileSteps || p.y == kTileSteps;
}
// The tile's number along an axis; of a place on an edge the one that begins there.
inline std::int64_t TileOf(std::int64_t step) {
  return step >= 0 ? step / kTileSteps : -((-step + kTileSteps - 1) / kTileSteps);
}

}  // namespace rodeira::scene
