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

// A click on a car of the traffic, seen from behind: it pulses with simulated time, its panel stands there; a click beside it ends that.
TEST(Screen, AClickChoosesAVehicle) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(RODEIRA_SOURCE_DIR "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 960;
  settings.height_px = 540;
  settings.instruments = false;
  auto screen = Screen::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::Moment moment;
  moment.time_ns = 400'000'000;  // half of the pulse's 0.8 s: at its most
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  scene::AgentPose agent;
  agent.id = 5;
  agent.colour = scene::Colour::Of(0x1040e0);
  agent.p_WB_W = moment.cars[0].p_WB_W + moment.cars[0].q_WB * Eigen::Vector3d(14.0, 4.0, 0.0);
  agent.q_WB = moment.cars[0].q_WB;
  moment.agents.push_back(agent);
  const scene::Camera camera = scene::ChaseCamera(moment.cars[0], *world);
  const Eigen::Vector3d tail_W = agent.p_WB_W + agent.q_WB * Eigen::Vector3d(-1.95, 0.0, 0.80);
  const auto shown = [&] {
    screen.value()->Show(moment, 1.0);
    return screen.value()->painter().Read();
  };
  const auto click = [&](const Eigen::Vector2d& at) {
    SDL_Event event{};
    event.type = SDL_MOUSEBUTTONDOWN;
    event.button.button = SDL_BUTTON_LEFT;
    (void)screen.value()->TakeMouse(event, false);
    event.type = SDL_MOUSEBUTTONUP;
    event.button.x = static_cast<int>(at.x());
    event.button.y = static_cast<int>(at.y());
    return screen.value()->TakeMouse(event, false);
  };
  const Image before = shown();
  EXPECT_TRUE(ProbeAt(before, camera, tail_W).IsBlue()) << ProbeAt(before, camera, tail_W);
  EXPECT_TRUE(click(*camera.Project(tail_W, 960, 540)));
  const Image chosen = shown();
  EXPECT_GT(ProbeAt(chosen, camera, tail_W).red, ProbeAt(before, camera, tail_W).red + 80.0) << ProbeAt(chosen, camera, tail_W);
  EXPECT_LT(ProbeAt(chosen, 380, 540 - 60, 3).green, 0.75 * ProbeAt(before, 380, 540 - 60, 3).green) << "the panel's box";
  moment.time_ns = 800'000'000;
  EXPECT_TRUE(ProbeAt(shown(), camera, tail_W).IsBlue()) << "between two pulses";
  moment.time_ns = 400'000'000;
  EXPECT_TRUE(click({480.0, 20.0}));
  EXPECT_EQ(shown().rgb, before.rgb);
}

TEST(Chosen, SaysWhatTheCarDoesAndSinceWhen) {
  scene::Moment moment;
  moment.cars.emplace_back();
  scene::CarPose& car = moment.cars[0];
  car.id = 3;
  car.speed_mps = 25.0;
  car.gear = 4;
  car.engine_rpm = 2900.0;
  car.throttle = 0.4;
  car.fuel_l = 40.0;
  car.fuel_lph = 5.4;  // at 90 km/h: 6 l for 100 km
  car.odometer_m = 1000.0;
  Chosen chosen;
  chosen.Choose(moment, 0);
  EXPECT_NE(chosen.Panel(moment).find("90.0 km/h   gear 4   2900 1/min\nthrottle 40 %   brake 0 %"), std::string::npos) << chosen.Panel(moment);
  EXPECT_NE(chosen.Panel(moment).find("now 6.0 l/100 km"), std::string::npos) << chosen.Panel(moment);
  moment.time_ns = 80'000'000'000;
  car.odometer_m = 3000.0;
  car.fuel_l = 39.86;
  EXPECT_NE(chosen.Panel(moment).find("mean 7.0 l/100 km over 2.00 km"), std::string::npos) << chosen.Panel(moment);
  moment.time_ns = 0;
  car.odometer_m = 500.0;  // back in a recording: counted from there
  EXPECT_NE(chosen.Panel(moment).find("mean -"), std::string::npos) << chosen.Panel(moment);
  car.id = 4;
  EXPECT_EQ(chosen.Panel(moment), "") << "it has left";
  EXPECT_FALSE(chosen.In(moment));
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
