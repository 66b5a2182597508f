// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::nodes {

// A tile at a level as a file, and from how far to how far off it is seen.
struct TileLevel {
  std::string file;  // below the database's folder
  float from_m = 0.0F, to_m = 0.0F;
};

// A tile's place, and its files from the finest to the coarsest: each is another one.
struct TileFiles {
  scene::TileBall ball;
  std::vector<TileLevel> levels;
};

// The tiles of a world as files. All but the making is quick, and all may be asked from any number of threads.
class DatabaseTiles {
 public:
  virtual ~DatabaseTiles() = default;
  virtual std::size_t count() const = 0;
  // Precondition: tile < count(); so for all below.
  virtual TileFiles FilesOf(std::size_t tile) const = 0;
  // Of all that can change a bit of the tile.
  virtual base::Digest SourceOf(std::size_t tile) const = 0;
  // About how long it takes to make, beside others.
  virtual std::size_t WorkOf(std::size_t) const { return 0; }
  // Makes a tile: its levels in the order of its files.
  virtual std::vector<scene::GroundLevel> Make(std::size_t tile) const = 0;
  // One of them alone: of so manieth file.
  virtual scene::GroundLevel MakeLevel(std::size_t tile, std::size_t file) const = 0;
};

// Those of a network, or of a terrain or a plane without any road; the world must outlive them. threads: 0 for as many
// as the machine has. `is_there`: which models from files stand there; without it all.
std::unique_ptr<DatabaseTiles> TilesOf(const road::World& world, unsigned threads, scene::ModelIsThere is_there = {});

}  // namespace rodeira::nodes
