// SPDX-License-Identifier: Apache-2.0
// A car's model from a file: it is seen where the procedural car would be, and its wheels turn; without it the
// procedural one stays.
#include <gtest/gtest.h>

#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgDB/WriteFile>

#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "nodes/view/frame/surface.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

osg::ref_ptr<osg::Geode> BoxOf(const osg::Vec3& middle, const osg::Vec3& sides, const osg::Vec4& colour) {
  osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box(middle, sides.x(), sides.y(), sides.z()));
  box->setColor(colour);
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(box);
  return geode;
}

// A magenta box with cyan bars for wheels, which stand out upward as long as they do not turn.
fs::path WriteModel(const fs::path& folder) {
  osg::ref_ptr<osg::Group> car = new osg::Group;
  car->addChild(BoxOf({0.0F, 0.0F, 0.6F}, {4.0F, 1.5F, 0.8F}, {1.0F, 0.0F, 1.0F, 1.0F}));
  for (const char* name : {"wheel_front_left", "wheel_front_right", "wheel_rear_left", "wheel_rear_right"}) {
    const auto wheel = BoxOf({0.0F, 0.0F, 0.5F}, {0.3F, 0.3F, 1.0F}, {0.0F, 1.0F, 1.0F, 1.0F});
    wheel->setName(name);
    car->addChild(wheel);
  }
  // Lamps, white in the file: two for each brake, and one of each other kind, side by side on the tail and the roof.
  osg::ref_ptr<osg::Group> tail = new osg::Group;
  for (const float y : {-0.6F, 0.6F})
    tail->addChild(BoxOf({-2.0F, y, 0.8F}, {0.1F, 0.2F, 0.2F}, {1.0F, 1.0F, 1.0F, 1.0F}));
  tail->setName("lamp_brake");
  car->addChild(tail);
  float y = -0.45F;
  for (const char* name : {"lamp_indicator_left", "lamp_indicator_right", "lamp_reversing", "lamp_head"}) {
    const auto lamp = BoxOf({-1.0F, y, 1.15F}, {0.2F, 0.2F, 0.2F}, {1.0F, 1.0F, 1.0F, 1.0F});
    lamp->setName(name);
    car->addChild(lamp);
    y += 0.3F;
  }
  const fs::path file = folder / "car.osgt";
  EXPECT_TRUE(osgDB::writeNodeFile(*car, file.string()));
  return file;
}

class CarModel : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    folder_ = fs::path(::testing::TempDir()) / ("rodeira-car-model-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    world_ = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
    picture_.show_instruments = false;
    picture_.moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  }
  void TearDown() override { fs::remove_all(folder_); }
  const scene::CarPose& car() const { return picture_.moment.cars[0]; }
  Eigen::Vector3d At(double ahead, double left, double up) const {
    return car().p_WB_W + car().q_WB * Eigen::Vector3d(ahead, left, up);
  }

  fs::path folder_;
  std::shared_ptr<const road::World> world_;
  Picture picture_;
};

// The car before a surface of its own; at most one of those lives in a process.
class CarModelDrawn : public CarModel {
 protected:
  void SetUp() override {
    CarModel::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    auto surface = Surface::Open(SurfaceKind::kOffscreen, 960, 540, "test");
    ASSERT_TRUE(surface.ok()) << surface.error().Text();
    surface_ = std::move(surface).value();
    auto renderer = RendererOf(*surface_, *world_, {});
    ASSERT_TRUE(renderer.ok()) << renderer.error().Text();
    renderer_ = std::move(renderer).value();
  }
  void UseModel() { ASSERT_TRUE(renderer_->UseCarModel(WriteModel(folder_)).ok()); }
  Image Drawn() {
    renderer_->Draw(picture_);
    return renderer_->Read();
  }

  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Renderer> renderer_;  // before its surface in dying
};

bool IsMagenta(const Probe& p) { return p.red > 150.0 && p.blue > 150.0 && p.green < 60.0; }
bool IsCyan(const Probe& p) { return p.red < 60.0 && p.blue > 150.0 && p.green > 150.0; }

TEST_F(CarModelDrawn, StandsInPlaceOfTheProceduralCarAndItsWheelsTurn) {
  const scene::Camera camera = scene::ChaseCamera(car(), *world_);
  const Eigen::Vector3d tail_W = At(-2.0, 0.0, 0.6), upright_W = At(-1.23, 0.71, 1.15);
  const Image before = Drawn();
  EXPECT_FALSE(IsMagenta(ProbeAt(before, camera, tail_W))) << ProbeAt(before, camera, tail_W);
  UseModel();
  const Image worn = Drawn();
  EXPECT_TRUE(IsMagenta(ProbeAt(worn, camera, tail_W))) << ProbeAt(worn, camera, tail_W);
  EXPECT_TRUE(IsCyan(ProbeAt(worn, camera, upright_W))) << ProbeAt(worn, camera, upright_W);
  picture_.moment.cars[0].wheels[2].spin_rad = 3.141592653589793;  // the rear left one, half a turn
  EXPECT_FALSE(IsCyan(ProbeAt(Drawn(), camera, upright_W))) << "it points down now";
}

// Each lamp shines where the car says so, and no other one does; by day, unlit, it is dull.
TEST_F(CarModelDrawn, ItsLampsShineAsTheCarSays) {
  UseModel();
  const scene::Camera camera = scene::ChaseCamera(car(), *world_);
  using Brightness = std::map<std::string, double>;
  const auto shown = [&](const scene::CarLights& lights) {
    picture_.moment.cars[0].lights = lights;
    const Image image = Drawn();
    const auto at = [&](double ahead, double left, double up) {
      const Probe p = ProbeAt(image, camera, At(ahead, left, up));
      return p.red + p.green + p.blue;
    };
    return Brightness{{"brake right", at(-2.05, -0.6, 0.8)}, {"brake left", at(-2.05, 0.6, 0.8)},
                      {"left", at(-1.1, -0.45, 1.15)},       {"right", at(-1.1, -0.15, 1.15)},
                      {"reversing", at(-1.1, 0.15, 1.15)},   {"head", at(-1.1, 0.45, 1.15)}};
  };
  const Brightness dull = shown({});
  const auto lit = [&](const scene::CarLights& lights) {
    std::set<std::string> names;
    for (const auto& [name, now] : shown(lights)) {
      if (now > dull.at(name) + 40.0)
        names.insert(name);
      else
        EXPECT_NEAR(now, dull.at(name), 2.0) << name;
    }
    return names;
  };
  EXPECT_EQ(lit({.brake = true}), (std::set<std::string>{"brake left", "brake right"}));
  EXPECT_EQ(lit({.left = true}), std::set<std::string>{"left"});
  EXPECT_EQ(lit({.right = true}), std::set<std::string>{"right"});
  EXPECT_EQ(lit({.reversing = true}), std::set<std::string>{"reversing"});
  EXPECT_GT(shown({.dipped = true}).at("head"), dull.at("head") + 30.0);
}

// A chosen car pulses in whatever body: towards the pulse's light yellow, 65 of 100 at its most, and back; another
// one's does not.
TEST_F(CarModelDrawn, PulsesWhereTheCarIsChosen) {
  UseModel();
  const scene::Camera camera = scene::ChaseCamera(car(), *world_);
  const auto shown = [&](std::int64_t time_ns, std::optional<std::size_t> chosen) {
    picture_.moment.time_ns = time_ns;
    picture_.chosen = chosen;
    return Drawn();
  };
  const Image plain = shown(400'000'000, std::nullopt), most = shown(400'000'000, 0),
              none = shown(800'000'000, 0);  // it takes 0.8 s
  const Probe was = ProbeAt(plain, camera, At(-2.0, 0.0, 0.6)), is = ProbeAt(most, camera, At(-2.0, 0.0, 0.6));
  EXPECT_TRUE(IsMagenta(was)) << was;
  EXPECT_NEAR(is.red, 0.35 * was.red + 0.65 * 255.0, 3.0) << is;
  EXPECT_NEAR(is.green, 0.35 * was.green + 0.65 * 0.95 * 255.0, 3.0) << is;
  EXPECT_NEAR(is.blue, 0.35 * was.blue + 0.65 * 0.55 * 255.0, 3.0) << is;
  EXPECT_EQ(none.rgb, plain.rgb);
  const Probe ground = ProbeAt(most, camera, At(-2.0, 2.5, 0.0));
  EXPECT_EQ(ground, ProbeAt(plain, camera, At(-2.0, 2.5, 0.0))) << "beside it nothing changes";
}

TEST_F(CarModel, WhichCannotBeReadIsASentenceAndTheProceduralCarStays) {
  const fs::path broken = folder_ / "broken.osgt";
  std::ofstream(broken) << "no model";
  const auto seen_with = [&](const fs::path& model) {
    ViewSettings settings;
    settings.width_px = 320;
    settings.height_px = 180;
    settings.instruments = false;
    settings.car_model = model;
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world_, false, "help");
    EXPECT_TRUE(screen.ok());
    screen.value()->renderer().Draw(picture_);
    return screen.value()->renderer().Read().rgb;
  };
  const auto without = seen_with({});
  for (const fs::path& model : {folder_ / "missing.osgb", broken}) {
    testing::internal::CaptureStderr();
    const auto with = seen_with(model);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find(model.string()), std::string::npos) << said;
    EXPECT_NE(said.find("cannot read this model; the car is drawn without it\n"), std::string::npos) << said;
    EXPECT_EQ(with, without);
  }
}

}  // namespace
}  // namespace rodeira::nodes
