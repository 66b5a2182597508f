// The files of what is seen: against the ground built in memory, against one another, and after changes.
#include "nodes/view/database.hpp"

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/PagedLOD>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "common/scene/ground_tile.hpp"
#include "nodes/view/find_built.hpp"
#include "nodes/view/tile_tree.hpp"
#include "tests/common/scene/ground_worlds.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/setting.hpp"
#include "tests/n222.hpp"
#include "tests/tree.hpp"

namespace rodeira::view {
namespace {

namespace fs = std::filesystem;

class Database : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("rodeira_database_{}", ::getpid());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  DatabaseReport Write(const road::World& world, const std::string& name, unsigned threads = 2) {
    DatabaseOptions options;
    options.folder = folder_ / name;
    options.threads = threads;
    const auto report = WriteDatabase(world, options);
    EXPECT_TRUE(report.ok()) << report.error().Text();
    return report.ok() ? report.value() : DatabaseReport{};
  }

  std::map<std::string, std::string> Files(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      if (!entry.is_regular_file()) continue;
      std::ostringstream bytes;
      bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files[fs::relative(entry.path(), folder_ / name).string()] = bytes.str();
    }
    return files;
  }

  fs::path folder_;
};

// What stands below groups.
struct TilesBelow : osg::NodeVisitor {
  std::vector<osg::PagedLOD*> tiles;
  std::size_t groups = 0, most_children = 0;

  explicit TilesBelow(osg::Node& root) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { root.accept(*this); }
  void apply(osg::PagedLOD& tile) override { tiles.push_back(&tile); }
  void apply(osg::Group& group) override {
    ++groups;
    most_children = std::max<std::size_t>(most_children, group.getNumChildren());
    traverse(group);
  }
};

// With signs, trees and a rail beside the bend.
std::string BendWithThings(double sign_s_m = 90.0) {
  std::string text = scene::BendUnderBridge();
  text.insert(text.find("</road>"), fmt::format(
      "<objects><object id=\"t\" type=\"tree\" s=\"0\" t=\"-9\" zOffset=\"0\" radius=\"2\" height=\"7\"><repeat s=\"0\" length=\"390\" distance=\"13\" tStart=\"-9\" tEnd=\"-12\"/></object>"
      "<object id=\"r\" type=\"barrier\" subtype=\"guardRail\" s=\"0\" t=\"6\" height=\"0.75\" width=\"0.3\"><repeat s=\"0\" length=\"400\" distance=\"0\" tStart=\"6\" tEnd=\"6\"/></object></objects>"
      "<signals><signal id=\"a\" s=\"{}\" t=\"-6\" zOffset=\"2\" orientation=\"+\" dynamic=\"no\" type=\"274\" subtype=\"-1\" country=\"DE\" value=\"60\" unit=\"km/h\"/>"
      "<signal id=\"b\" s=\"80\" t=\"6\" zOffset=\"2\" orientation=\"-\" dynamic=\"no\" type=\"206\" subtype=\"-1\" country=\"DE\"/></signals>", sign_s_m));
  return text;
}

TEST_F(Database, AMovedSignBuildsItsOwnTilesAlone) {
  const auto before = scene::OpenDriveWorld(BendWithThings(30.0)), after = scene::OpenDriveWorld(BendWithThings(31.0));
  ASSERT_TRUE(before != nullptr && after != nullptr);
  Write(*before, "world");
  EXPECT_EQ(Write(*before, "world").built, 0u);
  EXPECT_EQ(Write(*after, "world").built, 1u);  // both places lie in one tile
  Write(*after, "fresh");
  EXPECT_TRUE(Files("world") == Files("fresh"));
}

TEST_F(Database, TheSameBytesForAnyNumberOfThreads) {
  const auto world = scene::OpenDriveWorld(BendWithThings());
  ASSERT_NE(world, nullptr);
  const DatabaseReport report = Write(*world, "one", 1);
  EXPECT_EQ(report.built, report.tiles);
  Write(*world, "three", 3);
  const auto one = Files("one"), three = Files("three");
  EXPECT_EQ(one.size(), 4 * report.tiles + 2);
  EXPECT_TRUE(one == three);
}

TEST_F(Database, OnlyWhatChangedIsBuiltAgain) {
  // Two roads far from one another, of which the second is then moved by a metre.
  const auto text = [](double x) {
    const auto road = [](int id, double at) {
      return fmt::format("<road id=\"{}\" length=\"200\" junction=\"-1\"><planView><geometry s=\"0\" x=\"{}\" y=\"30\" hdg=\"0.2\" length=\"200\"><line/></geometry></planView>"
                         "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\">"
                         "<width sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road>\n", id, at);
    };
    return road(1, 10.0) + road(2, x);
  };
  const auto before = scene::OpenDriveWorld(text(4000.0)), after = scene::OpenDriveWorld(text(4001.0));
  ASSERT_TRUE(before != nullptr && after != nullptr);
  const DatabaseReport first = Write(*before, "world");
  EXPECT_EQ(Write(*before, "world").built, 0u);
  const DatabaseReport second = Write(*after, "world");
  EXPECT_GT(second.built, 0u);
  EXPECT_LT(second.built, first.tiles);
  Write(*after, "fresh");
  EXPECT_TRUE(Files("world") == Files("fresh"));
  // A file that is not what was written is written again.
  std::ofstream(folder_ / "world" / "tiles" / "0_0_0.osgb", std::ios::app) << "more";
  EXPECT_EQ(Write(*after, "world").built, 1u);
  EXPECT_TRUE(Files("world") == Files("fresh"));
}

TEST_F(Database, WhateverChangesInAWorldFileAnUpdateIsAFreshBuild) {
  const auto world = [](const std::string& change) {
    std::string text = R"(rodeira: world/2
name: two roads in hills
terrain:
  surface: grass
  generate: {seed: 3, columns: 65, rows: 33, spacing_m: 25, west_m: -200, south_m: -400, relief: [{wavelength_m: 300, amplitude_m: 8}]}
roads:
  - id: near
    start: {x_m: 0, y_m: 0, heading_deg: 0}
    axis: [line: {length_m: 200}]
    z_m: 4
    section: {template: rural, slopes: {cut: 1.5, fill: 2}}
    signs:
      - {type: stop, s_m: 190}
    objects:
      - {type: tree, side: left, beside_m: 9, from_s_m: 0, every_m: 20}
    surfaces:
      - {iso_8608: C, seed: 7, from_s_m: 10, to_s_m: 100}
  - id: far
    start: {x_m: 1000, y_m: 0, heading_deg: 0}
    axis: [line: {length_m: 200}]
    z_m: 4
    section: {template: rural}
)";
    const auto arrow = change.find(" -> ");
    if (arrow != std::string::npos) text.replace(text.find(change.substr(0, arrow)), arrow, change.substr(arrow + 4));
    const auto parsed = road::World::Parse(text, "two_roads.yaml");
    EXPECT_TRUE(parsed.ok()) << parsed.error().Text();
    return parsed.value();
  };
  const DatabaseReport first = Write(*world(""), "world");
  EXPECT_EQ(first.built, first.tiles);
  EXPECT_EQ(Write(*world(""), "world").built, 0u);
  int number = 0;
  for (const char* change : {"cut: 1.5 -> cut: 4", "type: stop -> type: give_way", "every_m: 20 -> every_m: 25", "iso_8608: C -> iso_8608: E", "    signs: ->     bridges: [{from_s_m: 50, to_s_m: 90}]\n    signs:",
                             "  - id: near -> \n  - id: near", "z_m: 4 -> z_m: 5"}) {
    const auto changed = world(change);
    const DatabaseReport again = Write(*changed, "world");
    if (!std::string_view(change).starts_with("z_m")) {  // generated hills follow the road's height
      EXPECT_LT(again.built, first.tiles) << change;
    }
    const std::string fresh = fmt::format("fresh{}", number++);
    Write(*changed, fresh);
    EXPECT_TRUE(Files("world") == Files(fresh)) << change;
  }
}

TEST_F(Database, AModelFromAFileStandsAtItsPlace) {
  fs::create_directories(folder_);
  // A flat quadrangle of 4 x 2 m, 3 m up: its corner (x, y) = (4, 2) is where it is farthest.
  osg::ref_ptr<osg::Geometry> quad = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair(0.0F, 0.0F), std::pair(4.0F, 0.0F), std::pair(4.0F, 2.0F), std::pair(0.0F, 2.0F)}) corners->push_back({x, y, 3.0F});
  quad->setVertexArray(corners);
  quad->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  const auto model = folder_ / "shelter.osgt";
  ASSERT_TRUE(osgDB::writeNodeFile(*quad, model.string()));
  const auto world = [&](const fs::path& file) {
    return road::World::Parse(fmt::format("rodeira: world/2\nname: plane\nground: {{kind: plane, z_m: 1}}\nroads:\n  - id: main\n    start: {{x_m: 10, y_m: 20, heading_deg: 90}}\n"
                                          "    axis: [{{line: {{length_m: 60}}}}]\n    z_m: 1\n    section: {{template: rural}}\n    objects: [{{type: house, s_m: 30, t_m: -15{}}}]\n", file.empty() ? "" : ", model: " + file.string()), "plane.yaml");
  };
  const auto parsed = world(model);
  ASSERT_TRUE(parsed.ok()) << parsed.error().Text();
  Write(*parsed.value(), "one", 1);
  Write(*parsed.value(), "two", 3);
  EXPECT_TRUE(Files("one") == Files("two"));
  struct Find : osg::NodeVisitor {
    osg::BoundingBoxd box;
    Find() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Geometry& geometry) override {
      const auto* points = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
      if (points == nullptr || points->size() != 4 || (*points)[2] != osg::Vec3(4.0F, 2.0F, 3.0F)) return;
      const osg::Matrixd place = osg::computeLocalToWorld(getNodePath());
      for (const osg::Vec3& point : *points) box.expandBy(osg::Vec3d(point) * place);
    }
  };
  Find find;
  const osg::ref_ptr<osg::Node> tile = osgDB::readRefNodeFile((folder_ / "one" / "tiles" / "0_0_0.osgb").string());
  ASSERT_TRUE(tile.valid());
  tile->accept(find);
  // The road goes north from (10, 20): s = 30, t = -15 is (25, 50); the model's x is north, its y west.
  EXPECT_NEAR(find.box.xMin(), 23.0, 1e-9);
  EXPECT_NEAR(find.box.xMax(), 25.0, 1e-9);
  EXPECT_NEAR(find.box.yMin(), 50.0, 1e-9);
  EXPECT_NEAR(find.box.yMax(), 54.0, 1e-9);
  EXPECT_NEAR(find.box.zMin(), parsed.value()->At(25.0, 50.0).z_m + 3.0, 1e-6);
  // A file that is none.
  std::ofstream(folder_ / "broken.osgt") << "no model";
  const auto broken = world(folder_ / "broken.osgt");
  ASSERT_TRUE(broken.ok()) << broken.error().Text();
  DatabaseOptions options;
  options.folder = folder_ / "none";
  const auto report = WriteDatabase(*broken.value(), options);
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.error().Text().find("broken.osgt: OpenSceneGraph cannot read this model"), std::string::npos) << report.error().Text();
  // To look at, there stands what would stand without it, and it is said once.
  RODEIRA_NEEDS_PICTURES();
  Picture picture;
  picture.moment.cars.push_back(CarAt({10.0, 30.0, 1.0}, 0.5 * 3.14159265358979));
  const auto without = world({});
  ASSERT_TRUE(without.ok()) << without.error().Text();
  testing::internal::CaptureStderr();
  const auto seen = RenderStill(*broken.value(), picture, 320, 180);
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_TRUE(seen.ok()) << seen.error().Text();
  EXPECT_TRUE(said.ends_with("broken.osgt: OpenSceneGraph cannot read this model; what it is of is drawn without it\n")) << said;
  EXPECT_EQ(said.find(": OpenSceneGraph"), said.rfind(": OpenSceneGraph"));
  const auto house = RenderStill(*without.value(), picture, 320, 180);
  const auto whole = RenderStill(*parsed.value(), picture, 320, 180);
  ASSERT_TRUE(house.ok() && whole.ok());
  EXPECT_EQ(seen.value().rgb, house.value().rgb);
  EXPECT_NE(whole.value().rgb, house.value().rgb);
}

// Hills without any road, and a plane: what is seen of them is written too, found, and shown as from memory.
TEST_F(Database, LandWithoutRoadsIsWrittenFoundAndShown) {
  const std::map<std::string, std::string> texts = {
      {"hills", "rodeira: world/1\nname: hills\nterrain:\n  surface: soil\n  generate: {seed: 3, columns: 150, rows: 100, spacing_m: 10, west_m: 1000, south_m: -500, relief: [{wavelength_m: 300, amplitude_m: 20}]}\n"
                "start: {x_m: 1500, y_m: 0, heading_deg: 30}\n"},
      {"plane", "rodeira: world/1\nname: plane\nground: {kind: plane, z_m: 1, slope_x: 0.01}\nstart: {x_m: 0, y_m: 0, heading_deg: 30}\n"}};
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
          area_m2 += 0.5 * ((p[1].x() - p[0].x()) * (p[2].y() - p[0].y()) - (p[1].y() - p[0].y()) * (p[2].x() - p[0].x()));
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
      picture.moment.cars.push_back(CarAt({start.x_m, start.y_m, world.At(start.x_m, start.y_m).z_m}, start.heading_rad));
      return RenderStill(world, picture, 320, 180, built);
    };
    const auto memory = draw({}), built = draw(folder_ / name);
    ASSERT_TRUE(memory.ok() && built.ok());
    EXPECT_TRUE(memory.value().rgb == built.value().rgb) << name;
  }
}

// A tile of bare hills has one file for the levels that are drawn alike, and neighbours of all kinds fit: every level is found where it is said.
TEST_F(Database, BareLandHasOneFileForLevelsThatAreAlike) {
  const auto parsed = road::World::Parse(
      "rodeira: world/2\nname: hills\nterrain:\n  generate: {seed: 4, columns: 101, rows: 101, spacing_m: 20, west_m: -500, south_m: -500, full_m: 60, flat_m: 10, relief: [{wavelength_m: 150, amplitude_m: 20}]}\n"
      "roads:\n  - id: a\n    start: {x_m: -280, y_m: -200, heading_deg: 0}\n    axis: [line: {length_m: 120}]\n    z_m: 0\n    section: {template: rural}\n", "hills.yaml");
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

// Squares of squares: no group has many children, all tiles are below it, and each group's ball holds them.
TEST_F(Database, TilesStandInATree) {
  std::vector<PlacedNode> parts;
  for (int column = 0; column < 60; ++column) {
    for (int row = 0; row < 50; ++row) {
      osg::ref_ptr<osg::PagedLOD> tile = new osg::PagedLOD;
      tile->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
      tile->setCenter(osg::Vec3d(256.0 * column, 256.0 * row, 5.0));
      tile->setRadius(350.0F);
      parts.push_back({{256.0 * column, 256.0 * row}, tile});
    }
  }
  const osg::ref_ptr<osg::Group> tree = TileTree(parts);
  const TilesBelow below(*tree);
  EXPECT_EQ(std::set<osg::PagedLOD*>(below.tiles.begin(), below.tiles.end()).size(), parts.size());
  EXPECT_LE(below.most_children, 4u);
  // What touches a ball of 600 m is found by a fraction of all groups and tiles: those whose own balls touch it.
  struct Touch : osg::NodeVisitor {
    osg::BoundingSphere about{osg::Vec3(5'000.0F, 7'000.0F, 0.0F), 600.0F};
    std::size_t looked = 0, tiles = 0;
    Touch() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override {
      ++looked;
      if (!node.getBound().intersects(about)) return;
      tiles += dynamic_cast<osg::PagedLOD*>(&node) != nullptr;
      traverse(node);
    }
  } touch;
  tree->accept(touch);
  std::size_t expected = 0;
  for (const PlacedNode& part : parts) expected += (part.at_W - Eigen::Vector2d(5'000.0, 7'000.0)).norm() < 949.9;
  EXPECT_NEAR(static_cast<double>(touch.tiles), static_cast<double>(expected), 2.0);
  EXPECT_GT(touch.tiles, 20u);
  EXPECT_LT(touch.looked, 300u) << "of " << parts.size() << " tiles";
  EXPECT_EQ(TileTree({})->getNumChildren(), 0u);
  const std::vector<PlacedNode> same(9, {{3.0, 4.0}, new osg::Group});
  EXPECT_EQ(TileTree(same)->getNumChildren(), 9u) << "what stands in one place";
}

TEST_F(Database, RoadsOfVersion1AreRefused) {
  DatabaseOptions options;
  options.folder = folder_ / "n222";
  const auto report = WriteDatabase(*N222OfVersion1(), options);
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.error().Text().find("only an OpenDRIVE world, the roads of a world file of version 2"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "n222"));
}

TEST_F(Database, OpenSceneGraphReadsIt) {
  const auto world = scene::OpenDriveWorld(BendWithThings());
  ASSERT_NE(world, nullptr);
  const DatabaseReport report = Write(*world, "world");
  const osg::ref_ptr<osg::Node> root = osgDB::readNodeFile((folder_ / "world" / "world.osgb").string());
  ASSERT_TRUE(root.valid());
  const TilesBelow below(*root);
  ASSERT_EQ(below.tiles.size(), report.tiles);
  const scene::GroundPlan plan(*world);
  const scene::GroundTile tile = plan.Build({0, 0});
  struct Count : osg::NodeVisitor {
    std::size_t triangles = 0, pictures = 0;
    Count() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Geometry& geometry) override {
      triangles += geometry.getPrimitiveSet(0)->getNumIndices() / 3;
      const osg::StateSet* state = geometry.getStateSet();
      const auto* texture = state == nullptr ? nullptr : dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
      if (texture != nullptr && texture->getImage() != nullptr && texture->getImage()->t() == 128) ++pictures;
    }
  };
  for (std::size_t level = 0; level < scene::kGroundLevels; ++level) {
    std::size_t expected = tile.levels[level].marks.triangle_count();
    for (const scene::Mesh& mesh : tile.levels[level].ground) expected += mesh.triangle_count();
    for (const scene::Mesh& mesh : tile.levels[level].things) expected += mesh.triangle_count();
    EXPECT_EQ(tile.levels[level].repeated.empty(), level > 2) << "trees";
    for (const scene::Mesh& mesh : scene::Merged(tile.levels[level].repeated)) expected += mesh.triangle_count();  // once, for whatever program reads it
    const osg::ref_ptr<osg::Node> node = osgDB::readNodeFile((folder_ / "world" / "tiles" / fmt::format("0_0_{}.osgb", level)).string());
    ASSERT_TRUE(node.valid());
    Count count;
    node->accept(count);
    EXPECT_EQ(count.triangles, expected);
    EXPECT_EQ(count.pictures, level < 2 ? 2u : 0u);  // a limit and a STOP sign
  }
  for (const osg::PagedLOD* lod : below.tiles) EXPECT_EQ(lod->getNumFileNames(), static_cast<unsigned>(scene::kGroundLevels));
}

// The smallest files of other programs, or as many as are asked for: every tile is written, read again by OpenSceneGraph, and ground.
TEST_F(Database, RealFilesAreWrittenAndReadAgain) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(scene::SharedXodr("x").parent_path(), problem)) {
    if (entry.path().extension() == ".xodr") files.push_back(entry.path());
  }
  if (files.empty()) GTEST_SKIP() << "the files of other programs (../shared/data/road/xodr) are not here";
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return std::pair(fs::file_size(a), a) < std::pair(fs::file_size(b), b); });
  files.resize(std::min<std::size_t>(files.size(), Setting("RODEIRA_BUILT_FILES", 2)));
  struct Reach : osg::NodeVisitor {
    osg::BoundingBox box;
    Reach() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Geometry& geometry) override { box.expandBy(geometry.getBoundingBox()); }
  };
  for (const fs::path& file : files) {
    const auto world = road::World::Load(file);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const std::string name = file.stem().string();
    const DatabaseReport report = Write(*world.value(), name);
    EXPECT_GT(report.tiles, 0u) << name;
    EXPECT_EQ(report.built, report.tiles) << name;
    std::size_t ground = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / name / "tiles")) {
      const osg::ref_ptr<osg::Node> node = osgDB::readNodeFile(entry.path().string());
      ASSERT_TRUE(node.valid()) << entry.path();
      Reach reach;
      node->accept(reach);
      if (!reach.box.valid()) continue;
      ++ground;
      EXPECT_LT(reach.box.radius(), 2000.0) << entry.path();  // a square of 256 m, with what stands in it and reaches out of it
    }
    EXPECT_GT(ground, report.tiles) << name;
    EXPECT_EQ(Write(*world.value(), name).built, 0u) << name;
    fs::remove_all(folder_ / name);
  }
}

// The pager, the files and the look that is put on them against the ground that is built in memory: pixel by pixel.
TEST_F(Database, TheViewShowsWhatItWouldShowFromMemory) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = scene::OpenDriveWorld(BendWithThings());
  ASSERT_NE(world, nullptr);
  Write(*world, "world");
  const network::Road& road = world->network()->roads()[0];
  const auto draw = [&](const fs::path& built, bool repeats = true) {
    std::vector<Image> images;
    const auto surface = Surface::Open(SurfaceKind::kOffscreen, 640, 360, "test");
    const auto painter = PainterOf(*surface.value(), *world, built, repeats);
    EXPECT_TRUE(painter.ok()) << painter.error().Text();
    for (const double s : {25.0, 70.0, 300.0}) {  // near the rail, before the signs; other tiles are near and far
      Picture picture;
      picture.show_instruments = false;
      picture.moment.cars.push_back(CarAt(road.Surface(s, -1.75).p_W, road.axis().Evaluate(s).heading_rad));
      painter.value()->DrawWhole(picture);
      images.push_back(painter.value()->Read());
    }
    return images;
  };
  for (const bool repeats : {true, false}) {  // trees as one model at many places, and merged
    const std::vector<Image> memory = draw({}, repeats), built = draw(folder_ / "world", repeats);
    for (std::size_t k = 0; k < memory.size(); ++k) {
      std::size_t other = 0;
      for (std::size_t i = 0; i < memory[k].rgb.size(); ++i) other += memory[k].rgb[i] != built[k].rgb[i];
      EXPECT_EQ(other, 0u) << "picture " << k;
    }
    EXPECT_NE(memory[0].rgb, memory[2].rgb);
  }
}

// The eye goes away, by more than any fine level is seen from, and comes back: what it has left is no longer held, and what is shown is the same.
TEST_F(Database, WhatTheEyeHasLeftIsGivenBack) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = scene::OpenDriveWorld(BendWithThings());
  ASSERT_NE(world, nullptr);
  const std::size_t tiles = Write(*world, "world").tiles;
  const auto surface = Surface::Open(SurfaceKind::kOffscreen, 320, 180, "test");
  const auto painter = PainterOf(*surface.value(), *world, folder_ / "world");
  ASSERT_TRUE(painter.ok());
  const network::Road& road = world->network()->roads()[0];
  Picture picture;
  picture.show_instruments = false;
  picture.camera = scene::CameraKind::kOrbit;
  picture.moment.cars.push_back(CarAt(road.Surface(70.0, -1.75).p_W, road.axis().Evaluate(70.0).heading_rad));
  const Eigen::Vector3d near = picture.moment.cars[0].p_WB_W;
  const auto held_at = [&](double away_m) {
    picture.moment.cars[0].p_WB_W = near + Eigen::Vector3d(-away_m, 0.0, 0.0);
    painter.value()->DrawWhole(picture);
    painter.value()->Draw(picture);
    return painter.value()->HeldLevels();
  };
  const std::size_t first = held_at(0.0);
  const Image before = painter.value()->Read();
  EXPECT_GT(first, tiles / 2);
  const std::size_t away = held_at(3'000.0), far = held_at(30'000.0);
  EXPECT_LT(away, first);
  EXPECT_LE(away, tiles) << "the coarsest level of each at most";
  EXPECT_EQ(far, 0u) << "beyond the farthest that is drawn";
  // Back and forth ten times, it never holds more than the first time.
  for (int i = 0; i < 10; ++i) {
    EXPECT_LE(held_at(0.0), first) << i;
    EXPECT_LE(held_at(3'000.0), away) << i;
  }
  held_at(0.0);
  EXPECT_EQ(painter.value()->Read().rgb, before.rgb);
}

TEST_F(Database, OnlyThatOfTheWorldAsItIsIsFound) {
  const auto world = scene::OpenDriveWorld(BendWithThings(30.0)), moved = scene::OpenDriveWorld(BendWithThings(31.0));
  ASSERT_TRUE(world != nullptr && moved != nullptr);
  const auto file = folder_ / "bend.xodr";
  EXPECT_TRUE(FindBuilt(file, *world).folder.empty());
  EXPECT_EQ(FindBuilt(file, *world).remark, "");
  EXPECT_TRUE(FindBuilt("", *world).folder.empty());
  Write(*world, "bend");  // named as the file is
  EXPECT_EQ(FindBuilt(file, *world).folder, folder_ / "bend");
  EXPECT_EQ(FindBuilt(file, *world).remark, "");
  EXPECT_EQ(FindBuilt(folder_ / "bend" / "world.xodr", *world).folder, folder_ / "bend");  // in one folder with it
  const FoundBuilt other = FindBuilt(file, *moved);
  EXPECT_TRUE(other.folder.empty());
  EXPECT_EQ(other.remark, (folder_ / "bend" / "visual.txt").string() + ": the built database is not shown: it was built from another world, or by another version of "
                                                                       "the program; `rodeira world build` renews it");
  std::ofstream(folder_ / "bend" / "tiles" / "0_0_1.osgb", std::ios::app) << "more";
  const FoundBuilt changed = FindBuilt(file, *world);
  EXPECT_TRUE(changed.folder.empty());
  EXPECT_NE(changed.remark.find("its file 'tiles/0_0_1.osgb' is not as it was written"), std::string::npos) << changed.remark;
}

}  // namespace
}  // namespace rodeira::view
