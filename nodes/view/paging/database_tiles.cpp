// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/database_tiles.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/view/scene/visual_world/ground_digest.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"

namespace rodeira::nodes {
namespace {

std::string TileName(std::int64_t column, std::int64_t row, int level) {
  return fmt::format("tiles/{}_{}_{}.osgb", column, row, level);
}

// Of a network: squares of 256 m.
class NetworkTiles final : public DatabaseTiles {
 public:
  NetworkTiles(const road::World& world, unsigned threads, scene::ModelIsThere is_there)
      : plan_(world, threads, std::move(is_there)) {}

  std::size_t count() const override { return plan_.tiles().size(); }
  TileFiles FilesOf(std::size_t tile) const override {
    const scene::TileKey& key = plan_.tiles()[tile];
    TileFiles files{plan_.BallOf(key), {}};
    const std::vector<int> levels = LevelsOf(key);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const int coarsest =
          i + 1 < levels.size() ? levels[i + 1] - 1 : scene::kGroundLevels - 1;  // that is drawn as this one
      const float from_m = levels[i] == 0 ? 0.0F : scene::kGroundSeen_m[static_cast<std::size_t>(levels[i] - 1)];
      files.levels.push_back(
          {TileName(key.column, key.row, levels[i]), from_m, scene::kGroundSeen_m[static_cast<std::size_t>(coarsest)]});
    }
    return files;
  }
  base::Digest SourceOf(std::size_t tile) const override { return plan_.SourceDigest(plan_.tiles()[tile]); }
  std::size_t WorkOf(std::size_t tile) const override { return plan_.PiecesIn(plan_.tiles()[tile]); }
  std::vector<scene::GroundLevel> Make(std::size_t tile) const override {
    const scene::TileKey& key = plan_.tiles()[tile];
    scene::GroundTile made = plan_.Build(key);
    std::vector<scene::GroundLevel> levels;
    for (const int level : LevelsOf(key)) levels.push_back(std::move(made.levels[static_cast<std::size_t>(level)]));
    return levels;
  }
  scene::GroundLevel MakeLevel(std::size_t tile, std::size_t file) const override {
    const scene::TileKey& key = plan_.tiles()[tile];
    return plan_.BuildLevel(key, LevelsOf(key)[file]);
  }

 private:
  // Those that are drawn as no finer one is.
  std::vector<int> LevelsOf(const scene::TileKey& key) const {
    std::vector<int> levels;
    for (int level = 0; level < scene::kGroundLevels; ++level) {
      if (plan_.FinestAlike(key, level) == level) levels.push_back(level);
    }
    return levels;
  }

  scene::GroundPlan plan_;
};

// Of a world without any road: what is drawn of it from memory. They are made at once, as each needs little more than
// its posts.
class TerrainTiles final : public DatabaseTiles {
 public:
  explicit TerrainTiles(const road::World& world)
      : tiles_(scene::BareLand(world)),
        source_(base::Combine(base::Combine(base::Hash(scene::kGroundVersion), world.content_hash()),
                              scene::LandDigest(world))) {}

  std::size_t count() const override { return tiles_.size(); }
  TileFiles FilesOf(std::size_t tile) const override {
    const scene::TerrainTile& of = tiles_[tile];
    TileFiles files{{of.centre_W, of.radius_m}, {}};
    float from_m = 0.0F;
    for (std::size_t level = 0; level < scene::kTerrainLevels; ++level) {
      const float to_m = scene::TerrainSeen_m(of, level);
      files.levels.push_back({TileName(of.column, of.row, static_cast<int>(level)), from_m, to_m});
      from_m = to_m;
    }
    return files;
  }
  base::Digest SourceOf(std::size_t tile) const override {
    return base::Combine(source_, base::Hash(TileName(tiles_[tile].column, tiles_[tile].row, 0)));
  }
  std::vector<scene::GroundLevel> Make(std::size_t tile) const override {
    std::vector<scene::GroundLevel> levels;
    for (std::size_t file = 0; file < tiles_[tile].levels.size(); ++file) levels.push_back(MakeLevel(tile, file));
    return levels;
  }
  scene::GroundLevel MakeLevel(std::size_t tile, std::size_t file) const override {
    scene::GroundLevel level;
    level.ground.push_back(tiles_[tile].levels[file]);
    return level;
  }

 private:
  std::vector<scene::TerrainTile> tiles_;
  base::Digest source_;
};

}  // namespace

std::unique_ptr<DatabaseTiles> TilesOf(const road::World& world, unsigned threads, scene::ModelIsThere is_there) {
  if (world.network() == nullptr) return std::make_unique<TerrainTiles>(world);
  return std::make_unique<NetworkTiles>(world, threads, std::move(is_there));
}

}  // namespace rodeira::nodes
