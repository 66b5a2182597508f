// SPDX-License-Identifier: Apache-2.0
// The levels of the drawn ground against what is asked of each: 1 mm in plan and 3 mm in height at the finest, 2, 10
// and 50 cm at the others, on roads, verges, cuts and fills.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/world/network/network.hpp"
#include "tests/common/view/scene/correlation.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// As the numbers are asked, whatever the code takes.
constexpr std::array<Tolerances, 4> kTolerances = {
    {{0, 0.003, 0.003}, {1, 0.02, 0.02}, {2, 0.10, 0.10}, {3, 0.50, 0.50}}};
constexpr std::array<double, 4> kInPlan_m = {0.001, 0.02, 0.10, 0.50};

enum class Kind { kRoad, kVerge, kSlope, kLand };

// What SUELO has at a place: a slope is where the ground is no longer the terrain.
Kind KindAt(const road::World& world, const Eigen::Vector3d& p) {
  const auto place = world.network()->Locate(p.x(), p.y(), p.z() + 0.3);
  if (place && place->distance_m == 0.0) {
    const network::Lane* lane = world.network()->Find(place->lane);
    return lane != nullptr && lane->type == network::LaneType::kNone ? Kind::kVerge : Kind::kRoad;
  }
  const road::SurfacePoint ground = world.At(p.x(), p.y(), p.z() + 0.3), bare = world.TerrainAt(p.x(), p.y());
  return ground.inside && bare.inside && std::fabs(ground.z_m - bare.z_m) > 0.001 ? Kind::kSlope : Kind::kLand;
}

// Triangles that may hold a slope: some land between them and a road. On a plane slopes are narrow.
bool IsNearARoad(const road::World& world, const Mesh& mesh, std::size_t triangle) {
  const double reach_m = world.plane() ? 3.0 : 60.0;
  const auto corners = CornersOf(mesh, triangle);
  const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const double size_m =
      std::max((corners[0] - middle).norm(), std::max((corners[1] - middle).norm(), (corners[2] - middle).norm()));
  const auto place = world.network()->Locate(middle.x(), middle.y());
  return place && place->distance_m < reach_m + size_m;
}

void ExpectLevels(const std::string& name, const road::World& world, const std::vector<GroundTile>& tiles) {
  const auto near = [&](const Mesh& mesh, std::size_t i) { return IsNearARoad(world, mesh, i); };
  for (std::size_t level = 1; level < kTolerances.size(); ++level) {
    for (const auto& [kind, what] :
         {std::pair(Kind::kRoad, "roads"), std::pair(Kind::kVerge, "verges"), std::pair(Kind::kSlope, "slopes")}) {
      const Correlation found = Correlate(world, tiles, Points() / 10, 29, near, kTolerances[level],
                                          [&, of = kind](const Eigen::Vector3d& p) { return KindAt(world, p) == of; });
      EXPECT_EQ(found.asked, Points() / 10) << name << ", level " << level << ", " << what;
      EXPECT_EQ(found.far, 0) << name << ", level " << level << ", " << what << ": worst " << found.worst_m << " m at "
                              << found.where.transpose();
      EXPECT_LT(found.stepped, 0.01 * found.asked) << name << ", level " << level << ", " << what;
      std::printf("%s, level %zu, %s: %d points, %d farther off than %.2f m, %d at steps, worst %.4f m\n", name.c_str(),
                  level, what, found.asked, found.far, kTolerances[level].height_m, found.stepped, found.worst_m);
    }
  }
}

// A road of 12 and 15 m radius through hills of 6 m.
TEST(GroundLevels, OfSmallRadiiKeepWhatIsAsked) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: hairpin\nterrain:\n  generate: {seed: 5, columns: 41, rows: 41, spacing_m: 20, west_m: "
      "-400, south_m: -400, full_m: 30, flat_m: 5, relief: [{wavelength_m: 90, amplitude_m: 6}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -60, y_m: 0, heading_deg: 0}\n    axis: [line: {length_m: 60}, arc: "
      "{turn_deg: 150, radius_m: 12}, line: {length_m: 20}, arc: {turn_deg: 120, radius_m: -15}, line: {length_m: "
      "30}]\n"
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 70, z_m: 3, parabola_m: 60}, {s_m: 140, z_m: 4}]\n    section: "
      "{template: rural, verge: {width_m: 1.5}}\n",
      "hairpin.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  ExpectLevels("hairpin", *parsed.value(), BuildAll(*parsed.value()));
}

// The project's worlds, on random tiles of those through which a road runs.
TEST(GroundLevels, OfTheProjectsWorldsKeepWhatIsAsked) {
  const std::uint64_t at_most = Setting("RODEIRA_GROUND_TILES", 10) / 5;
  for (const std::string name : {"haste", "n222", "ring", "lights"}) {
    const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const std::shared_ptr<const road::World> seen = loaded.value()->AsSeen();
    const road::World& world = *seen;
    const GroundPlan plan(*loaded.value());
    std::set<TileKey> keys;
    const auto roads = world.network()->roads();
    for (std::uint64_t n = 0; keys.size() < at_most && n < 100 * at_most; ++n) {
      const network::Road& road = roads[base::RandomBits({n, 31}) % roads.size()];
      const WorldStep at = ToSteps(road.Surface(base::RandomUniform({n, 37}, 0.0, road.length_m()), 0.0).p_W.head<2>());
      keys.insert({TileOf(at.x), TileOf(at.y)});
    }
    const std::vector<TileKey> drawn(keys.begin(), keys.end());
    std::vector<GroundTile> tiles(drawn.size());
    ForEachAtOnce(tiles.size(), 0, [&](std::size_t i) { tiles[i] = plan.Build(drawn[i]); });
    ExpectLevels(name, world, tiles);
  }
}

// The tiles around a road's bridge: land comes up to its deck at both ends, and falls away below its sides. All levels,
// the finest too.
TEST(GroundLevels, LandBelowBridgesIsMet) {
  for (const auto& [name, id] : {std::pair("haste", "bridge"), std::pair("motorway", "over")}) {
    const auto loaded =
        road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (std::string(name) + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    const network::Road& road = world.network()->roads()[*world.network()->FindRoad(id)];
    const network::Structure& bridge = road.spec().structures.at(0);
    ASSERT_TRUE(bridge.bridge);
    std::set<TileKey> keys;
    const auto along = [&](double s_m) { return Eigen::Vector2d(road.Surface(s_m, 0.0).p_W.head<2>()); };
    for (double s_m = bridge.s_m - 10.0; s_m < bridge.s_m + bridge.length_m + 10.0; s_m += 5.0) {
      const WorldStep at = ToSteps(along(s_m));
      keys.insert({TileOf(at.x), TileOf(at.y)});
    }
    const GroundPlan plan(world);
    std::vector<GroundTile> tiles;
    for (const TileKey& key : keys) tiles.push_back(plan.Build(key));
    const double reach_m = 0.5 * bridge.length_m + 15.0;
    const Eigen::Vector2d middle = along(bridge.s_m + 0.5 * bridge.length_m);
    const auto near = [&](const Mesh& mesh, std::size_t i) {
      const auto corners = CornersOf(mesh, i);
      return ((corners[0] + corners[1] + corners[2]).head<2>() / 3.0 - middle).norm() < reach_m + 10.0;
    };
    for (const Tolerances& asked : kTolerances) {
      int below = 0;
      const Correlation found = Correlate(world, tiles, 4 * Points(), 71, near, asked, [&](const Eigen::Vector3d& p) {
        if ((p.head<2>() - middle).norm() > reach_m) return false;
        below += world.At(p.x(), p.y()).z_m > p.z() + 0.1;
        return true;
      });
      EXPECT_EQ(found.asked, 4 * Points()) << name << ", level " << asked.level;
      EXPECT_GT(below, found.asked / 50) << name << ", level " << asked.level;
      EXPECT_EQ(found.far, 0) << name << ", level " << asked.level << ": worst " << found.worst_m << " m at "
                              << found.where.transpose();
      EXPECT_LT(found.stepped, 0.002 * found.asked) << name << ", level " << asked.level;
      std::printf(
          "%s, level %zu: %d points, %d of them below the deck, %d at steps, %d farther off than %.3f m, worst %.4f "
          "m\n",
          name, asked.level, found.asked, below, found.stepped, found.far, asked.height_m, found.worst_m);
    }
  }
}

// Places of N222 and the motorway that were off at the finest level: a toe that winds through many triangles, a strip
// of a cut that ends within a few metres, the edge of a road that leans.
TEST(GroundLevels, NarrowStripsOfSlopesAreMet) {
  const std::vector<std::pair<std::string, std::vector<Eigen::Vector2d>>> places = {
      {"n222", {{981.5, 309.0}, {295.4, 33.2}, {1482.7, 436.6}, {294.7, 53.2}}},
      {"motorway", {{949.6, 97.2}, {1616.7, 308.6}, {2502.6, 1142.3}}}};
  for (const auto& [name, at] : places) {
    const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    const GroundPlan plan(world);
    std::set<TileKey> keys;
    for (const Eigen::Vector2d& p : at) keys.insert({TileOf(ToSteps(p).x), TileOf(ToSteps(p).y)});
    std::vector<GroundTile> tiles;
    for (const TileKey& key : keys) tiles.push_back(plan.Build(key));
    const auto is_there = [&](const Mesh& mesh, std::size_t i) {
      const auto c = CornersOf(mesh, i);
      const Eigen::Vector2d middle = (c[0] + c[1] + c[2]).head<2>() / 3.0;
      return std::any_of(at.begin(), at.end(),
                         [&](const Eigen::Vector2d& place) { return (middle - place).norm() < 30.0; });
    };
    for (const std::size_t level : {std::size_t{0}, std::size_t{1}}) {
      const Correlation found = Correlate(world, tiles, Points(), 67, is_there, kTolerances[level],
                                          [&](const Eigen::Vector3d& p) { return KindAt(world, p) == Kind::kSlope; });
      EXPECT_EQ(found.asked, Points()) << name;
      EXPECT_EQ(found.far, 0) << name << ", level " << level << ": worst " << found.worst_m << " m at "
                              << found.where.transpose();
      std::printf("%s, level %zu: %d points of slopes, %d farther off than %.3f m, worst %.4f m\n", name.c_str(), level,
                  found.asked, found.far, kTolerances[level].height_m, found.worst_m);
    }
  }
}

// In plan, a bend of 12 m radius: lanes' edges are circles about its middle, and faces, which have vertices of their
// own, end at them.
TEST(GroundLevels, LinesOfASmallRadiusLieWhereTheyAreAskedTo) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: bend\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: 100, "
      "y_m: 88, heading_deg: 0}\n    axis: [arc: {turn_deg: 180, radius_m: 12}]\n    z_m: 0\n"
      "    section: {lanes: [{id: -1, width_m: 3}, {id: 1, width_m: 3}], crossfall: {kind: crown, fall: 0}, shoulders: "
      "{left: {width_m: 0.5, fall: 0}, right: {width_m: 0.5, fall: 0}}, verge: {width_m: 1.5, fall: 0}}\n",
      "bend.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  const road::World& world = *parsed.value();
  const Eigen::Vector2d middle(100.0, 100.0);
  const network::Road& road = world.network()->roads()[0];
  const std::array<double, 7> radii_m = {7.0, 8.5, 9.0, 12.0, 15.0, 15.5, 17.0};
  for (const double radius_m : radii_m) {  // as the road itself says
    for (const double s : {1.0, 20.0, 30.0})
      EXPECT_NEAR((road.Surface(s, 12.0 - radius_m).p_W.head<2>() - middle).norm(), radius_m, 1e-9);
  }
  const GroundPlan plan(world);
  const GroundTile tile = plan.Build({0, 0});
  std::size_t before = 1'000'000;
  for (std::size_t level = 0; level < kGroundLevels; ++level) {
    struct Side {
      std::size_t mesh;
      std::uint32_t from, to;
    };
    std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, Side> sides;
    const auto& meshes = tile.levels[level].ground;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      for (std::size_t i = 0; i < meshes[m].triangle_count(); ++i) {
        if (IsWall(meshes[m], i)) continue;
        const auto corners = CornersOf(meshes[m], i);
        for (std::size_t k = 0; k < 3; ++k) {
          const Eigen::Vector3d &p = corners[k], &q = corners[(k + 1) % 3];
          sides[{{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z()}}] = {m, meshes[m].triangles[3 * i + k],
                                                                   meshes[m].triangles[3 * i + (k + 1) % 3]};
        }
      }
    }
    std::array<double, 7> worst_m{};
    std::array<std::size_t, 7> seen{};
    for (const auto& [ends, side] : sides) {
      const auto back = sides.find({ends.second, ends.first});
      if (back == sides.end() ||
          (back->second.mesh == side.mesh && back->second.from == side.to && back->second.to == side.from))
        continue;
      const Eigen::Vector2d p(ends.first[0], ends.first[1]), q(ends.second[0], ends.second[1]);
      if (p.x() < 100.01 && q.x() < 100.01) continue;  // the ends of the road, across it
      for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double radius_m = ((1.0 - part) * p + part * q - middle).norm();
        std::size_t nearest = 0;
        for (std::size_t k = 1; k < radii_m.size(); ++k) {
          if (std::fabs(radii_m[k] - radius_m) < std::fabs(radii_m[nearest] - radius_m)) nearest = k;
        }
        worst_m[nearest] = std::max(worst_m[nearest], std::fabs(radii_m[nearest] - radius_m));
        seen[nearest] += part == 0.5;
      }
    }
    std::size_t all = 0;
    for (std::size_t k = 0; k < radii_m.size(); ++k) {
      EXPECT_LE(worst_m[k], kInPlan_m[level]) << "level " << level << ", radius " << radii_m[k];
      if (level < 3) {  // then lines are no longer nearer to their own circle than to the next one
        EXPECT_GE(seen[k], level < 2 ? 10u : 4u) << "level " << level << ", radius " << radii_m[k];
      }
      all += seen[k];
    }
    EXPECT_LT(all, before) << "level " << level;
    EXPECT_GT(all, 20u) << "level " << level;
    before = all;
    std::printf("level %zu: %zu sides of lanes' edges, worst %.4f m from them\n", level, all,
                *std::max_element(worst_m.begin(), worst_m.end()));
  }
}

// Every 4 m along all roads, on both sides and up to 150 m from the outermost lane, where a tile is drawn as the
// terrain alone: how many such places there are.
int BesideRoadsOnBareTiles(const road::World& world, const GroundPlan& plan, const std::string& name) {
  std::set<TileKey> bare;
  for (const TileKey& key : plan.tiles()) {
    if (plan.FinestAlike(key, 1) != 1) bare.insert(key);
  }
  int places = 0;
  for (const network::Road& road : world.network()->roads()) {
    for (double s = 0.0; s <= road.length_m(); s += 4.0) {
      const auto section = road.SectionIndex(s);
      const network::LaneSection& lanes = road.SectionAt(s);
      for (const double side : {1.0, -1.0}) {
        const int outermost = side > 0.0 ? static_cast<int>(lanes.left.size()) : -static_cast<int>(lanes.right.size());
        const auto span = road.SpanAt(section, outermost, s);
        const double edge_m = outermost == 0 || !span ? 0.0 : span->outer_t_m;
        for (const double aside_m : {0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0, 100.0, 150.0}) {
          const Eigen::Vector2d p = road.Surface(s, edge_m + side * aside_m).p_W.head<2>();
          const TileKey key{static_cast<std::int64_t>(std::floor(p.x() / kTile_m)),
                            static_cast<std::int64_t>(std::floor(p.y() / kTile_m))};
          if (!bare.contains(key)) continue;
          ++places;
          EXPECT_EQ(world.At(p.x(), p.y()).z_m, world.TerrainAt(p.x(), p.y()).z_m)
              << name << ", " << aside_m << " m beside road " << road.id() << " at " << s << " m";
        }
      }
    }
  }
  return places;
}

// Tiles that are drawn as the terrain alone: there SUELO is the terrain, to the bit, whatever roads are near; and they
// are drawn within 1 mm of it, at all levels that are alike, which have the same triangles.
TEST(GroundLevels, BareTilesHoldTheTerrainAlone) {
  for (const std::string name : {"haste", "n222", "motorway"}) {
    const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const road::World& world = *loaded.value();
    const GroundPlan plan(world);
    std::size_t bare = 0;
    std::vector<GroundTile> tiles;
    for (const TileKey& key : plan.tiles()) {
      if (plan.FinestAlike(key, 1) == 1) continue;
      ++bare;
      for (std::uint64_t n = 0; n < 40; ++n) {
        const auto draw = [&](std::uint64_t what) {
          return base::RandomUniform(
              {static_cast<std::uint64_t>(key.column), static_cast<std::uint64_t>(key.row), n, what}, 0.0, kTile_m);
        };
        const Eigen::Vector2d p = key.south_west_W() + Eigen::Vector2d(n == 0   ? 0.0
                                                                       : n == 1 ? kTile_m
                                                                                : draw(0),
                                                                       n == 2   ? 0.0
                                                                       : n == 3 ? kTile_m
                                                                                : draw(1));
        ASSERT_EQ(world.At(p.x(), p.y()).z_m, world.TerrainAt(p.x(), p.y()).z_m) << name << " " << p.transpose();
      }
      if (bare % 40 == 1) tiles.push_back(plan.Build(key));
    }
    EXPECT_GT(bare, plan.tiles().size() / 4) << name;
    EXPECT_GT(BesideRoadsOnBareTiles(world, plan, name), 20)
        << name;  // slopes are narrow: points anywhere hardly meet one
    for (const GroundTile& tile : tiles) {
      ASSERT_EQ(tile.levels[0].ground.size(), 1u);
      for (int level = 1; level < kGroundLevels && plan.FinestAlike(tile.key, level) == 0; ++level) {
        const Mesh &finest = tile.levels[0].ground[0],
                   &other = tile.levels[static_cast<std::size_t>(level)].ground.at(0);
        EXPECT_TRUE(finest.positions == other.positions && finest.triangles == other.triangles);
      }
    }
    const Correlation found = Correlate(world, tiles, Points(), 41, [](const Mesh&, std::size_t) { return true; });
    EXPECT_EQ(found.asked, Points());
    EXPECT_LT(found.worst_m, 0.001) << name << " at " << found.where.transpose();
    std::printf("%s: %zu of %zu tiles hold the terrain alone, worst %.5f m\n", name.c_str(), bare, plan.tiles().size(),
                found.worst_m);
  }
}

}  // namespace
}  // namespace rodeira::scene
