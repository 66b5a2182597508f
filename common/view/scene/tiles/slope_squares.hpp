// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <span>

#include "common/core/tessellation/grid_point.hpp"
#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"

namespace rodeira::scene {

// Where roads with their cuts and fills may be: squares of 16 m within reach of roads' lines. Elsewhere the land is the
// bare terrain.
class SlopeSquares {
 public:
  // Every square that is nowhere farther than `reach_m`, in x and in y, from a piece of a line, and some beside them.
  void Add(std::span<const Line3> lines, double reach_m);

  // Whether any of a tile's squares is one.
  bool InTile(const TileKey& tile) const { return squares_.contains(tile); }
  // Whether one of them touches a rectangle of a tile.
  bool Touch(const TileKey& tile, const tessellation::GridPoint& low, const tessellation::GridPoint& high) const;

 private:
  static constexpr int kSide = 16;  // squares of a tile
  using Squares = std::bitset<static_cast<std::size_t>(kSide) * kSide>;

  std::map<TileKey, Squares> squares_;
};

}  // namespace rodeira::scene
