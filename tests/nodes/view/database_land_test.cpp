// SPDX-License-Identifier: Apache-2.0
// The files of land: without any road, and where it lies bare beside some.
#include <osg/Geometry>
#include <osgDB/ReadFile>

#include <array>
#include <cmath>

#include "common/view/scene/visual_world/ground_tile.hpp"
#include "nodes/view/visual_database/find_built.hpp"
#include "tests/nodes/view/database_fixture.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

// Hills without any road, and a plane: what is seen of them is written too, found, and shown as from memory.
TEST_F(Database, LandWithoutRoadsIsWrittenFoundAndShown) {
  const std::map<std::string, std::string> texts = {
      {"hills",
       "rodeira: world/1\nname: hills\nterrain:\n  surface: soil\n  generate: {seed: 3, columns: 150, rows: 100, "
       "spacing_m: 10, west_m: 1000, south_m: -500, relief: [{wavelength_m: 300, amplitude_m: 20}]}\n"
       "start: {x_m: 1500, y_m: 0, heading_deg: 30}\n"},
      {"plane",
       "rodeira: world/1\nname: plane\nground: {kind: plane, z_m: 1, slope_x: 0.01}\nstart: {x_m: 0, y_m: 0, "
       "heading_deg: 30}\n"}};
  for (const auto& [name, text] : texts) {
    const auto parsed = road::World::Parse(text, name + ".yaml");
    ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
    const road::World& world = *parsed.value();
    const DatabaseReport report = Write(world, name, 1);
    EXPECT_EQ(report.built, report.tiles);
    EXPECT_GT(report.tiles, 12u);
    EXPECT_EQ(Write(world, name).built, 0u);
    Write(world, name + "3", 3);
    EXPECT_TRUE(Files(name) == Files(name + "3"));
    EXPECT_EQ(Files(name).size(), 3 * report.tiles + 2);
    // The terrain's own triangles: the finest level, whole, to half a step of a float.
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile((folder_ / name / "world.osgb").string());
    ASSERT_TRUE(root.valid());
    const TilesBelow below(*root);
    EXPECT_EQ(below.tiles.size(), report.tiles);
    struct Meet : osg::NodeVisitor {
      const road::World& world;
      std::size_t corners = 0;
      double worst_m = 0.0, area_m2 = 0.0;
      explicit Meet(const road::World& with) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), world(with) {}
      void apply(osg::Geometry& geometry) override {
        const osg::Matrixd place = osg::computeLocalToWorld(getNodePath());
        const auto& points = dynamic_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
        const osg::PrimitiveSet& indices = *geometry.getPrimitiveSet(0);
        for (unsigned i = 0; i + 2 < indices.getNumIndices(); i += 3) {
          std::array<osg::Vec3d, 3> p;
          for (unsigned k = 0; k < 3; ++k) p[k] = osg::Vec3d(points[indices.index(i + k)]) * place;
          const osg::Vec3d middle = (p[0] + p[1] + p[2]) / 3.0;
          worst_m = std::max(worst_m, std::fabs(world.At(middle.x(), middle.y()).z_m - middle.z()));
          area_m2 +=
              0.5 * ((p[1].x() - p[0].x()) * (p[2].y() - p[0].y()) - (p[1].y() - p[0].y()) * (p[2].x() - p[0].x()));
          ++corners;
        }
      }
    } meet(world);
    for (const auto& entry : fs::directory_iterator(folder_ / name / "tiles")) {
      if (entry.path().string().ends_with("_0.osgb")) osgDB::readRefNodeFile(entry.path().string())->accept(meet);
    }
    EXPECT_GT(meet.corners, 1000u);
    EXPECT_LT(meet.worst_m, 1e-3);
    if (name == "hills") {
      EXPECT_NEAR(meet.area_m2, 1490.0 * 990.0, 1.0);
    }
    EXPECT_EQ(FindBuilt(folder_ / (name + ".yaml"), world).folder, folder_ / name);
    std::string text_of_another = text;
    const std::size_t number = text_of_another.find(name == "hills" ? "seed: 3" : "z_m: 1");
    text_of_another[text_of_another.find_first_of("31", number)] = '2';
    const auto another = road::World::Parse(text_of_another, name + ".yaml");
    ASSERT_TRUE(another.ok()) << another.error().Text();
    EXPECT_TRUE(FindBuilt(folder_ / (name + ".yaml"), *another.value()).folder.empty());
    if (!WhyNoPictures().empty()) continue;
    const auto draw = [&](const fs::path& built) {
      Picture picture;
      picture.show_instruments = false;
      const road::StartPose& start = world.start();
      picture.moment.cars.push_back(
          CarAt({start.x_m, start.y_m, world.At(start.x_m, start.y_m).z_m}, start.heading_rad));
      return RenderStill(world, picture, 320, 180, built);
    };
    const auto memory = draw({}), built = draw(folder_ / name);
    ASSERT_TRUE(memory.ok() && built.ok());
    EXPECT_TRUE(memory.value().rgb == built.value().rgb) << name;
  }
}

// A tile of bare hills has one file for the levels that are drawn alike, and neighbours of all kinds fit: every level
// is found where it is said.
TEST_F(Database, BareLandHasOneFileForLevelsThatAreAlike) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: hills\nterrain:\n  generate: {seed: 4, columns: 101, rows: 101, spacing_m: 20, west_m: "
      "-500, south_m: -500, full_m: 60, flat_m: 10, relief: [{wavelength_m: 150, amplitude_m: 20}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -280, y_m: -200, heading_deg: 0}\n    axis: [line: {length_m: 120}]\n    "
      "z_m: 0\n    section: {template: rural}\n",
      "hills.yaml");
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  const DatabaseReport report = Write(*parsed.value(), "one", 1);
  Write(*parsed.value(), "three", 3);
  EXPECT_TRUE(Files("one") == Files("three"));
  EXPECT_EQ(Write(*parsed.value(), "one").built, 0u);
  const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile((folder_ / "one" / "world.osgb").string());
  ASSERT_TRUE(root.valid());
  const TilesBelow below(*root);
  ASSERT_EQ(below.tiles.size(), report.tiles);
  std::size_t files = 0, few = 0;
  for (const osg::PagedLOD* lod : below.tiles) {
    float to_m = 0.0F;
    for (unsigned child = lod->getNumFileNames(); child-- > 0;) {  // the finest is the last
      EXPECT_EQ(lod->getMinRange(child), to_m);
      to_m = lod->getMaxRange(child);
      EXPECT_TRUE(fs::exists(folder_ / "one" / lod->getFileName(child))) << lod->getFileName(child);
    }
    EXPECT_EQ(to_m, scene::kGroundSeen_m.back());
    files += lod->getNumFileNames();
    few += lod->getNumFileNames() == 2;
  }
  EXPECT_EQ(Files("one").size(), files + 2);
  EXPECT_GT(few, report.tiles / 3) << "with posts every 20 m the three finest levels are the terrain itself";
  // The road's own tile has all of them, and so has the terrain's end.
  for (int level = 0; level < scene::kGroundLevels; ++level) {
    EXPECT_TRUE(fs::exists(folder_ / "one" / fmt::format("tiles/-1_-1_{}.osgb", level)));
    EXPECT_TRUE(fs::exists(folder_ / "one" / fmt::format("tiles/5_5_{}.osgb", level)));
  }
}

}  // namespace
}  // namespace rodeira::nodes
