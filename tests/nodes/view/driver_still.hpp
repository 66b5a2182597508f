// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {

// One surface and renderer for all of a test, the driver's camera, nothing over the picture. `SetUp` of a test that
// derives begins with this one's.
class DriverStill : public ::testing::Test {
 protected:
  DriverStill(const char* world, int width_px, int height_px, Quality quality = Quality::kMedium)
      : width_px_(width_px), height_px_(height_px), quality_(quality), file_(world) {}

  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    auto world = road::World::Load(SourceDir() + "/configs/worlds/" + file_);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    world_ = world.value();
    auto surface = Surface::Open(SurfaceKind::kOffscreen, width_px_, height_px_, "test", false, 0, quality_);
    ASSERT_TRUE(surface.ok()) << surface.error().Text();
    surface_ = std::move(surface).value();
    auto renderer = RendererOf(*surface_, *world_, {});  // made where the eye comes near: less than the whole world
    ASSERT_TRUE(renderer.ok()) << renderer.error().Text();
    renderer_ = std::move(renderer).value();
    picture_.show_instruments = false;
    picture_.mirrors.fill(false);
    picture_.camera = scene::CameraKind::kDriver;
    picture_.moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  }
  scene::CarPose& Car() { return picture_.moment.cars[0]; }
  Image Drawn() {
    renderer_->DrawWhole(picture_);
    return renderer_->Read();
  }

  const int width_px_, height_px_;
  const Quality quality_;
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Renderer> renderer_;
  Picture picture_;

 private:
  const char* file_;
};

}  // namespace rodeira::nodes
