// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// How far from a road's lines its cuts and fills, its junction's, or the terrain's cells that it cuts through, may make
// the land another one than the bare terrain.
double LandReachOf(const road::World& world, const network::Road& road);

// Of what SUELO's answers within a tile are made: stretches of roads that reach it, junctions' surfaces, the terrain's
// posts in it and around it. A change anywhere else leaves a tile's digest as it is.
class TileSources {
 public:
  TileSources() = default;
  // world: as it is seen, with a network; it must outlive this. lines: by road, RoadLinesOf and what else is cut into
  // tiles.
  TileSources(const road::World& world, std::span<const std::vector<Line3>> lines);

  // Of all that can change what SUELO says anywhere in the tile. Where it knows no ground (beyond a terrain, or beside
  // OpenDRIVE's roads) the nearest road says how high nothing is: there every road that may be nearest to a place of
  // the tile counts.
  base::Digest DigestOf(const TileKey& tile) const;

 private:
  // A stretch of a road, or a junction: what is in the box and not farther from it than reach_m may be made from it.
  struct Part {
    Eigen::Vector2d low_W, high_W;
    double reach_m = 0.0;
    bool beside = false;  // it says how high the ground beside it is, too
    base::Digest digest = 0;
  };
  // Points of a road's lines that follow one another, and a box around them.
  struct Points {
    std::vector<Eigen::Vector2d> at_W;
    Eigen::Vector2d low_W, high_W;
  };
  void AddStretches(std::uint32_t road, PictureDigests& pictures);
  void AddJunctions();
  // The terrain's posts that make the tile's ground; solid: there is ground everywhere in it.
  base::Digest Posts(const TileKey& tile, bool& solid) const;
  static constexpr int kCells = 8;  // along a tile's side, a power of two
  using Nearest = std::array<double, kCells * kCells>;
  struct CellBlock {  // a square of so many cells along a side, from one on
    int column, row, cells;
  };
  // For each cell of the tile: none of its places is farther from its nearest road.
  Nearest NearestWithin(const TileKey& tile) const;
  // Of the block's cells. within_m: no place of the block is farther from its nearest road; may_be: all that may be the
  // nearest to one.
  void NearestIn(const TileKey& tile, const CellBlock& block, double within_m, std::span<const Points* const> may_be,
                 Nearest& nearest) const;

  const road::World* world_ = nullptr;
  std::vector<Part> parts_;  // in the order of the roads, then of the junctions
  std::vector<Points> points_;
};

}  // namespace rodeira::scene
