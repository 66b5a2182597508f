// What a person's keys do to the picture, without a display.
#include <SDL.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/base/temporary_folder.hpp"
#include "nodes/view/screen.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::view {
namespace {

TEST(Screen, APictureIsWrittenAsItIsSeenAndNoneIsLost) {
  RODEIRA_NEEDS_PICTURES();
  auto folder = base::TemporaryFolder::Make("pictures");
  ASSERT_TRUE(folder.ok());
  ::setenv("XDG_DATA_HOME", folder.value().path().c_str(), 1);
  const auto world = road::World::Load(RODEIRA_SOURCE_DIR "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  auto screen = Screen::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::Moment moment;
  moment.time_ns = 12'340'000'000;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  screen.value()->Show(moment, 1.0);
  const Image seen = screen.value()->painter().Read();
  const auto pictures = folder.value().path() / "rodeira/pictures";
  EXPECT_FALSE(std::filesystem::exists(pictures));
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(screen.value()->TakeKey(SDLK_F12, true));
    screen.value()->Show(moment, 1.0);
  }
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_EQ(ReadPng(pictures / (world->name() + "-12.34s.png")).rgb, seen.rgb);
  EXPECT_TRUE(std::filesystem::exists(pictures / (world->name() + "-12.34s-2.png")));
  EXPECT_NE(screen.value()->painter().Read().rgb, seen.rgb) << "the window says where it is";
}

TEST(Screen, MirrorsGoAndComeBackByTheirKey) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(RODEIRA_SOURCE_DIR "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  settings.camera = scene::CameraKind::kDriver;
  auto screen = Screen::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::Moment moment;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const auto shown = [&] {
    screen.value()->Show(moment, 1.0);
    return screen.value()->painter().Read();
  };
  const Image with = shown();
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F4, true));
  EXPECT_NE(shown().rgb, with.rgb);
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F4, true));
  EXPECT_EQ(shown().rgb, with.rgb);
}

}  // namespace
}  // namespace rodeira::view
