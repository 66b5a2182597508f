// SPDX-License-Identifier: Apache-2.0
// Tiles that a cache holds are, to the bit, those that are made.
#include "nodes/view/paging/cached_tiles.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/view/scene/visual_world/level_bytes.hpp"
#include "tests/common/view/scene/worlds.hpp"
#include "tests/long_form.hpp"
#include "tests/nodes/view/database_fixture.hpp"

namespace rodeira::nodes {
namespace {

using namespace std::chrono_literals;

template <class T>
bool SameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(static_cast<const void*>(a.data()), static_cast<const void*>(b.data()),
                                   a.size() * sizeof(T)) == 0);
}

struct Same {
  bool operator()(const scene::Mesh& a, const scene::Mesh& b) const {
    return a.material == b.material && a.origin_W == b.origin_W && SameBytes(a.positions, b.positions) &&
           SameBytes(a.normals, b.normals) && a.colours == b.colours && a.triangles == b.triangles &&
           a.face == b.face && SameBytes(a.on_face, b.on_face) && a.repeats == b.repeats;
  }
  bool operator()(const scene::Stand& a, const scene::Stand& b) const { return a.foot_W == b.foot_W && a.x_W == b.x_W; }
  bool operator()(const scene::PlacedCopy& a, const scene::PlacedCopy& b) const {
    return (*this)(a.stand, b.stand) && a.across == b.across && a.up == b.up && a.leaves == b.leaves;
  }
  bool operator()(const scene::Repeated& a, const scene::Repeated& b) const {
    return (*this)(a.model, b.model) && SameBytes(a.light, b.light) && a.origin_W == b.origin_W &&
           All(a.places, b.places);
  }
  bool operator()(const scene::PlacedModel& a, const scene::PlacedModel& b) const {
    return a.file == b.file && (*this)(a.stand, b.stand);
  }
  bool operator()(const scene::GroundLevel& a, const scene::GroundLevel& b) const {
    return All(a.ground, b.ground) && (*this)(a.marks, b.marks) && All(a.things, b.things) &&
           All(a.repeated, b.repeated) && All(a.models, b.models);
  }
  template <class T>
  bool All(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
  }
};

class CachedTilesFixture : public testing::Test {
 protected:
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
    return files;
  }
  // All levels of every `stride`-th tile.
  static void ExpectSame(const DatabaseTiles& tiles, const DatabaseTiles& made, std::size_t stride) {
    ASSERT_EQ(tiles.count(), made.count());
    ASSERT_GT(made.count(), 0u);
    for (std::size_t tile = 0; tile < made.count(); tile += stride) {
      const TileFiles a = tiles.FilesOf(tile), b = made.FilesOf(tile);
      EXPECT_EQ(a.ball.centre_W, b.ball.centre_W);
      EXPECT_EQ(a.ball.radius_m, b.ball.radius_m);
      ASSERT_EQ(a.levels.size(), b.levels.size());
      for (std::size_t level = 0; level < b.levels.size(); ++level) {
        EXPECT_EQ(a.levels[level].file, b.levels[level].file);
        EXPECT_EQ(a.levels[level].from_m, b.levels[level].from_m);
        EXPECT_EQ(a.levels[level].to_m, b.levels[level].to_m);
        EXPECT_TRUE(Same()(tiles.MakeLevel(tile, level), made.MakeLevel(tile, level))) << b.levels[level].file;
      }
    }
  }
  // Made and kept, found, and made again from damaged files.
  void Check(const road::World& world, std::size_t stride) {
    const auto made = TilesOf(world, 0);
    ExpectSame(*CachedTilesOf(world, 0, {}, &cache_), *made, stride);
    const std::size_t kept = Files().size();
    const auto before = fs::file_time_type::clock::now() - 1h;
    for (const fs::path& file : Files()) fs::last_write_time(file, before);
    ExpectSame(*CachedTilesOf(world, 0, {}, &cache_), *made, stride);
    EXPECT_EQ(Files().size(), kept);
    for (const fs::path& file : Files()) EXPECT_GT(fs::last_write_time(file), before + 1min) << "was not found";
    for (const fs::path& file : Files()) {
      base::Bytes bytes = base::ReadBytes(file).value();
      bytes[bytes.size() / 2] ^= std::byte{0x10};
      ASSERT_TRUE(base::WriteWhole(file, bytes).ok());
    }
    ExpectSame(*CachedTilesOf(world, 0, {}, &cache_), *made, stride);
  }

  base::TemporaryFolder above_ = base::TemporaryFolder::Make("cached-tiles").value();
  fs::path folder_ = above_.path() / "cache";
  base::FileCache cache_{folder_};
};

TEST_F(CachedTilesFixture, OfAnOpenDriveFileWithThings) {
  Check(*scene::OpenDriveWorld(BendWithThings()), BriefOrLong<std::size_t>(11, 1));
}

TEST_F(CachedTilesFixture, OfARoadInAPlane) { Check(*scene::PlaneWithRoad(), BriefOrLong<std::size_t>(11, 1)); }

TEST_F(CachedTilesFixture, OfWorldFiles) {
  for (const char* name : BriefOrLong<std::vector<const char*>>(
           {"lights.yaml"}, {"lights.yaml", "ring.yaml", "motorway.yaml", "crater.yaml", "haste.yaml", "n222.yaml"})) {
    SCOPED_TRACE(name);
    const auto world = road::World::Load(fs::path(SourceDir()) / "configs/worlds" / name);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    if (world.value()->network() != nullptr) Check(*world.value(), 7);
  }
}

// What is drawn of another world, or without a model that cannot be read, is not taken for this one's.
TEST_F(CachedTilesFixture, AnotherWorldAndOtherModelsAreOthers) {
  const auto first = scene::OpenDriveWorld(BendWithThings(90.0)), second = scene::OpenDriveWorld(BendWithThings(91.0));
  for (const auto& world : {first, second}) {
    const auto tiles = CachedTilesOf(*world, 0, {}, &cache_), made = TilesOf(*world, 0);
    for (std::size_t tile = 0; tile < made->count(); ++tile) {
      if (made->WorkOf(tile) == 0) continue;  // no road lies there
      EXPECT_TRUE(Same()(tiles->MakeLevel(tile, 0), made->MakeLevel(tile, 0))) << tile;
    }
  }

  const fs::path model = above_.path() / "shelter.osgt";
  std::ofstream(model) << "a model";
  const auto world = road::World::Parse(
      fmt::format("rodeira: world/2\nname: m\nground: {{kind: plane, z_m: 0}}\nroads:\n  - id: a\n    start: {{x_m: 0, "
                  "y_m: 0, heading_deg: 90}}\n    axis: [{{line: {{length_m: 60}}}}]\n    z_m: 0\n    section: "
                  "{{template: rural}}\n    objects: [{{type: house, s_m: 30, t_m: -15, length_m: 4, width_m: 3, "
                  "height_m: 3, model: {}}}]\n",
                  model.string()),
      above_.path() / "m.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  for (int round = 0; round < 2; ++round) {
    std::size_t models[2] = {};
    for (const bool readable : {false, true}) {
      const auto is_there = [readable](const std::string&) { return readable; };
      const auto tiles = CachedTilesOf(*world.value(), 0, is_there, &cache_);
      for (std::size_t tile = 0; tile < tiles->count(); ++tile)
        models[readable] += tiles->MakeLevel(tile, 0).models.size();
    }
    EXPECT_EQ(models[0], 0u);
    EXPECT_EQ(models[1], 1u);
  }
}

TEST_F(CachedTilesFixture, WithoutACacheTheyAreMade) {
  const auto world = scene::PlaneWithRoad();
  base::FileCache none{fs::path()};
  for (base::FileCache* cache : {static_cast<base::FileCache*>(nullptr), &none})
    ExpectSame(*CachedTilesOf(*world, 0, {}, cache), *TilesOf(*world, 0), 9);
}

// Each cut of a level's bytes is refused; none is read beyond its end.
TEST(LevelBytes, CutOrLongerOnesAreNoLevel) {
  const auto world = scene::OpenDriveWorld(BendWithThings());
  const auto tiles = TilesOf(*world, 0);
  scene::GroundLevel level;
  for (std::size_t tile = 0; tile < tiles->count() && level.repeated.empty(); ++tile) level = tiles->MakeLevel(tile, 0);
  ASSERT_FALSE(level.repeated.empty());
  level.models.push_back({"a/model.osgt", {}});
  base::Bytes bytes = scene::BytesOf(level);
  const auto whole = scene::LevelFrom(bytes);
  ASSERT_TRUE(whole.has_value());
  EXPECT_TRUE(Same()(*whole, level));
  const std::size_t apart = std::max<std::size_t>(1, bytes.size() / 997);
  for (std::size_t size = 0; size < bytes.size(); size += apart)
    EXPECT_FALSE(scene::LevelFrom(std::span(bytes).first(size)).has_value()) << size;
  EXPECT_FALSE(scene::LevelFrom(std::span(bytes).first(bytes.size() - 1)).has_value());
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(scene::LevelFrom(bytes).has_value());
}

}  // namespace
}  // namespace rodeira::nodes
