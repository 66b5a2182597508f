// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "common/core/tessellation/grid_point.hpp"
#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/view/scene/tiles/post_lines.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"

namespace rodeira::scene {

using TileLines = std::map<TileKey, std::vector<tessellation::GridLine>>;

// Adds the lines' parts to the tiles that they run through, cut where they pass from one to another. What runs along a
// common edge is in both tiles.
void AddToTiles(std::span<const Line3> lines, TileLines& tiles);

// The points on tiles' edges, of both neighbours together: a tile triangulates all of its edges' points, at every
// level.
class TileEdges {
 public:
  // There is always one this often; where land is made of the terrain's posts, these and its diagonals take their
  // place.
  static constexpr std::int32_t kEvery = static_cast<std::int32_t>(kTileSteps / 16);

  TileEdges() = default;
  explicit TileEdges(const PostLines& posts) : posts_(posts) {}

  // Of the segments' ends those that lie on an edge of the tile, for both tiles beside it.
  void Add(const TileKey& tile, std::span<const tessellation::GridSegment> segments);
  // All points on the tile's four edges.
  std::vector<tessellation::GridPoint> Of(const TileKey& tile) const;

 private:
  struct Edge {
    TileKey tile;  // with this west or south edge
    bool west = false;

    auto operator<=>(const Edge&) const = default;
  };
  std::vector<std::int32_t> Usual(const Edge& edge) const;

  PostLines posts_;
  std::map<Edge, std::set<std::int32_t>> places_;
};

}  // namespace rodeira::scene
