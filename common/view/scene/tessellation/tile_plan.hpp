// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "common/core/tessellation/triangulation.hpp"
#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/view/scene/ground_materials/skin.hpp"
#include "common/view/scene/tiles/post_lines.hpp"
#include "common/view/scene/tiles/slope_squares.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

inline constexpr int kGroundLevels = 4;
inline constexpr std::size_t kMaxLevels = 4;  // of roads over one another
// How closely the ground is followed, level by level: on roads with their verges, cuts and fills, and on the land
// beyond.
inline constexpr std::array<Tolerance, kGroundLevels> kRoadTolerances = {
    {{0.001, 0.003}, {0.02, 0.02}, {0.10, 0.10}, {0.50, 0.50}}};
inline constexpr std::array<double, kGroundLevels> kLandTolerances_m = {0.03, 0.15, 0.6, 2.0};
inline constexpr std::array<double, kGroundLevels> kLandSpacings_m = {16.0, 16.0, 32.0, 64.0};

// A piece of a tile on which SUELO is continuous: one lane, or the land between roads.
struct Face {
  std::vector<road::SurfacePoint> levels;  // in its middle, from the highest to the lowest
  std::vector<Skin> skins;                 // as many
  bool land = false;                       // no lane of a road is highest there
};

// A tile in triangles, seen from above: lanes, and the land around them.
struct TilePlan {
  TileKey key;
  tessellation::Triangulation triangles{static_cast<std::int32_t>(kTileSteps)};
  std::vector<std::uint32_t> face_of;  // by triangle
  std::vector<Face> faces;
  int left_out = 0;  // lines that crossed others after all; 0 but for mistakes
};

// A triangle's smallest height, in steps.
double ThicknessOf(const tessellation::Triangulation& triangles, const tessellation::Triangulation::Triangle& triangle);

// Of what the land in tiles is made: the terrain's posts, and where roads and their slopes change it.
struct Land {
  PostLines posts;
  SlopeSquares slopes;
  std::set<TileKey> decks;  // where bridges are

  // The terrain itself, with all of its posts, is all the ground that a tile without any line has.
  bool IsBare(const TileKey& tile) const { return posts.HoldsAll(tile) && !slopes.InTile(tile); }
  // Whether a tile, or its neighbour at an edge, may have a bridge: west, south, east, north.
  std::array<bool, 4> DecksAtEdges(const TileKey& tile) const {
    const bool own = decks.contains(tile);
    return {own || decks.contains({tile.column - 1, tile.row}), own || decks.contains({tile.column, tile.row - 1}),
            own || decks.contains({tile.column + 1, tile.row}), own || decks.contains({tile.column, tile.row + 1})};
  }
  // Of how many posts the land has one at a level.
  int EveryPost(int level) const {
    return std::max(1, static_cast<int>(kLandSpacings_m[static_cast<std::size_t>(level)] / posts.spacing_m()));
  }
};

// segments: noded, of the finest level. edge: all points on the tile's edges.
TilePlan PlanTile(const road::World& world, const Land& land, const TileKey& key,
                  std::span<const tessellation::GridSegment> segments, std::span<const tessellation::GridPoint> edge,
                  int level);

// A tile's lines, to be drawn with fewer points at coarser levels.
class TileChains {
 public:
  // segments: noded.
  TileChains(std::span<const tessellation::GridSegment> segments, const TileKey& key, const road::World& world);

  // The same lines, noded, with fewer points, none farther from what it leaves out than the tolerance; ends, crossings
  // and points on the tile's edge stay.
  std::vector<tessellation::GridSegment> Simplified(const Tolerance& tolerance) const;

 private:
  struct Point {
    tessellation::GridPoint p;
    Eigen::Vector3d at_W = Eigen::Vector3d::Zero();  // on the ground
  };
  using Chain = std::vector<Point>;
  static tessellation::GridLine Thin(const Chain& chain, const Tolerance& tolerance);
  static void Keep(const Chain& chain, std::size_t from, std::size_t to, const Tolerance& tolerance,
                   std::vector<bool>& kept);

  std::vector<Chain> chains_;  // from a knot to the next one, or around
};

}  // namespace rodeira::scene
