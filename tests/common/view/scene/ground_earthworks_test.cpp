// SPDX-License-Identifier: Apache-2.0
// Verges, cuts, fills and blends as they are drawn, against SUELO.
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

// A road of 12 and 15 m radius through a hill and over a hollow: its verges, and its cuts and fills with the land
// around them.
TEST(Ground, VergesAndSlopesOfSmallRadiiAreWhereTheTyresAre) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: hairpin\nterrain:\n  generate: {seed: 5, columns: 41, rows: 41, spacing_m: 8, west_m: "
      "-100, south_m: -130, full_m: 30, flat_m: 5, relief: [{wavelength_m: 90, amplitude_m: 6}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -60, y_m: 0, heading_deg: 0}\n    axis: [line: {length_m: 60}, arc: "
      "{turn_deg: 150, radius_m: 12}, line: {length_m: 20}, arc: {turn_deg: 120, radius_m: -15}, line: {length_m: "
      "30}]\n"
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 70, z_m: 3, parabola_m: 60}, {s_m: 140, z_m: 4}]\n    section: "
      "{template: rural, verge: {width_m: 1.5}}\n",
      "hairpin.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  const road::World& world = *parsed.value();
  const std::vector<GroundTile> tiles = BuildAll(world);
  const auto beside = [&](const Mesh& mesh, std::size_t triangle, bool verge) {
    const auto corners = CornersOf(mesh, triangle);
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const auto place = world.network()->Locate(middle.x(), middle.y());
    return !IsRoad(mesh) && world.At(middle.x(), middle.y()).inside && (place && place->distance_m == 0.0) == verge;
  };
  for (const bool verge : {true, false}) {
    const Correlation found = Correlate(
        world, tiles, Points(), 3, [&](const Mesh& mesh, std::size_t i) { return beside(mesh, i, verge); }, kFinest,
        everywhere);
    EXPECT_EQ(found.asked, Points());
    EXPECT_LT(found.stepped, 0.001 * found.asked);
    EXPECT_EQ(found.far, 0) << "worst " << found.worst_m << " m at " << found.where.transpose();
    std::printf("%s: %d points, worst %.4f m from SUELO\n", verge ? "verges" : "slopes and land", found.asked,
                found.worst_m);
  }
}

// A road of version 1 and its blend into the land, on a plane and in hills.
TEST(Ground, ABlendIsWhereTheTyresAre) {
  const auto hills = road::World::Parse(
      "rodeira: world/1\nname: blend\nterrain:\n  generate: {seed: 5, columns: 41, rows: 41, spacing_m: 8, west_m: "
      "-100, south_m: -130, full_m: 30, flat_m: 5, relief: [{wavelength_m: 90, amplitude_m: 6}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -60, y_m: 0}\n    axis: [line: {length_m: 60}, arc: {length_m: 60, "
      "radius_m: 25}, line: {length_m: 30}]\n    vertical: [{s_m: 0, z_m: 0}, {s_m: 70, z_m: 3, parabola_m: 60}, "
      "{s_m: 140, z_m: 4}]\n    section: {lanes: [{id: -1, width_m: 3, speed_limit_kmh: 50}], verge: {width_m: 1.5}, "
      "blend_m: 8}\n",
      "blend.yaml");
  ASSERT_TRUE(hills.ok()) << hills.error().Text();
  for (const auto& world : {PlaneWithRoad(), hills.value()}) {
    const std::vector<GroundTile> tiles = BuildAll(*world);
    for (const bool blend : {false, true}) {
      const auto counts = [&](const Mesh& mesh, std::size_t i) {
        const auto corners = CornersOf(mesh, i);
        const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const auto place = world->network()->Locate(middle.x(), middle.y());
        return world->At(middle.x(), middle.y()).inside &&
               (!blend || (place && place->distance_m > 0.0 && place->distance_m < 8.0));
      };
      const Correlation found = Correlate(*world, tiles, Points(), 3, counts, kFinest, everywhere);
      EXPECT_EQ(found.asked, Points());
      EXPECT_EQ(found.far, 0) << world->name() << ": worst " << found.worst_m << " m at " << found.where.transpose();
      std::printf("%s, %s: %d points, worst %.4f m from SUELO\n", world->name().c_str(), blend ? "blend" : "all",
                  found.asked, found.worst_m);
    }
  }
}

// Up to 2 m beside the outermost lanes, where cuts and fills are steepest and narrowest, also where the terrain is a
// plane: points of the whole land hardly meet these strips.
TEST(Ground, CutsAndFillsBesideVergesAreWhereTheTyresAre) {
  constexpr double kBeside_m = 2.0;
  const std::uint64_t at_most = Setting("RODEIRA_GROUND_TILES", 10) / 4;
  const std::string raised =
      "rodeira: world/2\nname: raised\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: "
      "-200, y_m: 30, heading_deg: 10}\n"
      "    axis: [line: {length_m: 200}, arc: {length_m: 150, radius_m: 120}]\n    vertical: [{s_m: 0, z_m: 0.4}, "
      "{s_m: 150, z_m: -1.5, parabola_m: 80}, {s_m: 350, z_m: 2}]\n    section: {template: rural}\n";
  for (const std::string name : {"raised", "ring", "lights", "flat", "n222", "motorway"}) {
    const auto loaded =
        name == "raised" ? road::World::Parse(raised, "raised.yaml")
                         : road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / (name + ".yaml"));
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    const std::shared_ptr<const road::World> seen = loaded.value()->AsSeen();
    const GroundPlan plan(*loaded.value());
    std::set<TileKey> keys;
    const auto roads = seen->network()->roads();
    for (std::uint64_t n = 0; keys.size() < at_most && n < 100 * at_most; ++n) {
      const network::Road& road = roads[base::RandomBits({n, 43}) % roads.size()];
      const WorldStep at = ToSteps(road.Surface(base::RandomUniform({n, 47}, 0.0, road.length_m()), 0.0).p_W.head<2>());
      keys.insert({TileOf(at.x), TileOf(at.y)});
    }
    const std::vector<TileKey> drawn(keys.begin(), keys.end());
    std::vector<GroundTile> tiles(drawn.size());
    ForEachAtOnce(tiles.size(), 0, [&](std::size_t i) { tiles[i] = plan.Build(drawn[i]); });
    const auto is_near = [&](const Mesh& mesh, std::size_t i) {
      const auto corners = CornersOf(mesh, i);
      const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      double size_m = 0.0;
      for (const Eigen::Vector3d& corner : corners) size_m = std::max(size_m, (corner - middle).norm());
      const auto place = seen->network()->Locate(middle.x(), middle.y());
      return place && place->distance_m < kBeside_m + size_m && place->distance_m + size_m > 0.0;
    };
    const auto is_beside = [&](const Eigen::Vector3d& p) {
      const auto place = seen->network()->Locate(p.x(), p.y(), p.z());
      return place && place->distance_m > 0.0 && place->distance_m < kBeside_m;
    };
    const Correlation found = Correlate(*seen, tiles, Points(), 53, is_near, kFinest, is_beside);
    EXPECT_EQ(found.asked, Points()) << name;
    // Where cuts of a centimetre begin beside a verge they are strips narrower than the 2 cm at which the ground is
    // asked from either end of a side.
    EXPECT_LE(found.far, 5e-5 * found.asked)
        << name << ": worst " << found.worst_m << " m at " << found.where.transpose();
    EXPECT_LT(found.worst_m, 0.01) << name << " at " << found.where.transpose();
    EXPECT_LT(found.stepped, 0.002 * found.asked) << name;
    const Correlation farther = Correlate(*seen, tiles, Points(), 53, is_near, Tolerances{}, is_beside);
    EXPECT_LE(farther.far, 2e-5 * farther.asked)
        << name << ": worst " << farther.worst_m << " m at " << farther.where.transpose();
    std::printf(
        "%s: %d points up to 2 m beside the outermost lanes on %zu tiles, %d at steps, %d more than 3 mm from SUELO, "
        "worst %.4f m, %d more than 5 mm\n",
        name.c_str(), found.asked, tiles.size(), found.stepped, found.far, found.worst_m, farther.far);
  }
}

}  // namespace
}  // namespace rodeira::scene
