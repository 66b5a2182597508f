// SPDX-License-Identifier: Apache-2.0
// Ground that is made where the eye comes near: what is seen of it is what would be seen of a world that was built
// before.
#include <chrono>
#include <thread>

#include "common/view/scene/visual_world/world_scene.hpp"
#include "tests/long_form.hpp"
#include "tests/nodes/view/database_fixture.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

using namespace std::chrono_literals;

class MadeWorld : public testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    world_ = scene::OpenDriveWorld(BendWithThings());
    ASSERT_NE(world_, nullptr);
  }
  std::unique_ptr<Surface> Open(Quality quality) const {
    return Surface::Open(SurfaceKind::kOffscreen, 480, 270, "test", false, 0, quality).value();
  }
  Picture On(double s_m, scene::CameraKind camera) const {
    const network::Road& road = world_->network()->roads()[0];
    Picture picture;
    picture.camera = camera;
    picture.show_instruments = false;
    picture.moment.cars.push_back(CarAt(road.Surface(s_m, -1.75).p_W, road.axis().Evaluate(s_m).heading_rad));
    return picture;
  }
  std::vector<Picture> Tour() const {
    std::vector<Picture> tour;
    for (const double s_m : BriefOrLong<std::vector<double>>({25.0, 140.0}, {25.0, 140.0, 70.0})) {
      for (const auto camera : {scene::CameraKind::kChase, scene::CameraKind::kDriver, scene::CameraKind::kTop})
        tour.push_back(On(s_m, camera));
    }
    return tour;
  }

  std::shared_ptr<const road::World> world_;
};

// The oracle builds everything before the first picture, and has no pager.
TEST_F(MadeWorld, IsSeenAsTheWholeScene) {
  const scene::WorldScene scene = scene::BuildWorldScene(*world_);
  for (const Quality quality :
       BriefOrLong<std::vector<Quality>>({Quality::kMedium}, {Quality::kLow, Quality::kMedium})) {
    std::vector<Image> whole;
    {
      const auto surface = Open(quality);
      Renderer renderer(*surface, *world_, scene);
      for (const Picture& picture : Tour()) renderer.DrawWhole(picture), whole.push_back(renderer.Read());
      EXPECT_EQ(renderer.HeldLevels(), 0u);
    }
    const auto surface = Open(quality);
    const auto renderer = RendererOf(*surface, *world_, {});
    ASSERT_TRUE(renderer.ok());
    const std::vector<Picture> tour = Tour();
    for (std::size_t i = 0; i < tour.size(); ++i) {
      renderer.value()->DrawWhole(tour[i]);
      EXPECT_EQ(renderer.value()->Read().rgb, whole[i].rgb) << "picture " << i;
    }
    EXPECT_GT(renderer.value()->HeldLevels(), 0u);
    EXPECT_NE(whole[0].rgb, whole[3].rgb);
  }
}

// A film's picture is the same whatever was asked for before, and however far that has come.
TEST_F(MadeWorld, WhenATileCameIsNotSeen) {
  const Picture last = On(70.0, scene::CameraKind::kChase);
  const auto film = [&](const std::vector<Picture>& before) {
    const auto surface = Open(Quality::kMedium);
    const auto renderer = RendererOf(*surface, *world_, {});
    EXPECT_TRUE(renderer.ok());
    for (const Picture& picture : before)
      renderer.value()->Draw(picture);  // as a window: what is asked for comes later
    renderer.value()->DrawWhole(last);
    return renderer.value()->Read();
  };
  const Image alone = film({});
  EXPECT_EQ(film({On(140.0, scene::CameraKind::kTop), On(25.0, scene::CameraKind::kDriver)}).rgb, alone.rgb);
  if (IsLongForm()) {
    EXPECT_EQ(film(Tour()).rgb, alone.rgb);
  }
}

// A viewer that looks at nothing but the sky still finds ground when it turns round.
TEST_F(MadeWorld, WhatIsOutOfSightComesTooCoarsely) {
  world_ = scene::OpenDriveWorld(
      "<road id=\"1\" length=\"1500\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0.1\" "
      "length=\"1500\"><line/></geometry></planView><lanes><laneSection s=\"0\"><center><lane "
      "id=\"0\"/></center><right>"
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/></lane></right>"
      "</laneSection></lanes></road>\n");
  ASSERT_NE(world_, nullptr);
  const auto surface = Open(Quality::kLow);
  const auto renderer = RendererOf(*surface, *world_, {});
  ASSERT_TRUE(renderer.ok());
  Picture picture = On(70.0, scene::CameraKind::kDriver);
  picture.mirrors.fill(false);
  picture.moment.cars[0].q_WB = scene::Attitude(0.0, -1.5707, 0.0);
  renderer.value()->DrawWhole(picture);
  const std::size_t looked_at = renderer.value()->HeldLevels();
  const std::size_t tiles = scene::GroundPlan(*world_).tiles().size();
  EXPECT_LT(looked_at, tiles);
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (renderer.value()->HeldLevels() < tiles && std::chrono::steady_clock::now() < end)
    renderer.value()->Draw(picture);
  EXPECT_GE(renderer.value()->HeldLevels(), tiles);
}

// Far beyond what is drawn nothing is made, and nothing is made again and again: a straight road of 36 km, looked
// along.
TEST(MadeFarWorld, HoldsWhatIsSeenAndNoMore) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Parse(
      "rodeira: world/2\nname: long\nground: {kind: plane, z_m: 0}\nroads:\n  - id: main\n    start: {x_m: 0, y_m: 0, "
      "heading_deg: 0}\n"
      "    axis: [{line: {length_m: 36000}}]\n    z_m: 0\n    section: {template: rural}\n",
      "long.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const auto surface = Surface::Open(SurfaceKind::kOffscreen, 160, 90, "test", false, 0, Quality::kLow);
  const auto renderer = RendererOf(*surface.value(), *world.value(), {});
  ASSERT_TRUE(renderer.ok());
  Picture picture;
  picture.moment.cars.push_back(CarAt({100.0, -1.75, 0.0}, 0.0));
  const std::size_t tiles = scene::GroundPlan(*world.value()).tiles().size();
  // A picture after the other until twenty want nothing that is not there.
  int quiet = 0;
  const auto end = std::chrono::steady_clock::now() + 30s;
  while (quiet < 20 && std::chrono::steady_clock::now() < end) {
    ++quiet;
    renderer.value()->DrawWhole(picture, [&](double) { quiet = 0; });
    renderer.value()->Draw(picture);
  }
  EXPECT_EQ(quiet, 20);
  const std::size_t held = renderer.value()->HeldLevels();
  EXPECT_GT(held, tiles / 3);
  EXPECT_LT(held, tiles * 3 / 5) << "of 36 km some 15 are seen";
}

}  // namespace
}  // namespace rodeira::nodes
