// SPDX-License-Identifier: Apache-2.0
// The ground as it is drawn, against SUELO.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <set>
#include <unistd.h>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "tests/common/view/scene/correlation.hpp"
#include "tests/common/view/scene/ground_tiles.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/common/view/scene/worlds.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/long_form.hpp"
#include "tests/setting.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

// Chords of the finest level, on roads as beside them.
constexpr Tolerances kFinest{0, 0.003, 0.003};
const auto everywhere = [](const Eigen::Vector3d&) { return true; };

TEST(Ground, IsWhereTheTyresAre) {
  const auto world = OpenDriveWorld(BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const Correlation found = Correlate(*world, BuildAll(*world), Points(), 1);
  EXPECT_EQ(found.asked, Points());
  EXPECT_LT(found.stepped, 0.002 * found.asked);
  EXPECT_LT(found.worst_m, 0.005) << "at " << found.where.transpose();
  std::printf("%d points, %d at steps, worst %.4f m from SUELO\n", found.asked, found.stepped, found.worst_m);
}

// Beyond the slopes land is made of the terrain's own triangles: where a tile and those around it are whole within the
// terrain.
TEST(Ground, LandIsTheTerrainsOwnTriangles) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: land\nterrain:\n  generate: {seed: 4, columns: 49, rows: 61, spacing_m: 20, west_m: "
      "-300, south_m: -300, full_m: 60, flat_m: 10, relief: [{wavelength_m: 150, amplitude_m: 20}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -280, y_m: -200, heading_deg: 0}\n    axis: [line: {length_m: 120}]\n    "
      "z_m: 0\n    section: {template: rural, slopes: {reach_m: 40}}\n",
      "land.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  const road::World& world = *parsed.value();
  const Correlation land = Correlate(world, BuildAll(world), Points(), 5, [&](const Mesh& mesh, std::size_t i) {
    const auto corners = CornersOf(mesh, i);
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    return middle.x() > 0.0 && middle.x() < 256.0 && middle.y() > 0.0 && middle.y() < 512.0;
  });
  EXPECT_EQ(land.asked, Points());
  EXPECT_LT(land.worst_m, 0.005) << "at " << land.where.transpose();
}

// A hump, a ramp and a sheet of ice, on a straight and in a bend.
TEST(Ground, WhatIsLaidOnRoadsIsWhereTheTyresAre) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: laid\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: 0, "
      "y_m: 10, heading_deg: 20}\n    axis: [line: {length_m: 60}, arc: {turn_deg: 80, radius_m: 40}]\n    z_m: 0\n"
      "    section: {template: rural}\n    patches: [{from_s_m: 20, to_s_m: 30, from_t_m: -2.5, to_t_m: 1, friction: "
      "0.1}, {from_s_m: 10, to_s_m: 14, from_t_m: -2, to_t_m: 2, material: soil, friction: 0.3}]\n"
      "    bumps:\n      - {from_s_m: 40, to_s_m: 43.7, height_m: 0.1}\n      - {from_s_m: 80, to_s_m: 90, from_t_m: "
      "-3, to_t_m: 2, side_m: 0.2, heights: [{s_m: 0, z_m: 0}, {s_m: 2, z_m: 0.15}, {s_m: 8, z_m: 0.15}, {s_m: 10, "
      "z_m: 0}]}\n",
      "laid.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  const road::World& world = *parsed.value();
  const std::vector<GroundTile> tiles = BuildAll(world);
  const Correlation found = Correlate(world, tiles, Points(), 7);
  EXPECT_EQ(found.asked, Points());
  EXPECT_EQ(found.stepped, 0);
  EXPECT_LT(found.worst_m, 0.005) << "at " << found.where.transpose();
  int raised = 0, pale = 0, earth = 0;
  for (const GroundTile& tile : tiles) {
    for (const Mesh& mesh : tile.levels[0].ground) {
      for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        if (!IsRoad(mesh) && !IsWall(mesh, i)) {  // of earth, on the road
          const Eigen::Vector3d at = (CornersOf(mesh, i)[0] + CornersOf(mesh, i)[1] + CornersOf(mesh, i)[2]) / 3.0;
          const auto place = world.network()->Locate(at.x(), at.y());
          if (place && place->distance_m == 0.0 && std::fabs(place->t_m) < 2.0) {
            EXPECT_TRUE(place->s_m > 10.0 && place->s_m < 14.0) << place->s_m;
            EXPECT_LT(mesh.colours[mesh.triangles[3 * i]].red, 160);
            ++earth;
          }
        }
        if (!IsRoad(mesh)) continue;
        const auto corners = CornersOf(mesh, i);
        const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const auto place = world.network()->Locate(middle.x(), middle.y());
        ASSERT_TRUE(place);
        const bool iced = place->s_m > 20.0 && place->s_m < 30.0 && place->t_m > -2.5 && place->t_m < 1.0;
        EXPECT_EQ(mesh.colours[mesh.triangles[3 * i]].red > 170, iced) << place->s_m << " " << place->t_m;
        pale += iced;
        raised += middle.z() > 0.09;
      }
    }
  }
  EXPECT_GT(pale, 3);
  EXPECT_GT(earth, 1);
  EXPECT_GT(raised, 50);
}

// A hump over the mouth of a crossing, and ice from there to its middle.
TEST(Ground, WhatIsLaidOnJunctionsIsWhereTheTyresAre) {
  const std::string bump = "    bumps: [{from_s_m: 66, to_s_m: 71, height_m: 0.12}]\n";
  const auto text = [](const std::string& laid) {
    return "rodeira: world/2\nname: laid\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: "
           "0, y_m: 10, heading_deg: 20}\n    axis: [line: {length_m: 160}]\n    z_m: 0\n"
           "    section: {template: rural}\n    patches: [{from_s_m: 60, to_s_m: 84, from_t_m: -3, to_t_m: 3, "
           "friction: 0.1}]\n" +
           laid +
           "  - id: b\n    place: {road: a, s_m: 80, turn_deg: 80, own_s_m: 60}\n    axis: [line: {length_m: 120}]\n   "
           " section: {template: rural}\n"
           "junctions:\n  - {id: j, roads: [{road: a, s_m: 80}, {road: b, s_m: 60}]}\n";
  };
  const auto parsed = road::World::Parse(text(bump), "laid.yaml"), bare = road::World::Parse(text(""), "bare.yaml");
  ASSERT_TRUE(parsed.ok() && bare.ok());
  const road::World& world = *parsed.value();
  const std::vector<GroundTile> tiles = BuildAll(world);
  const Eigen::Vector2d along(std::cos(20.0 * M_PI / 180.0), std::sin(20.0 * M_PI / 180.0)),
      top = Eigen::Vector2d(0.0, 10.0) + 68.5 * along;
  EXPECT_NEAR(world.At(top.x(), top.y()).z_m - bare.value()->At(top.x(), top.y()).z_m, 0.12, 1e-9);
  const Correlation found = Correlate(world, tiles, Points(), 9, [&](const Mesh& mesh, std::size_t i) {
    const auto corners = CornersOf(mesh, i);
    return IsRoad(mesh) && ((corners[0] + corners[1] + corners[2]).head<2>() / 3.0 - top).norm() < 16.0;
  });
  EXPECT_EQ(found.asked, Points());
  EXPECT_EQ(found.stepped, 0);
  EXPECT_LT(found.worst_m, 0.005) << "at " << found.where.transpose();
  std::printf("%d points of a junction, %d more than 5 mm from SUELO, worst %.4f m\n", found.asked, found.far,
              found.worst_m);
}

// The project's own worlds: roads, verges, cuts, fills, land and what lies between the roads of a junction, on random
// tiles. Made roughness and the short waves of measured surfaces are not drawn: there SUELO is asked without
// them.
TEST(Ground, OfTheProjectsWorldsIsWhereTheTyresAre) {
  const std::uint64_t at_most = Setting("RODEIRA_GROUND_TILES", 20);
  for (const std::string name : {"haste", "motorway", "n222", "example/world", "ring", "lights", "flat"}) {
    const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const std::shared_ptr<const road::World> seen = loaded.value()->AsSeen();
    const road::World& world = *seen;
    const GroundPlan plan(*loaded.value());
    std::vector<std::size_t> drawn(plan.tiles().size());
    std::iota(drawn.begin(), drawn.end(), std::size_t{0});
    std::sort(drawn.begin(), drawn.end(), [](std::size_t a, std::size_t b) {
      return base::RandomBits({a, 17}) < base::RandomBits({b, 17});
    });
    // Of a long road's tiles most have no road.
    drawn.resize(std::min<std::size_t>(drawn.size(), drawn.size() > 500 ? 3 * at_most : at_most));
    std::vector<GroundTile> tiles(drawn.size());
    ForEachAtOnce(tiles.size(), 0, [&](std::size_t i) { tiles[i] = plan.Build(plan.tiles()[drawn[i]]); });
    for (const bool road : {true, false}) {
      if (!road && name == "flat") continue;  // all of it is asphalt
      const Correlation found = Correlate(
          world, tiles, Points(), 11,
          [&](const Mesh& mesh, std::size_t i) {
            if (IsRoad(mesh) != road) return false;
            const auto corners = CornersOf(mesh, i);
            const auto there = [&](const Eigen::Vector3d& p) { return world.At(p.x(), p.y()).inside; };
            return std::all_of(corners.begin(), corners.end(),
                               there);  // around the terrain land goes on to the end of its tiles
          },
          kFinest, everywhere);
      EXPECT_EQ(found.asked, Points());
      // Where a bridge's deck comes down to land that its slopes leave standing there is a wall's foot, narrower than
      // faces are.
      EXPECT_LE(found.far, road ? 0.0 : 1e-5 * found.asked)
          << name << (road ? ", roads" : ", beside them") << ": worst " << found.worst_m << " m at "
          << found.where.transpose();
      EXPECT_LT(found.stepped, 0.001 * found.asked) << name;
      std::printf("%s, %s: %d points on %zu of %zu tiles, %d at steps, %d more than 3 mm from SUELO, worst %.4f m\n",
                  name.c_str(), road ? "roads" : "beside them", found.asked, tiles.size(), plan.tiles().size(),
                  found.stepped, found.far, found.worst_m);
    }
  }
}

// Lines along a measured surface have points where it bends, and not only where the road itself does: the example's
// main road from 5 m before its measured 20 m to 5 m behind them.
TEST(Ground, LinesOverAMeasuredSurfaceAreWhereTheTyresAre) {
  const auto loaded = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/example/world.yaml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const auto seen = loaded.value()->AsSeen();
  const network::Road& road = seen->network()->roads()[*seen->network()->FindRoad("main/2")];
  ASSERT_EQ(road.spec().crg.size(), 1u);
  const double from_s_m = road.spec().crg[0].s_start_m - 5.0, to_s_m = road.spec().crg[0].s_end_m + 5.0;
  std::set<TileKey> keys;
  for (double s = from_s_m; s <= to_s_m; s += 1.0) {
    const WorldStep at = ToSteps(road.Surface(s, 0.0).p_W.head<2>());
    keys.insert({TileOf(at.x), TileOf(at.y)});
  }
  const GroundPlan plan(*loaded.value());
  std::vector<GroundTile> tiles;
  for (const TileKey& key : keys) tiles.push_back(plan.Build(key));
  const auto is_there = [&](const Mesh& mesh, std::size_t i) {
    const auto c = CornersOf(mesh, i);
    const Eigen::Vector3d middle = (c[0] + c[1] + c[2]) / 3.0;
    const auto place = seen->network()->Locate(middle.x(), middle.y(), middle.z());
    return IsRoad(mesh) && place && place->distance_m == 0.0 && &seen->network()->roads()[place->lane.road] == &road &&
           place->s_m > from_s_m && place->s_m < to_s_m;
  };
  const Correlation found = Correlate(*seen, tiles, 8 * Points(), 61, is_there, kFinest, everywhere);
  EXPECT_EQ(found.asked, 8 * Points());
  EXPECT_EQ(found.far, 0) << "worst " << found.worst_m << " m at " << found.where.transpose();
  std::printf("%d points, worst %.4f m from SUELO\n", found.asked, found.worst_m);
}

// A road of class E is drawn as the same road without any roughness, to the bit; of a measured surface of 8 cm with
// waves of 3 cm the 8 cm are seen.
TEST(Ground, WhatIsRoughIsDrawnEven) {
  const auto text = [](const std::string& surfaces) {
    return "rodeira: world/2\nname: rough\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: "
           "10, y_m: 10, heading_deg: 20}\n    axis: [line: {length_m: 200}]\n    z_m: 0\n"
           "    section: {template: rural}\n" +
           surfaces;
  };
  const auto even = road::World::Parse(text(""), "even.yaml"),
             rough = road::World::Parse(text("    surfaces: [{iso_8608: E, seed: 1}]\n"), "rough.yaml");
  ASSERT_TRUE(even.ok() && rough.ok());
  EXPECT_EQ(even.value()->AsSeen(), even.value());
  const Eigen::Vector2d ahead(std::cos(20.0 * M_PI / 180.0), std::sin(20.0 * M_PI / 180.0));
  double highest_m = 0.0;
  for (double s_m = 10.0; s_m < 190.0; s_m += 0.7) {
    const Eigen::Vector2d p = Eigen::Vector2d(10.0, 10.0) + s_m * ahead;
    highest_m =
        std::max(highest_m, std::fabs(rough.value()->At(p.x(), p.y()).z_m - even.value()->At(p.x(), p.y()).z_m));
  }
  EXPECT_GT(highest_m, 0.05);  // tyres feel it
  const auto of_even = BuildAll(*even.value()), of_rough = BuildAll(*rough.value());
  ASSERT_EQ(of_even.size(), of_rough.size());
  for (std::size_t i = 0; i < of_even.size(); ++i) {
    for (std::size_t level = 0; level < kGroundLevels; ++level) {
      ASSERT_EQ(of_even[i].levels[level].ground.size(), of_rough[i].levels[level].ground.size());
      for (std::size_t m = 0; m < of_even[i].levels[level].ground.size(); ++m) {
        EXPECT_TRUE(of_even[i].levels[level].ground[m].positions == of_rough[i].levels[level].ground[m].positions)
            << "tile " << i << ", level " << level;
        EXPECT_TRUE(of_even[i].levels[level].ground[m].triangles == of_rough[i].levels[level].ground[m].triangles)
            << "tile " << i << ", level " << level;
      }
    }
  }

  surface::MadeCrg crg;
  crg.rows = 401, crg.step = 0.05;
  crg.v = {-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0};
  crg.z = [](double u, double v) { return 0.08 + 0.03 * std::sin(2.0 * M_PI * u / 0.3) * std::cos(v); };
  const auto file = std::filesystem::temp_directory_path() / fmt::format("rodeira_rough_{}.crg", ::getpid());
  ASSERT_TRUE(base::WriteWhole(file, std::string_view(crg.Text())).ok());
  const auto waves = road::World::Parse(
      text("    surfaces: [{crg: " + file.string() + ", from_s_m: 100, to_s_m: 120}]\n"), "waves.yaml");
  std::filesystem::remove(file);
  ASSERT_TRUE(waves.ok()) << waves.error().Text();
  std::size_t count = 0, before = 0;
  double lowest_m = 1e9, top_m = -1e9;
  for (const GroundTile& tile : of_even) {
    for (const Mesh& mesh : tile.levels[0].ground) before += mesh.triangle_count();
  }
  for (const GroundTile& tile : BuildAll(*waves.value())) {
    for (const Mesh& mesh : tile.levels[0].ground) {
      count += mesh.triangle_count();
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3d p = mesh.PositionW(i);
        const Eigen::Vector2d from = p.head<2>() - Eigen::Vector2d(10.0, 10.0);
        const double s_m = from.dot(ahead), t_m = ahead.x() * from.y() - ahead.y() * from.x();
        if (s_m < 102.5 || s_m > 117.5 || std::fabs(t_m) > 1.0) continue;
        const double z_m = p.z() - even.value()->At(p.x(), p.y()).z_m;
        lowest_m = std::min(lowest_m, z_m), top_m = std::max(top_m, z_m);
      }
    }
  }
  EXPECT_NEAR(lowest_m, 0.08, 0.003);
  EXPECT_NEAR(top_m, 0.08, 0.003);
  EXPECT_LT(count, before + 10'000);
  std::printf("%zu triangles with a measured surface, %zu without; it is drawn from %.4f to %.4f m\n", count, before,
              lowest_m, top_m);
}

// 5 000 km away the same file gives the same ground, as exactly: only where a height lies between two steps it may go
// to the other one.
TEST(Ground, LosesNothingFarAway) {
  const double far_m = 20'000.0 * kTile_m;
  const auto here = OpenDriveWorld(BendUnderBridge()), there = OpenDriveWorld(BendUnderBridge(far_m, -far_m));
  ASSERT_TRUE(here != nullptr && there != nullptr);
  const GroundPlan near_plan(*here), far_plan(*there);
  std::vector<GroundTile> far;
  for (const TileKey& key : far_plan.tiles()) {
    if (far_plan.PiecesIn(key) > 0) far.push_back(far_plan.Build(key));  // only roads are compared
  }
  const Correlation found = Correlate(*there, far, Points(), 3);
  EXPECT_EQ(found.asked, Points());
  EXPECT_LT(found.worst_m, 0.005);
  EXPECT_EQ(near_plan.tiles().size(), far_plan.tiles().size());
  for (const TileKey key : {TileKey{0, 0}, TileKey{0, -1}}) {
    const GroundTile a = near_plan.Build(key);
    const auto other = std::find_if(far.begin(), far.end(), [&](const GroundTile& tile) {
      return tile.key == TileKey{key.column + 20'000, key.row - 20'000};
    });
    const GroundTile b = other != far.end() ? *other : far_plan.Build({key.column + 20'000, key.row - 20'000});
    ASSERT_EQ(a.levels[0].ground.size(), b.levels[0].ground.size());
    for (std::size_t m = 0; m < a.levels[0].ground.size(); ++m) {
      const Mesh &p = a.levels[0].ground[m], &q = b.levels[0].ground[m];
      EXPECT_NEAR(static_cast<double>(p.positions.size()), static_cast<double>(q.positions.size()),
                  0.01 * static_cast<double>(p.positions.size()));
    }
  }
}

bool Same(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.colours == b.colours && a.triangles == b.triangles &&
         a.origin_W == b.origin_W;
}
void ExpectSame(const GroundLevel& a, const GroundLevel& b) {
  ASSERT_EQ(a.ground.size(), b.ground.size());
  ASSERT_EQ(a.things.size(), b.things.size());
  ASSERT_EQ(a.repeated.size(), b.repeated.size());
  for (std::size_t m = 0; m < a.ground.size(); ++m) EXPECT_TRUE(Same(a.ground[m], b.ground[m]));
  for (std::size_t m = 0; m < a.things.size(); ++m) EXPECT_TRUE(Same(a.things[m], b.things[m]));
  for (std::size_t m = 0; m < a.repeated.size(); ++m)
    EXPECT_TRUE(Same(a.repeated[m].model, b.repeated[m].model) &&
                a.repeated[m].places.size() == b.repeated[m].places.size());
  EXPECT_TRUE(Same(a.marks, b.marks));
}

TEST(Ground, TheSameBitsForAnyNumberOfThreads) {
  const auto world = OpenDriveWorld(BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const auto one = BuildAll(*world, 1), five = BuildAll(*world, 5);
  ASSERT_EQ(one.size(), five.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t level = 0; level < kGroundLevels; ++level) ExpectSame(one[i].levels[level], five[i].levels[level]);
  }
}

// On a crossing, about a bridge, and on bare land, with levels that are alike where it has every post.
TEST(Ground, ALevelAloneIsThatOfTheWholeTile) {
  const auto land = road::World::Parse(
      "rodeira: world/2\nname: land\nterrain:\n  generate: {seed: 4, columns: 49, rows: 61, spacing_m: 20, west_m: "
      "-300, south_m: -300, full_m: 60, flat_m: 10, relief: [{wavelength_m: 150, amplitude_m: 20}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -280, y_m: -200, heading_deg: 0}\n    axis: [line: {length_m: 120}]\n    "
      "z_m: 0\n    section: {template: rural, slopes: {reach_m: 40}}\n",
      "land.yaml");
  ASSERT_TRUE(land.ok()) << land.error().Text();
  const auto lights = road::World::Load(SourceDir() + "/configs/worlds/lights.yaml");
  ASSERT_TRUE(lights.ok()) << lights.error().Text();
  std::size_t alike = 0;
  for (const auto& world : {OpenDriveWorld(BendUnderBridge()), land.value(), lights.value()}) {
    const GroundPlan plan(*world);
    int without_lines = 0;
    for (const TileKey& key : plan.tiles()) {
      if (!IsLongForm() && plan.PiecesIn(key) == 0 && without_lines++ % 4 != 0) continue;
      const GroundTile whole = plan.Build(key);
      for (int level = kGroundLevels - 1; level >= 0; --level) {  // in another order than the tile has
        ExpectSame(plan.BuildLevel(key, level), whole.levels[static_cast<std::size_t>(level)]);
        alike += plan.FinestAlike(key, level) != level;
      }
    }
  }
  EXPECT_GT(alike, 0u);
}

}  // namespace
}  // namespace rodeira::scene
