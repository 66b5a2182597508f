// SPDX-License-Identifier: Apache-2.0
// The ground as it is drawn, against itself: it has no hole, and nothing of it looks down.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// A place to the bit: coordinates of drawn points are whole steps.
using Place = std::array<double, 3>;
Place PlaceOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

// Every side of every triangle has one that goes back along it, but on the tile's own edge. So there is no hole, no
// T-junction and nothing that faces down.
TEST(Ground, IsClosed) {
  const auto world = OpenDriveWorld(BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const auto tiles = BuildAll(*world);
  ASSERT_FALSE(tiles.empty());
  std::size_t all_sides = 0;
  for (const GroundTile& tile : tiles) {
    for (const GroundLevel& level : tile.levels) {
      std::map<std::pair<Place, Place>, int> sides;
      for (const Mesh& mesh : level.ground) {
        for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
          const auto corners = CornersOf(mesh, i);
          if (!IsWall(mesh, i)) {
            const Eigen::Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
            EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0.0) << "it faces down";
            for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(mesh.normals[mesh.triangles[3 * i + k]].z(), 0.0F);
          }
          for (std::size_t k = 0; k < 3; ++k) ++sides[{PlaceOf(corners[k]), PlaceOf(corners[(k + 1) % 3])}];
        }
      }
      const Eigen::Vector2d low = tile.key.south_west_W(), high = low + Eigen::Vector2d::Constant(kTile_m);
      int open = 0;
      for (const auto& [side, count] : sides) {
        const auto back = sides.find({side.second, side.first});
        if (back != sides.end() && back->second == count) continue;
        const auto on_edge = [&](const Place& p) {
          return p[0] == low.x() || p[1] == low.y() || p[0] == high.x() || p[1] == high.y();
        };
        if (on_edge(side.first) && on_edge(side.second)) continue;
        ++open;
      }
      EXPECT_EQ(open, 0) << "tile " << tile.key.column << " " << tile.key.row;
      all_sides += sides.size();
    }
  }
  EXPECT_GT(all_sides, 10'000u);
}

// From the road below a deck is seen: all of it, 0.9 m under its lanes and verges.
TEST(Ground, ABridgeHasAnUnderside) {
  const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/motorway.yaml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const road::World& world = *loaded.value();
  const network::Network& network = *world.network();
  const network::Road& road = network.roads()[*network.FindRoad("over")];
  const network::Structure& bridge = road.spec().structures.at(0);
  const Eigen::Vector2d middle = road.Surface(bridge.s_m + 0.5 * bridge.length_m, 0.0).p_W.head<2>();
  const network::LaneSection& section = road.spec().sections[0];
  const double width_m = road.SpanAt(0, static_cast<int>(section.left.size()), 400.0)->outer_t_m -
                         road.SpanAt(0, -static_cast<int>(section.right.size()), 400.0)->outer_t_m;
  const GroundPlan plan(world);
  for (std::size_t level = 0; level < kGroundLevels; ++level) {
    double area_m2 = 0.0;
    for (const TileKey& key : plan.tiles()) {
      const Eigen::Vector2d tile_middle = key.south_west_W() + Eigen::Vector2d::Constant(0.5 * kTile_m);
      if ((tile_middle - middle).cwiseAbs().maxCoeff() > kTile_m) continue;
      const GroundTile tile = plan.Build(key);
      for (const Mesh& mesh : tile.levels[level].ground) {
        for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
          if (mesh.normals[mesh.triangles[3 * i]].z() > -0.5F) continue;
          const auto c = CornersOf(mesh, i);
          const Eigen::Vector3d u = c[1] - c[0], v = c[2] - c[0];
          area_m2 -= 0.5 * (u.x() * v.y() - u.y() * v.x());
          if (level > 0 || u.cross(v).norm() < 0.02) continue;  // slivers at the edges lie beside the deck
          const Eigen::Vector3d p = (c[0] + c[1] + c[2]) / 3.0;
          EXPECT_NEAR(world.At(p.x(), p.y()).z_m - p.z(), 0.9, 0.01) << p.transpose();
        }
      }
    }
    // At its ends a deck lies on the land.
    EXPECT_GT(area_m2 / (bridge.length_m * width_m), 0.9) << "level " << level;
    EXPECT_LT(area_m2 / (bridge.length_m * width_m), 1.02) << "level " << level;
  }
}

// What is not closed of a tile at one level: sides of triangles that none goes back along, but on the tile's own edge,
// and faces that look down.
struct Flaws {
  std::vector<Eigen::Vector3d> open;  // sides of the ground: where they begin
  std::vector<Eigen::Vector3d>
      met;         // the same where some go back, but not as many: more than two sheets meet in a line
  int free = 0;    // lower sides and ends of walls, which hang: aprons of bridges, cliffs beside them
  int turned = 0;  // triangles of the ground that face down, or with corners' normals that do
};

Flaws FlawsOf(const GroundTile& tile, std::size_t level) {
  struct Side {
    int count = 0;
    bool wall = false;
  };
  std::map<std::pair<Place, Place>, Side> sides;
  Flaws flaws;
  for (const Mesh& mesh : tile.levels[level].ground) {
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const auto corners = CornersOf(mesh, i);
      const bool wall = IsWall(mesh, i);
      if (!wall) {
        const Eigen::Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
        bool up = u.x() * v.y() - u.y() * v.x() > 0.0;
        for (std::size_t k = 0; k < 3; ++k) up = up && mesh.normals[mesh.triangles[3 * i + k]].z() > 0.0F;
        flaws.turned += !up;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        Side& side = sides[{PlaceOf(corners[k]), PlaceOf(corners[(k + 1) % 3])}];
        ++side.count;
        side.wall = side.wall || wall;
      }
    }
  }
  const Eigen::Vector2d low = tile.key.south_west_W(), high = low + Eigen::Vector2d::Constant(kTile_m);
  const auto on_edge = [&](const Place& p) {
    return p[0] == low.x() || p[1] == low.y() || p[0] == high.x() || p[1] == high.y();
  };
  for (const auto& [side, found] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (back != sides.end() && back->second.count == found.count) continue;
    if (on_edge(side.first) && on_edge(side.second)) continue;
    if (found.wall)
      ++flaws.free;
    else if (back != sides.end())
      flaws.met.emplace_back(side.first[0], side.first[1], side.first[2]);
    else
      flaws.open.emplace_back(side.first[0], side.first[1], side.first[2]);
  }
  return flaws;
}

// The same for the project's worlds at every level, on random tiles and on all at bridges: there is no open side,
// also not where a deck begins: the ground below it stops at an abutment, up to the deck's underside, and aprons at its
// sides meet the underside.
TEST(Ground, OfTheProjectsWorldsIsClosed) {
  const std::uint64_t at_most = Setting("RODEIRA_GROUND_TILES", 10) / 2;  // each of them at all levels
  const std::vector<std::pair<std::string, bool>> worlds = {
      // whether it has bridges
      {"haste", true}, {"motorway", true}, {"n222", false},         {"flat", false},
      {"ring", false}, {"lights", false},  {"example/world", true},
  };
  for (const auto& [name, has_bridges] : worlds) {
    const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(world.ok()) << world.error().Text();
    std::vector<Eigen::Vector2d> bridges;
    for (const network::Road& road : world.value()->network()->roads()) {
      for (const network::Structure& structure : road.spec().structures) {
        for (double s = structure.s_m; s <= structure.s_m + structure.length_m; s += 5.0)
          bridges.push_back(road.Surface(std::min(s, road.length_m()), 0.0).p_W.head<2>());
      }
    }
    const GroundPlan plan(*world.value());
    std::set<TileKey> keys;
    for (std::uint64_t n = 0; n < at_most; ++n)
      keys.insert(plan.tiles()[base::RandomBits({n, 23}) % plan.tiles().size()]);
    const auto is_near = [&](const TileKey& key) {
      const Eigen::Vector2d low = key.south_west_W(), high = low + Eigen::Vector2d::Constant(kTile_m);
      return std::any_of(bridges.begin(), bridges.end(), [&](const Eigen::Vector2d& p) {
        return (p.array() > low.array() - 20.0).all() && (p.array() < high.array() + 20.0).all();
      });
    };
    for (const TileKey& key : plan.tiles()) {
      if (is_near(key)) keys.insert(key);
    }
    int at_bridges = 0;
    for (const TileKey& key : keys) {
      const GroundTile tile = plan.Build(key);
      at_bridges += is_near(key);
      for (std::size_t level = 0; level < kGroundLevels; ++level) {
        const Flaws flaws = FlawsOf(tile, level);
        const auto first = [](const std::vector<Eigen::Vector3d>& places) {
          return places.empty() ? Eigen::Vector3d(0.0, 0.0, 0.0) : places.front();
        };
        EXPECT_EQ(flaws.met.size(), 0u) << name << ", level " << level << ", tile " << key.column << " " << key.row
                                        << ": three sheets meet at " << first(flaws.met).transpose();
        EXPECT_EQ(flaws.open.size(), 0u) << name << ", level " << level << ", tile " << key.column << " " << key.row
                                         << ": open at " << first(flaws.open).transpose();
        EXPECT_EQ(flaws.turned, 0) << name << ", level " << level << ", tile " << key.column << " " << key.row;
        EXPECT_EQ(flaws.free, 0) << name << ", level " << level << ", tile " << key.column << " " << key.row;
      }
    }
    EXPECT_EQ(at_bridges > 0, has_bridges) << name << ": " << at_bridges << " tiles at bridges";
    EXPECT_GT(keys.size(), 0u) << name;
    std::printf("%s: %zu of %zu tiles looked through at every level, %d of them at bridges: no open side\n",
                name.c_str(), keys.size(), plan.tiles().size(), at_bridges);
  }
}

// Roads of real files cross and step anywhere, and walls hang there; the ground itself has no open side and nothing
// that faces down.
TEST(Ground, OfRealFilesIsClosed) {
  for (const std::string& name : RealGrounds()) {
    if (!std::filesystem::exists(SharedXodr(name))) GTEST_SKIP() << "skipped: " << SharedXodr(name) << " is absent";
    const auto world = road::World::Load(SharedXodr(name));
    ASSERT_TRUE(world.ok()) << world.error().Text();
    int open = 0, turned = 0, hang = 0;
    for (const GroundTile& tile : BuildAll(*world.value())) {
      for (std::size_t level = 0; level < kGroundLevels; ++level) {
        const Flaws flaws = FlawsOf(tile, level);
        open += static_cast<int>(flaws.open.size() + flaws.met.size()), turned += flaws.turned, hang += flaws.free;
        for (const Eigen::Vector3d& p : flaws.open)
          ADD_FAILURE() << name << ", level " << level << ", tile " << tile.key.column << " " << tile.key.row
                        << ": open at " << p.transpose();
        for (const Eigen::Vector3d& p : flaws.met)
          ADD_FAILURE() << name << ", level " << level << ", tile " << tile.key.column << " " << tile.key.row
                        << ": three sheets meet at " << p.transpose();
      }
    }
    EXPECT_EQ(turned, 0) << name;
    std::printf("%s: %d open sides, %d faces look down, %d sides of walls hang free\n", name.c_str(), open, turned,
                hang);
  }
}

// The sides of a tile's ground on one of its edges: from place to place, in order, and as often as they are there.
using EdgeSides = std::vector<std::array<double, 4>>;  // from where, its height; to where, its height

enum Edge : std::size_t { kWest, kEast, kSouth, kNorth };

EdgeSides SidesOn(const GroundTile& tile, std::size_t level, Edge edge) {
  const bool column = edge == kWest || edge == kEast;
  const Eigen::Vector2d low = tile.key.south_west_W();
  const double at = (column ? low.x() : low.y()) + (edge == kEast || edge == kNorth ? kTile_m : 0.0);
  EdgeSides sides;
  for (const Mesh& mesh : tile.levels[level].ground) {
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      if (IsWall(mesh, i)) continue;
      const auto corners = CornersOf(mesh, i);
      for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d &p = corners[k], &q = corners[(k + 1) % 3];
        if ((column ? p.x() : p.y()) != at || (column ? q.x() : q.y()) != at) continue;
        std::array<double, 2> a = {column ? p.y() : p.x(), p.z()}, b = {column ? q.y() : q.x(), q.z()};
        if (b[0] < a[0]) std::swap(a, b);
        sides.push_back({a[0], a[1], b[0], b[1]});
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

// All levels of all tiles have the same sides on a common edge, to the bit: then any two levels of two neighbours fit.
// How many neighbours there are.
int ExpectNeighboursFit(const road::World& world, const std::string& name, std::size_t least_sides) {
  const GroundPlan plan(world);
  std::vector<std::array<EdgeSides, 4>> edges(plan.tiles().size());
  std::vector<std::string> differ(plan.tiles().size());
  ForEachAtOnce(edges.size(), 0, [&](std::size_t i) {  // a world's tiles at once are too many
    const GroundTile tile = plan.Build(plan.tiles()[i]);
    for (const Edge edge : {kWest, kEast, kSouth, kNorth}) {
      edges[i][edge] = SidesOn(tile, 0, edge);
      for (std::size_t level = 1; level < kGroundLevels; ++level) {
        if (SidesOn(tile, level, edge) != edges[i][edge])
          differ[i] += fmt::format(" edge {} at level {}", static_cast<int>(edge), level);
      }
    }
  });
  std::map<TileKey, std::size_t> number;
  for (std::size_t i = 0; i < edges.size(); ++i) number[plan.tiles()[i]] = i;
  int pairs = 0;
  std::size_t sides = 0;
  for (const auto& [key, i] : number) {
    EXPECT_TRUE(differ[i].empty()) << name << ", tile " << key.column << " " << key.row << ":" << differ[i];
    for (const bool column : {true, false}) {
      const auto beside = number.find(column ? TileKey{key.column + 1, key.row} : TileKey{key.column, key.row + 1});
      if (beside == number.end()) continue;
      ++pairs;
      const EdgeSides &own = edges[i][column ? kEast : kNorth], &other = edges[beside->second][column ? kWest : kSouth];
      EXPECT_GE(own.size(), least_sides) << name;
      sides += own.size();
      const auto at = std::mismatch(own.begin(), own.end(), other.begin(), other.end()).first;
      EXPECT_TRUE(own == other) << name << ", tile " << key.column << " " << key.row
                                << (column ? " and the next to the east" : " and the next to the north") << ", at "
                                << (at == own.end() ? -1.0 : (*at)[0]);
    }
  }
  std::printf("%s: %d pairs of neighbours have the same %zu sides on their common edges at all levels\n", name.c_str(),
              pairs, sides);
  return pairs;
}

TEST(Ground, NeighboursFitAtEveryPairOfLevels) {
  const auto world = OpenDriveWorld(BendUnderBridge(700.0, -300.0));
  ASSERT_NE(world, nullptr);
  EXPECT_GE(ExpectNeighboursFit(*world, "bend", 16), 21);
}

// Where land is the terrain's own triangles, and where slopes pass from one tile into another, each tile's edge has
// points of its own.
TEST(Ground, NeighboursFitOnATerrain) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: slopes\nterrain:\n  generate: {seed: 6, columns: 81, rows: 81, spacing_m: 15, west_m: "
      "-600, south_m: -600, full_m: 50, flat_m: 8, relief: [{wavelength_m: 160, amplitude_m: 15}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -300, y_m: -100, heading_deg: 20}\n    axis: [line: {length_m: 200}, arc: "
      "{length_m: 300, radius_m: 250}]\n    z_m: 2\n    section: {template: rural}\n",
      "slopes.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  EXPECT_GE(ExpectNeighboursFit(*parsed.value(), "slopes", 1), 40);
}

// The project's worlds and real files, the first RODEIRA_NEIGHBOUR_WORLDS (2) of them: those first on which neighbours
// did not fit.
TEST(Ground, NeighboursFitInTheProjectsWorldsAndRealFiles) {
  const auto worlds = std::filesystem::path(SourceDir()) / "configs/worlds";
  std::vector<std::filesystem::path> all = {SharedXodr("esmini_tunnels"), SharedXodr("esmini_curves_elevation"),
                                            worlds / "example/world.yaml", worlds / "flat.yaml"};
  for (const char* name : {"ring", "lights", "n222", "motorway", "haste"})
    all.push_back(worlds / (std::string(name) + ".yaml"));
  std::set<std::filesystem::path> files;
  if (std::filesystem::exists(SharedXodr("esmini_tunnels"))) {
    for (const auto& file : std::filesystem::directory_iterator(SharedXodr("esmini_tunnels").parent_path())) {
      if (file.path().extension() == ".xodr") files.insert(file.path());
    }
  }
  for (const auto& file : files) {
    if (std::find(all.begin(), all.end(), file) == all.end()) all.push_back(file);
  }
  all.resize(std::min<std::size_t>(all.size(), Setting("RODEIRA_NEIGHBOUR_WORLDS", 2)));
  int looked_at = 0;
  for (const auto& path : all) {
    if (!std::filesystem::exists(path)) continue;
    const auto world = road::World::Load(path);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    EXPECT_GE(ExpectNeighboursFit(*world.value(), path.filename().string(), 1), 30) << path;
    ++looked_at;
  }
  if (looked_at == 0) GTEST_SKIP() << "skipped: no world is there";
}

}  // namespace
}  // namespace rodeira::scene
