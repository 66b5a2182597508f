// SPDX-License-Identifier: Apache-2.0
// The files of what is seen, found and shown: against the ground built in memory.
#include <osg/Geometry>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include "nodes/view/visual_database/find_built.hpp"
#include "tests/long_form.hpp"
#include "tests/nodes/view/database_fixture.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

TEST_F(Database, AModelFromAFileStandsAtItsPlace) {
  fs::create_directories(folder_);
  // A flat quadrangle of 4 x 2 m, 3 m up: its corner (x, y) = (4, 2) is where it is farthest.
  osg::ref_ptr<osg::Geometry> quad = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] :
       {std::pair(0.0F, 0.0F), std::pair(4.0F, 0.0F), std::pair(4.0F, 2.0F), std::pair(0.0F, 2.0F)})
    corners->push_back({x, y, 3.0F});
  quad->setVertexArray(corners);
  quad->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  const auto model = folder_ / "shelter.osgt";
  ASSERT_TRUE(osgDB::writeNodeFile(*quad, model.string()));
  const auto world = [&](const fs::path& file) {
    return road::World::Parse(fmt::format("rodeira: world/2\nname: plane\nground: {{kind: plane, z_m: 1}}\nroads:\n  - "
                                          "id: main\n    start: {{x_m: 10, y_m: 20, heading_deg: 90}}\n"
                                          "    axis: [{{line: {{length_m: 60}}}}]\n    z_m: 1\n    section: "
                                          "{{template: rural}}\n    objects: [{{type: house, s_m: 30, t_m: -15{}}}]\n",
                                          file.empty() ? "" : ", model: " + file.string()),
                              "plane.yaml");
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
  EXPECT_NE(report.error().Text().find("broken.osgt: OpenSceneGraph cannot read this model"), std::string::npos)
      << report.error().Text();
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
  EXPECT_TRUE(said.ends_with("broken.osgt: OpenSceneGraph cannot read this model; what it is of is drawn without it\n"))
      << said;
  EXPECT_EQ(said.find(": OpenSceneGraph"), said.rfind(": OpenSceneGraph"));
  const auto building = RenderStill(*without.value(), picture, 320, 180);
  const auto whole = RenderStill(*parsed.value(), picture, 320, 180);
  ASSERT_TRUE(building.ok() && whole.ok());
  EXPECT_EQ(seen.value().rgb, building.value().rgb);
  EXPECT_NE(whole.value().rgb, building.value().rgb);
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
    const auto surface = Surface::Open(SurfaceKind::kOffscreen, BriefOrLong(320, 640), BriefOrLong(180, 360), "test");
    const auto renderer = RendererOf(*surface.value(), *world, built, repeats);
    EXPECT_TRUE(renderer.ok()) << renderer.error().Text();
    for (const double s : {25.0, 70.0, 140.0}) {  // near the rail, before the signs; other tiles are near and far
      Picture picture;
      picture.show_instruments = false;
      picture.moment.cars.push_back(CarAt(road.Surface(s, -1.75).p_W, road.axis().Evaluate(s).heading_rad));
      renderer.value()->DrawWhole(picture);
      images.push_back(renderer.value()->Read());
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

// The eye goes away, by more than any fine level is seen from, and comes back: what it has left is no longer held, and
// what is shown is the same. So with a built database, and with ground that is made.
class Left : public Database, public testing::WithParamInterface<bool> {};

INSTANTIATE_TEST_SUITE_P(BuiltOrMade, Left, testing::Bool());

TEST_P(Left, WhatTheEyeHasLeftIsGivenBack) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = scene::OpenDriveWorld(BendWithThings());
  ASSERT_NE(world, nullptr);
  const std::size_t tiles = Write(*world, "world").tiles;
  const auto surface = Surface::Open(SurfaceKind::kOffscreen, 320, 180, "test");
  const auto renderer = RendererOf(*surface.value(), *world, GetParam() ? folder_ / "world" : fs::path());
  ASSERT_TRUE(renderer.ok());
  const network::Road& road = world->network()->roads()[0];
  Picture picture;
  picture.show_instruments = false;
  picture.camera = scene::CameraKind::kOrbit;
  picture.moment.cars.push_back(CarAt(road.Surface(70.0, -1.75).p_W, road.axis().Evaluate(70.0).heading_rad));
  const Eigen::Vector3d near = picture.moment.cars[0].p_WB_W;
  const auto held_at = [&](double away_m) {
    picture.moment.cars[0].p_WB_W = near + Eigen::Vector3d(-away_m, 0.0, 0.0);
    renderer.value()->DrawWhole(picture);
    renderer.value()->Draw(picture);
    return renderer.value()->HeldLevels();
  };
  const std::size_t first = held_at(0.0);
  const Image before = renderer.value()->Read();
  EXPECT_GT(first, tiles / 2);
  const std::size_t away = held_at(3'000.0), far = held_at(30'000.0);
  EXPECT_LT(away, first);
  EXPECT_LE(away, tiles) << "the coarsest level of each at most";
  EXPECT_EQ(far, 0u) << "beyond the farthest that is drawn";
  // Back and forth again and again, it never holds more than the first time.
  for (int i = 0; i < BriefOrLong(1, 10); ++i) {
    EXPECT_LE(held_at(0.0), first) << i;
    EXPECT_LE(held_at(3'000.0), away) << i;
  }
  EXPECT_LE(held_at(0.0), first);
  EXPECT_EQ(renderer.value()->Read().rgb, before.rgb);
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
  EXPECT_EQ(other.remark,
            (folder_ / "bend" / "visual.txt").string() +
                ": the built database is not shown: it was built from another world, or by another version of "
                "the program; `rodeira world build` renews it");
  std::ofstream(folder_ / "bend" / "tiles" / "0_0_1.osgb", std::ios::app) << "more";
  const FoundBuilt changed = FindBuilt(file, *world);
  EXPECT_TRUE(changed.folder.empty());
  EXPECT_NE(changed.remark.find("its file 'tiles/0_0_1.osgb' is not as it was written"), std::string::npos)
      << changed.remark;
}

}  // namespace
}  // namespace rodeira::nodes
