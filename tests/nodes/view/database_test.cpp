// SPDX-License-Identifier: Apache-2.0
// The files of what is seen: written, read by another program, and after changes.
#include <osg/Geometry>
#include <osg/Texture2D>
#include <osgDB/ReadFile>

#include "common/view/scene/visual_world/ground_tile.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/database_fixture.hpp"
#include "tests/setting.hpp"

namespace rodeira::nodes {
namespace {

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
      return fmt::format(
          "<road id=\"{}\" length=\"200\" junction=\"-1\"><planView><geometry s=\"0\" x=\"{}\" y=\"30\" hdg=\"0.2\" "
          "length=\"200\"><line/></geometry></planView>"
          "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\">"
          "<width sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road>\n",
          id, at);
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
  generate: {seed: 3, columns: 65, rows: 33, spacing_m: 25, west_m: -200, south_m: -400,
    relief: [{wavelength_m: 300, amplitude_m: 8}]}
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
  for (const char* change :
       {"cut: 1.5 -> cut: 4", "type: stop -> type: give_way", "every_m: 20 -> every_m: 25",
        "iso_8608: C -> iso_8608: E", "    signs: ->     bridges: [{from_s_m: 50, to_s_m: 90}]\n    signs:",
        "  - id: near -> \n  - id: near", "z_m: 4 -> z_m: 5"}) {
    const auto changed = world(change);
    const DatabaseReport again = Write(*changed, "world");
    EXPECT_LT(again.built, first.tiles) << change;
    const std::string fresh = fmt::format("fresh{}", number++);
    Write(*changed, fresh);
    EXPECT_TRUE(Files("world") == Files(fresh)) << change;
  }
}

TEST_F(Database, RoadsOfVersion1AreWritten) {
  const auto world = road::World::Load(SourceDir() + "/tests/data/straight.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const DatabaseReport report = Write(*world.value(), "straight");
  EXPECT_GE(report.tiles, 4u);
  EXPECT_EQ(report.built, report.tiles);
  EXPECT_EQ(Write(*world.value(), "straight").built, 0u);
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
      const auto* texture =
          state == nullptr
              ? nullptr
              : dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
      if (texture != nullptr && texture->getImage() != nullptr && texture->getImage()->t() == 128) ++pictures;
    }
  };
  for (std::size_t level = 0; level < scene::kGroundLevels; ++level) {
    std::size_t expected = tile.levels[level].marks.triangle_count();
    for (const scene::Mesh& mesh : tile.levels[level].ground) expected += mesh.triangle_count();
    for (const scene::Mesh& mesh : tile.levels[level].things) expected += mesh.triangle_count();
    EXPECT_EQ(tile.levels[level].repeated.empty(), level > 2) << "trees";
    for (const scene::Mesh& mesh : scene::Merged(tile.levels[level].repeated))
      expected += mesh.triangle_count();  // once, for whatever program reads it
    const osg::ref_ptr<osg::Node> node =
        osgDB::readNodeFile((folder_ / "world" / "tiles" / fmt::format("0_0_{}.osgb", level)).string());
    ASSERT_TRUE(node.valid());
    Count count;
    node->accept(count);
    EXPECT_EQ(count.triangles, expected);
    EXPECT_EQ(count.pictures, level < 2 ? 2u : 0u);  // a limit and a STOP sign
  }
  for (const osg::PagedLOD* lod : below.tiles)
    EXPECT_EQ(lod->getNumFileNames(), static_cast<unsigned>(scene::kGroundLevels));
}

// The smallest file of other programs, or as many as are asked for: every tile is written, read again by
// OpenSceneGraph, and ground.
TEST_F(Database, RealFilesAreWrittenAndReadAgain) {
  std::vector<fs::path> files;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(scene::SharedXodr("x").parent_path(), problem)) {
    if (entry.path().extension() == ".xodr") files.push_back(entry.path());
  }
  if (files.empty()) GTEST_SKIP() << "the files of other programs (../shared/data/road/xodr) are not here";
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(fs::file_size(a), a) < std::pair(fs::file_size(b), b);
  });
  files.resize(std::min<std::size_t>(files.size(), Setting("RODEIRA_BUILT_FILES", 1)));
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
      EXPECT_LT(reach.box.radius(), 2000.0)
          << entry.path();  // a square of 256 m, with what stands in it and reaches out of it
    }
    EXPECT_GT(ground, report.tiles) << name;
    EXPECT_EQ(Write(*world.value(), name).built, 0u) << name;
    fs::remove_all(folder_ / name);
  }
}

}  // namespace
}  // namespace rodeira::nodes
