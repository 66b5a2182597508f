// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/road_furniture/static_objects.hpp"
#include "common/view/scene/road_markings/mark_strips.hpp"
#include "common/view/scene/tessellation/tile_plan.hpp"
#include "common/view/scene/tiles/tile_lines.hpp"
#include "common/view/scene/tiles/tile_sources.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// A tile at one level of detail.
struct GroundLevel {
  std::vector<Mesh> ground;  // one a material, then walls; nothing above or below another but on another level of roads
  Mesh marks;                // in the planes of the ground's triangles: to be drawn after it, with an offset
  std::vector<Mesh> things;  // signs and objects that stand in the tile, all with one origin
  std::vector<Repeated> repeated;   // those that are like others, with the same one
  std::vector<PlacedModel> models;  // the same, from files
};

// Around a tile with room for its heights; known without building it.
struct TileBall {
  Eigen::Vector3d centre_W = Eigen::Vector3d::Zero();
  double radius_m = 350.0;
};

// Up to these distances from a ball's centre the levels are shown.
inline constexpr std::array<float, kGroundLevels> kGroundSeen_m = {240.0F, 480.0F, 1080.0F, 1e9F};

// A square of ground at several levels of detail, the finest first. On the square's edge all levels have the same
// vertices, to the bit, and so have neighbours: any two levels fit together without a crack.
struct GroundTile {
  TileKey key;
  TileBall ball;
  std::array<GroundLevel, kGroundLevels> levels;
};

// A network's ground, ready to be made tile by tile. Tiles are pure functions of the world: in any order, on any
// threads, the same bits.
class GroundPlan {
 public:
  // Land is drawn this far around roads.
  static constexpr double kAround_m = 500.0;

  // world.network() must not be null; the world must outlive the plan. Its surface is drawn as it is seen
  // (World::AsSeen). threads: 0 for as many as the machine has.
  explicit GroundPlan(const road::World& world, unsigned threads = 0, ModelIsThere is_there = {});

  std::span<const TileKey> tiles() const { return tiles_; }
  // All of its levels. Precondition: one of tiles().
  GroundTile Build(const TileKey& tile) const;
  // One of its levels: the bits that it has in the whole tile.
  GroundLevel BuildLevel(const TileKey& tile, int level) const;
  // The finest level that is drawn as this one is, to the bit: bare land on which nothing stands has fewer levels.
  int FinestAlike(const TileKey& tile, int level) const;
  // It holds all that Build makes for the tile.
  TileBall BallOf(const TileKey& tile) const;
  // How many pieces of lines are cut into it.
  std::size_t PiecesIn(const TileKey& tile) const;
  // Of everything that can change a bit of the tile, and of nothing that lies out of its reach: lines and paint in it,
  // what stands in it, and what SUELO answers from there (TileSources). It may change without need, but only where
  // something near changes.
  base::Digest SourceDigest(const TileKey& tile) const;

 private:
  struct Begun;  // what a tile's levels have in common, and the level that was woven last
  Begun Begin(const TileKey& tile) const;
  GroundLevel LevelOf(Begun& begun, int level) const;
  // Whether nothing but the terrain itself is in the tile.
  bool IsBare(const TileKey& tile) const { return !segments_.contains(tile) && land_.IsBare(tile); }

  std::shared_ptr<const road::World> seen_;
  const road::World& world_;  // as it is seen
  StaticObjects things_;
  std::vector<TileKey> tiles_;  // ascending
  std::map<TileKey, std::vector<tessellation::GridSegment>> segments_;
  Land land_;
  TileEdges edges_;
  TileSources sources_;
  base::Digest land_digest_ = 0;
  std::array<TilePaint, kGroundLevels - 1> paint_;  // the coarsest level has none
};

// Calls work(i) for each i < count on several threads (0: as many as the machine has), each exactly once. `told`, where
// there is one, is called on this thread, behind each piece of work that it has done itself and at last, with how many
// are done.
void ForEachAtOnce(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work,
                   const std::function<void(std::size_t)>& told = {});

}  // namespace rodeira::scene
