// SPDX-License-Identifier: Apache-2.0
// Where pictures lie on the ground: against x and y, and what of them the hashes know.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "common/core/base/files.hpp"
#include "common/view/scene/ground_materials/lay_picture.hpp"
#include "common/view/scene/visual_world/seen_digest.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

namespace fs = std::filesystem;

const fs::path kExample =
    fs::path(SourceDir()) / "configs/worlds/example";  // worn.png has 64 x 64 pixels, fields.png 256 x 208

// A road on a plane; its lanes may be of a material with a picture.
std::shared_ptr<const road::World> Plane(const std::string& ground, const std::string& lanes = "", double x_m = 0.0) {
  const auto world = road::World::Parse(
      fmt::format("rodeira: world/2\nname: pictures\nground: {{kind: plane, z_m: 1, surface: grass{}}}\nmaterials: "
                  "{{worn: {{surface: asphalt, texture: worn.png, texture_m: 3}}}}\nroads:\n"
                  "  - id: a\n    start: {{x_m: {}, y_m: 20, heading_deg: 0}}\n    axis: [line: {{length_m: 60}}]\n    "
                  "z_m: 1\n    section: {{template: rural{}}}\n",
                  ground, x_m, lanes),
      kExample / "made.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

const std::string kWorn = ", lanes: [{id: -1, width_m: 3.5, material: worn}, {id: 1, width_m: 3.5}]";

// All finest meshes with a picture.
std::vector<Mesh> Pictured(const road::World& world) {
  std::vector<Mesh> found;
  WorldScene scene = BuildWorldScene(world);
  for (GroundTile& tile : scene.ground) {
    for (Mesh& mesh : tile.levels[0].ground) {
      if (mesh.material == Material::kPicture) found.push_back(std::move(mesh));
    }
  }
  return found;
}

TEST(Pictures, ADrapedOneReachesFromEdgeToEdge) {
  const auto world =
      Plane(", texture: {file: fields.png, kind: draped, west_m: -100, south_m: -50, east_m: 300, north_m: 150}");
  ASSERT_NE(world, nullptr);
  const auto meshes = Pictured(*world);
  ASSERT_FALSE(meshes.empty());
  for (const Mesh& mesh : meshes) {
    EXPECT_FALSE(mesh.repeats);
    EXPECT_EQ(fs::path(mesh.face).filename(), "fields.png");
    ASSERT_EQ(mesh.on_face.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Eigen::Vector3d p = mesh.PositionW(i);
      EXPECT_NEAR(mesh.on_face[i].x(), (p.x() + 100.0) / 400.0, 1e-6);
      EXPECT_NEAR(mesh.on_face[i].y(), (p.y() + 50.0) / 200.0, 1e-6);
    }
  }
}

// A whole number of pictures between two places on it: they look the same.
void ExpectSame(const Eigen::Vector2f& found, const Eigen::Vector2d& expected) {
  const Eigen::Vector2d apart = found.cast<double>() - expected;
  EXPECT_NEAR(apart.x(), std::round(apart.x()), 1e-3);
  EXPECT_NEAR(apart.y(), std::round(apart.y()), 1e-3);
}

// A thousandth of a picture at 5 000 km from the origin, though float32 has no half metre there.
TEST(Pictures, ARepeatedOneIsWholePicturesAwayFarFromTheOrigin) {
  for (const double x : {0.0, 5e6}) {
    const auto world = Plane(", texture: {file: fields.png, repeat_m: 64}", "", x);
    ASSERT_NE(world, nullptr);
    const auto meshes = Pictured(*world);
    ASSERT_FALSE(meshes.empty());
    for (const Mesh& mesh : meshes) {
      EXPECT_TRUE(mesh.repeats);
      ASSERT_FALSE(mesh.positions.empty());
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        ExpectSame(mesh.on_face[i], mesh.PositionW(i).head<2>().cwiseQuotient(Eigen::Vector2d(64.0, 52.0)));
    }
  }
}

// Along a bend to the left of 60 m about (0, 80), from its foot at the origin's x: by the angle about its centre and
// the distance from it. The right lane is driven along s, the left one against it: its picture lies the other way
// round. Where traffic keeps left it is the right lane's that does.
TEST(Pictures, ALanesOwnGoesAlongItAsItIsDriven) {
  for (const bool left_hand : {false, true}) {
    for (const int id : {-1, 1}) {
      for (const double x : {0.0, 5e6}) {
        const auto world = road::World::Parse(
            fmt::format(
                "rodeira: world/2\nname: bend\nrule: {}\nground: {{kind: plane, z_m: 1, surface: grass}}\nmaterials: "
                "{{worn: {{surface: asphalt, texture: worn.png, texture_m: 3}}}}\nroads:\n"
                "  - id: a\n    start: {{x_m: {}, y_m: 20, heading_deg: 0}}\n    axis: [arc: {{length_m: 120, "
                "radius_m: 60}}]\n    z_m: 1\n"
                "    section: {{template: rural, lanes: [{{id: -1, width_m: 3.5{}}}, {{id: 1, width_m: 3.5{}}}]}}\n",
                left_hand ? "left" : "right", x, id < 0 ? ", material: worn" : "", id > 0 ? ", material: worn" : ""),
            kExample / "made.yaml");
        ASSERT_TRUE(world.ok()) << world.error().Text();
        const auto meshes = Pictured(*world.value());
        ASSERT_FALSE(meshes.empty());
        const double ahead = (id < 0) != left_hand ? 1.0 : -1.0;
        double least_s = 1e9, most_s = -1e9;
        for (const Mesh& mesh : meshes) {
          EXPECT_TRUE(mesh.repeats);
          EXPECT_EQ(fs::path(mesh.face).filename(), "worn.png");
          for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const Eigen::Vector2d from = mesh.PositionW(i).head<2>() - Eigen::Vector2d(x, 80.0);
            const double s = 60.0 * std::atan2(from.x(), -from.y()), t = 60.0 - from.norm();
            EXPECT_GE(t * id, -1e-3) << "right lane right of the middle, left lane left of it";
            EXPECT_LE(t * id, 3.5 + 1e-3);
            ExpectSame(mesh.on_face[i], ahead * Eigen::Vector2d(-t / 3.0, s / 3.0));
            least_s = std::min(least_s, s), most_s = std::max(most_s, s);
          }
        }
        EXPECT_NEAR(least_s, 0.0, 0.01);
        EXPECT_NEAR(most_s, 120.0, 0.01);
      }
    }
  }
}

// A road that climbs out of a circle over its own beginning, banked: the picture goes on along it where it lies over
// itself.
TEST(Pictures, WhereARoadPassesItselfEachPlaceIsItsOwn) {
  const auto world = road::World::Parse(
      "rodeira: world/2\nname: spiral\nground: {kind: plane, z_m: -30, surface: grass}\nmaterials: {worn: {surface: "
      "asphalt, texture: worn.png, texture_m: 3}}\nroads:\n"
      "  - id: a\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n    axis: [arc: {length_m: 460, radius_m: 60}]\n    "
      "vertical: [{s_m: 0, z_m: 0}, {s_m: 460, z_m: 23}]\n"
      "    section: {template: rural, lanes: [{id: -1, width_m: 3.5, material: worn}, {id: 1, width_m: 3.5}]}\n    "
      "bridges: [{from_s_m: 0, to_s_m: 460}]\n",
      kExample / "made.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  double most_s = 0.0;
  for (const Mesh& mesh : Pictured(*world.value())) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Eigen::Vector3d p = mesh.PositionW(i);
      const Eigen::Vector2d from = p.head<2>() - Eigen::Vector2d(0.0, 60.0);
      const double turn = 60.0 * 2.0 * std::acos(-1.0);
      double s = 60.0 * std::atan2(from.x(), -from.y());
      s += turn * std::round((20.0 * p.z() - s) / turn);  // which climbs by one in twenty
      ExpectSame(mesh.on_face[i], {(from.norm() - 60.0) / 3.0, s / 3.0});
      most_s = std::max(most_s, s);
    }
  }
  EXPECT_NEAR(most_s, 460.0, 0.05);
}

TEST(Pictures, AGeotypicalOneKeepsItsShape) {
  const auto world = Plane(", texture: {file: fields.png, repeat_m: 64}");
  ASSERT_NE(world, nullptr);
  ASSERT_NE(world->ground_picture(), nullptr);
  EXPECT_TRUE(world->ground_picture()->repeats);
  EXPECT_EQ(world->ground_picture()->width_m, 64.0);
  EXPECT_EQ(world->ground_picture()->height_m, 52.0);  // 256 x 208 pixels
}

TEST(Pictures, OverATerrainWithoutARectangleItCoversAllOfIt) {
  const auto world = road::World::Parse(
      "rodeira: world/1\nname: hills\nterrain:\n  texture: {file: fields.png, kind: draped}\n  generate: {seed: 1, "
      "columns: 21, rows: 11, spacing_m: 10, west_m: -50, south_m: 30, relief: []}\n",
      kExample / "made.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const terrain::LaidPicture& picture = *world.value()->ground_picture();
  EXPECT_EQ(picture.west_m, -50.0);
  EXPECT_EQ(picture.south_m, 30.0);
  EXPECT_EQ(picture.width_m, 200.0);
  EXPECT_EQ(picture.height_m, 100.0);
  const WorldScene scene = BuildWorldScene(*world.value());
  ASSERT_FALSE(scene.terrain.empty());
  for (const TerrainTile& tile : scene.terrain) {
    for (const Mesh& mesh : tile.levels) {
      ASSERT_EQ(mesh.material, Material::kPicture);
      ASSERT_FALSE(mesh.positions.empty());
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        EXPECT_NEAR(mesh.on_face[i].x(), (mesh.PositionW(i).x() + 50.0) / 200.0, 1e-6);
    }
  }
}

// Pictures change nothing that is driven on: the content hash does not know them. What is seen does, by their bytes,
// not by their paths.
TEST(Pictures, OnlyTheHashOfWhatIsSeenKnowsThem) {
  const auto bare = Plane(""), repeated = Plane(", texture: {file: fields.png, repeat_m: 64}"),
             wider = Plane(", texture: {file: fields.png, repeat_m: 65}"),
             other = Plane(", texture: {file: worn.png, repeat_m: 64}"), worn = Plane("", kWorn),
             left = Plane("", ", lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5, material: worn}]");
  for (const auto& world : {repeated, wider, other, worn, left}) EXPECT_EQ(world->content_hash(), bare->content_hash());
  std::set<base::Digest> seen;
  for (const auto& world : {bare, repeated, wider, other, worn, left}) seen.insert(SeenDigest(*world));
  EXPECT_EQ(seen.size(), 6u);
  const cli::TemporaryFolder folder;
  fs::copy_file(kExample / "fields.png", folder.path() / "fields.png");
  const auto moved =
      Plane(fmt::format(", texture: {{file: {}, repeat_m: 64}}", (folder.path() / "fields.png").string()));
  EXPECT_EQ(SeenDigest(*moved), SeenDigest(*repeated));
  std::ofstream(folder.path() / "fields.png", std::ios::app) << "more";
  EXPECT_NE(SeenDigest(*moved), SeenDigest(*repeated));
}

// Each surface has a look of its own where no picture lies.
TEST(Pictures, SurfacesWithoutOneLookDifferent) {
  const auto world = Plane("",
                           ", lanes: [{id: -1, width_m: 3.5, material: concrete}, {id: 1, width_m: 3.5}], shoulders: "
                           "{left: {width_m: 2, material: gravel}}");
  ASSERT_NE(world, nullptr);
  std::set<Material> materials;
  const WorldScene scene = BuildWorldScene(*world);
  for (const GroundTile& tile : scene.ground) {
    for (const Mesh& mesh : tile.levels[0].ground) materials.insert(mesh.material);
  }
  EXPECT_EQ(materials, (std::set{Material::kGround, Material::kRoad, Material::kConcrete, Material::kGravel}));
}

}  // namespace
}  // namespace rodeira::scene
