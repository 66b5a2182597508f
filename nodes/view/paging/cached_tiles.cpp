// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/cached_tiles.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/bytes.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/visual_world/level_bytes.hpp"
#include "common/view/scene/visual_world/seen_digest.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kPlanKind = "view tiles 1";
constexpr const char* kLevelKind = "view level 1";

// The world's models from files, and which of them can be drawn. Each is asked for once: one that cannot be read says
// so.
std::map<std::string, bool> ModelsOf(const road::World& world, const scene::ModelIsThere& is_there) {
  std::map<std::string, bool> models;
  const scene::StaticObjects things(world);
  for (const auto& [key, tile] : things.tiles()) {
    for (const scene::Thing& thing : tile.things) {
      if (!thing.file.empty() && !models.contains(thing.file))
        models[thing.file] = is_there == nullptr || is_there(thing.file);
    }
  }
  return models;
}

// Of all that can change a bit of a level, names of files included, which a level contains.
base::Digest SourceOfWorld(const road::World& world, const std::map<std::string, bool>& models) {
  base::Digest digest = scene::SeenDigest(world);
  for (const terrain::LaidPicture& picture : scene::PicturesOf(world))
    digest = base::Combine(digest, base::Hash(picture.file));
  for (const auto& [model, is_there] : models)
    digest = base::Combine(digest, base::Hash(fmt::format("{} {}", model, is_there)));
  return digest;
}

base::Bytes BytesOf(const std::vector<TileFiles>& tiles) {
  base::ByteWriter out;
  for (const TileFiles& tile : tiles) {
    for (Eigen::Index i = 0; i < 3; ++i) out.Put(tile.ball.centre_W[i]);
    out.Put(tile.ball.radius_m);
    out.Put(static_cast<std::uint32_t>(tile.levels.size()));
    for (const TileLevel& level : tile.levels) {
      out.PutString(level.file);
      out.Put(level.from_m);
      out.Put(level.to_m);
    }
  }
  return std::move(out.bytes());
}

std::vector<TileFiles> TilesFrom(std::span<const std::byte> bytes) {
  base::ByteReader in(bytes);
  std::vector<TileFiles> tiles;
  while (in.ok() && in.remaining() > 0) {
    TileFiles& tile = tiles.emplace_back();
    for (Eigen::Index i = 0; i < 3; ++i) tile.ball.centre_W[i] = in.Get<double>();
    tile.ball.radius_m = in.Get<double>();
    const auto levels = in.Get<std::uint32_t>();
    for (std::uint32_t level = 0; level < levels && in.ok(); ++level)
      tile.levels.push_back({in.GetString(), in.Get<float>(), in.Get<float>()});
  }
  return tiles;
}

class CachedTiles final : public DatabaseTiles {
 public:
  CachedTiles(const road::World& world, unsigned threads, const scene::ModelIsThere& is_there, base::FileCache& cache)
      : world_(world),
        threads_(threads),
        models_(ModelsOf(world_, is_there)),
        cache_(cache),
        source_(SourceOfWorld(world_, models_)) {
    if (const auto bytes = cache_.Find(kPlanKind, source_)) {
      files_ = TilesFrom(*bytes);
      return;
    }
    for (std::size_t tile = 0; tile < Made().count(); ++tile) files_.push_back(Made().FilesOf(tile));
    cache_.Keep(kPlanKind, source_, BytesOf(files_));
  }

  std::size_t count() const override { return files_.size(); }
  TileFiles FilesOf(std::size_t tile) const override { return files_[tile]; }
  base::Digest SourceOf(std::size_t tile) const override { return Made().SourceOf(tile); }
  std::size_t WorkOf(std::size_t tile) const override { return Made().WorkOf(tile); }
  std::vector<scene::GroundLevel> Make(std::size_t tile) const override { return Made().Make(tile); }
  scene::GroundLevel MakeLevel(std::size_t tile, std::size_t file) const override {
    const base::Digest source = base::Combine(source_, base::Hash(files_[tile].levels[file].file));
    if (const auto bytes = cache_.Find(kLevelKind, source)) {
      if (auto level = scene::LevelFrom(*bytes)) return *std::move(level);
    }
    scene::GroundLevel level = Made().MakeLevel(tile, file);
    cache_.Keep(kLevelKind, source, scene::BytesOf(level));
    return level;
  }

 private:
  const DatabaseTiles& Made() const {
    std::call_once(once_, [this] {
      made_ = TilesOf(world_, threads_, [this](const std::string& model) {
        const auto known = models_.find(model);
        return known == models_.end() || known->second;
      });
    });
    return *made_;
  }

  const road::World& world_;
  unsigned threads_;
  std::map<std::string, bool> models_;  // from files; whether they can be drawn
  base::FileCache& cache_;
  base::Digest source_;
  std::vector<TileFiles> files_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<DatabaseTiles> made_;
};

}  // namespace

std::unique_ptr<DatabaseTiles> CachedTilesOf(const road::World& world, unsigned threads, scene::ModelIsThere is_there,
                                             base::FileCache* cache) {
  if (cache == nullptr || !cache->is_used() || world.network() == nullptr)
    return TilesOf(world, threads, std::move(is_there));
  return std::make_unique<CachedTiles>(world, threads, is_there, *cache);
}

}  // namespace rodeira::nodes
