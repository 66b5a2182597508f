// SPDX-License-Identifier: Apache-2.0
// A database after its world was edited: what is built again, in the project's own worlds and where a measured surface
// changes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "common/core/base/files.hpp"
#include "common/view/scene/tiles/tile_grid.hpp"
#include "common/world/network/network.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/long_form.hpp"
#include "tests/nodes/view/database_fixture.hpp"
#include "tests/setting.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

// One edit of a world file, and where it is: what lies farther than reach_m from a road between two stations is as it
// was.
struct Edit {
  std::string what, found, other;
  std::string road;  // an id of the network: a piece between two junctions has its own
  double from_s_m, to_s_m, reach_m;
};

// The tiles that come as near to the road between the stations, counted from the axis, every metre; and those beyond
// the terrain, where nothing has a height but the nearest road's: that stretch of it, or one beside it that begins
// before 50 m, is the nearest to one of their places, every 16 m.
std::size_t TilesNear(const road::World& world, const Edit& edit) {
  const auto index = world.network()->FindRoad(edit.road);
  EXPECT_TRUE(index.has_value()) << edit.road;
  if (!index) return 0;
  const network::Road& road = world.network()->roads()[*index];
  std::set<scene::TileKey> tiles;
  const auto number = [](double at_m) { return static_cast<std::int64_t>(std::floor(at_m / scene::kTile_m)); };
  for (double s = edit.from_s_m; s <= std::min(edit.to_s_m, road.length_m()); s += 1.0) {
    const Eigen::Vector2d p = road.axis().Evaluate(s).p_W;
    for (std::int64_t column = number(p.x() - edit.reach_m); column <= number(p.x() + edit.reach_m); ++column) {
      for (std::int64_t row = number(p.y() - edit.reach_m); row <= number(p.y() + edit.reach_m); ++row) {
        const Eigen::Vector2d low = scene::TileKey{column, row}.south_west_W();
        const Eigen::Vector2d off =
            (low - p).cwiseMax(p - low - Eigen::Vector2d::Constant(scene::kTile_m)).cwiseMax(0.0);
        if (off.norm() <= edit.reach_m) tiles.insert({column, row});
      }
    }
  }
  const road::Extents land = world.extents();
  for (std::int64_t column = number(land.west_m); column <= number(land.east_m); ++column) {
    for (std::int64_t row = number(land.south_m); row <= number(land.north_m); ++row) {
      const Eigen::Vector2d low = scene::TileKey{column, row}.south_west_W();
      const auto beyond = [&](const Eigen::Vector2d& p) {
        return p.x() <= land.west_m || p.y() <= land.south_m || p.x() >= land.east_m || p.y() >= land.north_m;
      };
      if (!beyond(low) && !beyond(low + Eigen::Vector2d::Constant(scene::kTile_m))) continue;
      for (double x = 0.0; x <= scene::kTile_m; x += 16.0) {
        for (double y = 0.0; y <= scene::kTile_m; y += 16.0) {
          const auto place = world.network()->Locate(low.x() + x, low.y() + y);
          if (place && place->lane.road == *index && place->s_m > edit.from_s_m - 50.0 &&
              place->s_m < edit.to_s_m + 50.0)
            tiles.insert({column, row});
        }
      }
    }
  }
  return tiles.size();
}

class AgainTest : public Database {
 protected:
  // Each edit on top of the ones before: no more tiles are built than come near it; at last all is as if built from
  // nothing.
  void ExpectOnlyTheEdited(const std::string& name, const std::vector<Edit>& edits) {
    const fs::path file = fs::path(SourceDir()) / "configs/worlds" / (name + ".yaml");
    std::string text = base::ReadText(file).value();
    const auto parse = [&] {
      const auto world = road::World::Parse(text, file);
      EXPECT_TRUE(world.ok()) << world.error().Text();
      return world.value();
    };
    auto world = parse();
    const DatabaseReport first = Write(*world, "world");
    EXPECT_EQ(first.built, first.tiles);
    EXPECT_EQ(Write(*world, "world").built, 0u);
    for (const Edit& edit : edits) {
      const auto at = text.find(edit.found);
      ASSERT_TRUE(at != std::string::npos && text.find(edit.found, at + 1) == std::string::npos) << edit.found;
      text.replace(at, edit.found.size(), edit.other);
      world = parse();
      const DatabaseReport again = Write(*world, "world");
      EXPECT_GT(again.built, 0u) << edit.what;
      const std::size_t near = TilesNear(*world, edit);
      EXPECT_LE(again.built, near) << edit.what;
      std::printf("%s, %s: %zu of %zu tiles built again; %zu are near\n", name.c_str(), edit.what.c_str(), again.built,
                  again.tiles, near);
    }
    Write(*world, "fresh", 1);
    EXPECT_TRUE(Files("world") == Files("fresh"));
  }
};

// Database.OnlyWhatChangedIsBuiltAgain and Database.AMovedSignBuildsItsOwnTilesAlone ask for the same of
// small worlds.
TEST_F(AgainTest, InN222OnlyTheTilesOfAnEditAreBuilt) {
  if (!IsLongForm()) GTEST_SKIP() << "a long form (RODEIRA_LONG_TESTS)";
  constexpr double kHills_m =
      270.0 + 30.0;  // reach_m of the hills, and the posts around a tile, two cells of 10 m in either direction
  const std::vector<Edit> edits = {
      {"a higher crest", "{s_m: 2930, z_m: 127.4, parabola_m: 90}", "{s_m: 2930, z_m: 127.9, parabola_m: 90}", "n222",
       2610.0, 3250.0, kHills_m},
      {"a narrower last bend",
       "- clothoid: {length_m: 15, radius_end_m: 35}\n      - arc: {length_m: 10, radius_m: 35}\n      - clothoid: "
       "{length_m: 15, radius_start_m: 35}",
       "- clothoid: {length_m: 15, radius_end_m: 34}\n      - arc: {length_m: 10, radius_m: 34}\n      - clothoid: "
       "{length_m: 15, radius_start_m: 34}",
       "n222", 5250.0, 5500.0, kHills_m + 5.0},
      {"a yellow line", "from_s_m: 2229, to_s_m: 2359, kind: continuous",
       "from_s_m: 2229, to_s_m: 2359, kind: continuous, colour: yellow", "n222", 2228.0, 2360.0, 1.0},
      {"a house moved", "{type: house, side: left, beside_m: 20, s_m: 1856,",
       "{type: house, side: left, beside_m: 20, s_m: 1858,", "n222", 1855.0, 1859.0, 30.0},
      {"a bump laid", "    lines:\n      - {t_m: -2.96",
       "    bumps: [{shape: round, from_s_m: 1000, to_s_m: 1004, height_m: 0.08}]\n    lines:\n      - {t_m: -2.96",
       "n222", 950.0, 1054.0, 12.0}};
  ExpectOnlyTheEdited("n222", edits);
}

// It takes a minute: asked for by RODEIRA_BUILT_HASTE=1.
TEST_F(AgainTest, InHasteOnlyTheTilesOfAnEditAreBuilt) {
  if (Setting("RODEIRA_BUILT_HASTE", 0) == 0) GTEST_SKIP() << "set RODEIRA_BUILT_HASTE to 1 to build it";
  constexpr double kHills_m = 700.0 + 72.0;
  ExpectOnlyTheEdited(
      "haste", {{"the road on the bridge moved by 2 m", "place: {road: main, s_m: 27752, turn_deg: 85, own_s_m: 500}",
                 "place: {road: main, s_m: 27754, turn_deg: 85, own_s_m: 500}", "bridge", 0.0, 1000.0, kHills_m + 5.0},
                {"the end of a crossing road higher", "{s_m: 1400, z_m: 185.276}", "{s_m: 1400, z_m: 186}", "cross4/2",
                 50.0, 720.0, kHills_m},
                {"a yellow line", "from_s_m: 12555.981, to_s_m: 12615.981}",
                 "from_s_m: 12555.981, to_s_m: 12615.981, colour: yellow}", "main/4", 2080.0, 2200.0, 30.0},
                {"a filling station moved", "{type: filling_station, side: right, beside_m: 14, s_m: 13059.981}",
                 "{type: filling_station, side: right, beside_m: 14, s_m: 13061}", "main/4", 2580.0, 2660.0, 45.0}});
}

TEST_F(AgainTest, AnotherMeasuredSurfaceBuildsTheTilesUnderItAlone) {
  fs::create_directories(folder_);
  const auto measure = [&](double height_m) {
    surface::MadeCrg crg;
    crg.rows = 81, crg.step = 1.0;
    crg.z = [height_m](double u, double v) { return height_m * std::sin(0.15 * u) * std::cos(0.5 * v); };
    const auto text = crg.Text();
    std::ofstream(folder_ / "made.crg", std::ios::binary) << text;
  };
  const auto world = [&] {
    const auto parsed = road::World::Parse(R"(rodeira: world/2
name: measured
terrain:
  surface: grass
  generate: {seed: 3, columns: 97, rows: 41, spacing_m: 25, west_m: -200, south_m: -500,
    relief: [{wavelength_m: 300, amplitude_m: 8}]}
roads:
  - id: long
    start: {x_m: 0, y_m: 20, heading_deg: 0}
    axis: [line: {length_m: 1900}]
    z_m: 4
    section: {template: rural}
    surfaces:
      - {crg: made.crg, from_s_m: 900, to_s_m: 980}
      - {iso_8608: C, seed: 7, from_s_m: 10, to_s_m: 1800}
)",
                                           folder_ / "world.yaml");
    EXPECT_TRUE(parsed.ok()) << parsed.error().Text();
    return parsed.value();
  };
  measure(0.05);
  const DatabaseReport first = Write(*world(), "world");
  EXPECT_EQ(Write(*world(), "world").built, 0u);
  measure(0.06);
  const auto changed = world();
  const DatabaseReport again = Write(*changed, "world");
  // From 900 to 980 m, with the reach of slopes, on either side of y = 0: columns 3 and at most its neighbours.
  EXPECT_TRUE(again.built > 0 && again.built <= 6) << again.built << " of " << first.tiles;
  Write(*changed, "fresh");
  EXPECT_TRUE(Files("world") == Files("fresh"));
}

}  // namespace
}  // namespace rodeira::nodes
