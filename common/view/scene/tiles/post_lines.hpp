// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// The terrain's posts as points of the land in tiles: where they stand about as densely as land has points, its
// triangles are SUELO's own.
class PostLines {
 public:
  PostLines() = default;
  // The world must outlive it. None where there is no terrain, or its posts stand too densely or too sparsely.
  explicit PostLines(const road::World& world);

  // Whether a tile lies within the terrain, with posts to be used.
  bool Holds(const TileKey& tile) const;
  // The same, and none of the posts in it or around it is void.
  bool HoldsAll(const TileKey& tile) const;
  // The places, within the tile, of columns of posts, and of rows; those with a number that is a multiple of `every`.
  // Ascending.
  std::vector<std::int32_t> Columns(const TileKey& tile, int every) const;
  std::vector<std::int32_t> Rows(const TileKey& tile, int every) const;
  double spacing_m() const { return spacing_m_.x(); }
  // Where the terrain's triangles meet the tile's west edge (y), or its south edge (x).
  std::vector<std::int32_t> OnWest(const TileKey& tile) const;
  std::vector<std::int32_t> OnSouth(const TileKey& tile) const;
  // The sides of the terrain's triangles, cut off at the tile's edge: from a post or a place on that edge to the next
  // one. Those along the edge itself are none of them.
  std::vector<std::array<tessellation::GridPoint, 2>> Sides(const TileKey& tile) const;

 private:
  // In steps, and strictly within a tile that begins at `begin_m`: the places k + shift spacings behind the first post,
  // for every whole k that is a multiple of `every`.
  static std::vector<std::int32_t> Places(double first_m, double spacing_m, double begin_m, double shift, int every);

  bool any_ = false;
  const terrain::ElevationGrid* grid_ = nullptr;
  Eigen::Vector2d south_west_W_ = Eigen::Vector2d::Zero(), north_east_W_ = Eigen::Vector2d::Zero(),
                  spacing_m_ = Eigen::Vector2d::Ones();
};

}  // namespace rodeira::scene
