// SPDX-License-Identifier: Apache-2.0
// What a person's keys do to the picture, without a display.
#include <SDL.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "common/core/base/temporary_folder.hpp"
#include "nodes/view/run_connection/live_requester.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/screen_hands.hpp"

namespace rodeira::nodes {
namespace {

TEST(ViewWindow, APictureIsWrittenAsItIsSeenAndNoneIsLost) {
  RODEIRA_NEEDS_PICTURES();
  auto folder = base::TemporaryFolder::Make("pictures");
  ASSERT_TRUE(folder.ok());
  ::setenv("XDG_DATA_HOME", folder.value().path().c_str(), 1);
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::SceneSnapshot moment;
  moment.time_ns = 12'340'000'000;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  screen.value()->Show(moment, 1.0);
  const Image seen = screen.value()->renderer().Read();
  const auto pictures = folder.value().path() / "rodeira/pictures";
  EXPECT_FALSE(std::filesystem::exists(pictures));
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(screen.value()->TakeKey(SDLK_F12, true));
    screen.value()->Show(moment, 1.0);
  }
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_EQ(ReadPng(pictures / (world->name() + "-12.34s.png")).rgb, seen.rgb);
  EXPECT_TRUE(std::filesystem::exists(pictures / (world->name() + "-12.34s-2.png")));
  EXPECT_NE(screen.value()->renderer().Read().rgb, seen.rgb) << "the window says where it is";
}

// Behind its key, or with ctrl held, a click asks for the place on the ground that is seen there, whatever drives; the
// next one does not.
TEST(ViewWindow, AClickAsksForThePlaceOnTheGroundThatIsSeenThere) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  settings.camera = scene::CameraKind::kTop;
  settings.cars = {{0, "ego"}};
  settings.mouse_button = kRightButton;  // the left one drives
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  std::vector<scenario::Request> asked;
  screen.value()->set_ask([&](const scenario::Request& request) {
    asked.push_back(request);
    return true;
  });
  const Version1Road& road = N222Road();
  const Eigen::Vector3d here = road.Position(300.0, road.LaneCentre(-1));
  scene::SceneSnapshot moment;
  moment.cars.push_back(CarAt(here, 1.0));
  screen.value()->Show(moment, 1.0);
  const scene::Camera camera = scene::TopCamera(moment.cars[0], {});
  const Eigen::Vector3d there = road.Position(312.0, road.LaneCentre(1));
  const auto click = [&] { return Click(*screen.value(), *camera.Project(there, 320, 180)); };
  EXPECT_FALSE(click()) << "the car's own";
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F6, true));
  EXPECT_TRUE(click());
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].name, "place");
  EXPECT_NEAR(asked[0].x_m, there.x(), 0.6) << "a pixel is 0.44 m";
  EXPECT_NEAR(asked[0].y_m, there.y(), 0.6);
  EXPECT_NEAR(
      std::remainder(asked[0].value - (road.Evaluate(312.0).heading_rad * 180.0 / 3.14159265358979 + 180.0), 360.0),
      0.0, 1.0)
      << "against the axis, as lane 1 drives";
  EXPECT_EQ(scenario::ParsePlace("ego 0 0" + asked[0].argument.substr(3)).value().z_m.has_value(), true);
  EXPECT_FALSE(click());
  SDL_SetModState(KMOD_LCTRL);
  EXPECT_TRUE(click());
  SDL_SetModState(KMOD_NONE);
  EXPECT_EQ(asked.size(), 2u);
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F7, true));
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_EQ(asked[2].name, "weather");
  EXPECT_EQ(asked[2].argument, "overcast");
}

// A key asks for the followed car where it began: at the world's start, or where the launch file says.
TEST(ViewWindow, AKeyAsksForTheCarBackAtItsStart) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  settings.cars = {{0, "ego"}, {7, "guest"}, {8, "turned"}};
  settings.starts = {{0, {}}, {7, {12.5, -3.0, 90.0}}, {8, {std::nullopt, std::nullopt, 180.0}}};
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F2, true)) << "nobody takes it, which is said";
  std::vector<scenario::Request> asked;
  screen.value()->set_ask([&](const scenario::Request& request) {
    asked.push_back(request);
    return true;
  });
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F2, true));
  EXPECT_TRUE(asked.empty()) << "nobody drives yet";
  scene::SceneSnapshot moment;
  for (const std::uint64_t id : {0, 7, 8}) {
    moment.cars.push_back(CarAt({40.0 + 10.0 * static_cast<double>(id), 5.0, 60.0}, 1.0));
    moment.cars.back().id = id;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    screen.value()->Show(moment, 1.0);
    EXPECT_TRUE(screen.value()->TakeKey(SDLK_F2, true));
    EXPECT_TRUE(screen.value()->TakeKey(SDLK_TAB, true));
  }
  ASSERT_EQ(asked.size(), 3u);
  const road::StartPose& start = world->start();
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  EXPECT_EQ(asked[0].name, "place");
  EXPECT_EQ(asked[0].argument, "ego");
  EXPECT_EQ(asked[0].x_m, start.x_m);
  EXPECT_EQ(asked[0].y_m, start.y_m);
  EXPECT_NEAR(asked[0].value, start.heading_rad * kDegrees, 1e-9);
  EXPECT_EQ(std::tuple(asked[1].argument, asked[1].x_m, asked[1].y_m, asked[1].value),
            std::tuple(std::string("guest"), 12.5, -3.0, 90.0));
  EXPECT_EQ(std::tuple(asked[2].argument, asked[2].x_m, asked[2].value),
            std::tuple(std::string("turned"), start.x_m, 180.0));
}

// The window shows a car in its paint: the same place of its body, blue and yellow.
TEST(ViewWindow, ACarIsSeenInItsPaint) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  const auto roof = [&](const char* paint) {
    ViewSettings settings;
    settings.width_px = 320;
    settings.height_px = 180;
    settings.camera = scene::CameraKind::kTop;
    settings.paints = {{3, PaintOf(paint).value()}};
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
    EXPECT_TRUE(screen.ok()) << screen.error().Text();
    SDL_Event nearer{};
    nearer.type = SDL_MOUSEWHEEL;
    nearer.wheel.y = 12;
    EXPECT_TRUE(screen.value()->TakeMouse(nearer));
    scene::SceneSnapshot moment;
    moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.0));
    moment.cars[0].id = 3;
    return ProbeAt(Shown(*screen.value(), moment), 160, 90);
  };
  const Probe blue = roof("blue"), yellow = roof("yellow");
  EXPECT_GT(blue.blue, 1.5 * blue.red) << blue;
  EXPECT_GT(yellow.red, 1.5 * yellow.blue) << yellow;
}

TEST(AskPlace, WhereTheWorldEndsItSaysThatTheCarStays) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  scene::SceneSnapshot moment;
  moment.cars.push_back(CarAt({0.0, 0.0, 0.0}, 0.6));
  const scene::Ray down{
      {world->extents().east_m - 0.5, 0.5 * (world->extents().south_m + world->extents().north_m), 5'000.0},
      -Eigen::Vector3d::UnitZ()};
  const auto at_the_edge = AskPlace(*world, moment, 0, down, {{0, "ego"}});
  ASSERT_FALSE(at_the_edge.ok()) << "half of the car would stand beyond it";
  EXPECT_EQ(at_the_edge.error().message, "there is no ground of this world: the car stays where it is");
  const auto sky = AskPlace(*world, moment, 0, {{0.0, 0.0, 900.0}, Eigen::Vector3d::UnitZ()}, {{0, "ego"}});
  EXPECT_FALSE(sky.ok());
  EXPECT_EQ(AskPlace(*world, {}, 0, down, {}).error().message,
            "there is no car to place: no node of this run drives one");
}

// It is said again until the run has said it.
TEST(LiveRequester, ARequestIsRepeatedUntilItHasHappened) {
  class Ear final : public launch::LiveRequestsSender {
   public:
    explicit Ear(std::vector<std::vector<launch::LiveRequest>>& heard) : heard_(heard) {}
    void Say(std::vector<launch::LiveRequest> requests) override { heard_.push_back(std::move(requests)); }

   private:
    std::vector<std::vector<launch::LiveRequest>>& heard_;
  };
  std::vector<std::vector<launch::LiveRequest>> heard;
  LiveRequester live_requester(std::make_unique<Ear>(heard));
  live_requester.Tell(0.0);
  EXPECT_TRUE(heard.empty());
  const scenario::Request place = scenario::PlaceRequest({"ego", 0.1, 0.2, 3.0}, 45.0),
                          rain = scenario::WeatherRequest("rain", 8.0);
  EXPECT_TRUE(live_requester.Request(place));
  EXPECT_TRUE(live_requester.Request(rain));
  EXPECT_FALSE(live_requester.Request(scenario::WeatherRequest("hail", 8.0)));
  for (double now_s = 0.0; now_s < 0.999; now_s += 0.01) live_requester.Tell(now_s);
  EXPECT_NEAR(static_cast<double>(heard.size()), 20.0, 1.0);
  ASSERT_EQ(heard.back().size(), 2u);
  EXPECT_EQ(heard.back()[0].number, 1u);
  EXPECT_EQ(heard.back()[1].number, 2u);
  live_requester.See({scenario::EventOf(place).value(), {"mark", "x", 0.0}});
  live_requester.Tell(1.1);
  ASSERT_EQ(heard.back().size(), 1u);
  EXPECT_EQ(heard.back()[0].name, "weather");
  live_requester.See({scenario::EventOf(rain).value()});
  const std::size_t said = heard.size();
  live_requester.Tell(2.0);
  EXPECT_EQ(heard.size(), said);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(live_requester.Request(rain), i < 16);
}

// Agents drive along a line; its ground becomes green where they are at the limit, and the ground beside it stays as it
// was.
TEST(ViewWindow, TheHeatMapColoursTheGroundThatWasDrivenOn) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 640;
  settings.height_px = 360;
  settings.instruments = false;
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  const auto shown = [&](int i) {
    scene::SceneSnapshot moment;
    moment.time_ns = i * 50'000'000;
    moment.cars.push_back(CarAt({0.0, 0.0, 0.0}, 0.0));
    for (const auto& [id, y, speed] : {std::tuple(1, 22.0, 26.0), std::tuple(2, -22.0, 3.0)}) {
      scene::AgentPose agent;
      agent.id = static_cast<std::uint64_t>(id);
      agent.p_WB_W = {-30.0 + 0.05 * i * speed, y, 0.0};
      moment.agents.push_back(agent);
    }
    screen.value()->Show(moment, 1.0);
    return screen.value()->renderer().Read();
  };
  (void)shown(0);
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F9, true));
  for (int i = 1; i < 40; ++i) (void)shown(i);
  const Image before = shown(40);
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F8, true));
  const Image heat = shown(41);
  scene::Aim aim;
  const scene::Camera camera = scene::TopCamera(CarAt({0.0, 0.0, 0.0}, 0.0), aim);
  const Eigen::Vector3d fast(2.0, 22.0, 0.0), slow(-27.5, -22.0, 0.0), beside(20.0, -10.0, 0.0);
  EXPECT_GT(ProbeAt(heat, camera, fast).green, ProbeAt(before, camera, fast).green + 30.0)
      << ProbeAt(heat, camera, fast);
  EXPECT_LT(ProbeAt(heat, camera, fast).red, 0.6 * ProbeAt(before, camera, fast).red) << ProbeAt(heat, camera, fast);
  EXPECT_GT(ProbeAt(heat, camera, slow).red, ProbeAt(before, camera, slow).red + 30.0) << ProbeAt(heat, camera, slow);
  EXPECT_LT(ProbeAt(heat, camera, slow).green, ProbeAt(before, camera, slow).green) << ProbeAt(heat, camera, slow);
  EXPECT_NEAR(ProbeAt(heat, camera, beside).green, ProbeAt(before, camera, beside).green, 3.0);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(screen.value()->TakeKey(SDLK_F8, true));
}

TEST(ViewWindow, FromAboveAndBackToTheSameCamera) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  settings.camera = scene::CameraKind::kOrbit;
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::SceneSnapshot moment;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const auto shown = [&] { return Shown(*screen.value(), moment); };
  SDL_Event turned{};
  turned.type = SDL_MOUSEMOTION;
  turned.motion.state = SDL_BUTTON_LMASK;
  turned.motion.xrel = 70;
  EXPECT_TRUE(screen.value()->TakeMouse(turned));
  const Image before = shown();
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F9, true));
  const Image above = shown();
  EXPECT_NE(above.rgb, before.rgb);
  SDL_Event wheel{};
  wheel.type = SDL_MOUSEWHEEL;
  wheel.wheel.y = 3;
  EXPECT_TRUE(screen.value()->TakeMouse(wheel));
  EXPECT_NE(shown().rgb, above.rgb) << "the map can be zoomed";
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F9, true));
  EXPECT_EQ(shown().rgb, before.rgb);
}

// The log has a line for each picture: what was shown, with the eye of the same moment.
TEST(ViewWindow, TheFrameLogSaysWhatWasShown) {
  RODEIRA_NEEDS_PICTURES();
  auto folder = base::TemporaryFolder::Make("frame_log");
  ASSERT_TRUE(folder.ok());
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 160;
  settings.height_px = 90;
  settings.frame_log = folder.value().path() / "frames.csv";
  {
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    for (int k = 0; k < 3; ++k) {
      scene::SceneSnapshot moment;
      moment.time_ns = 20'000'000 * k;
      moment.cars.push_back(CarAt({0.6 * k, 7.0, 0.0}, 0.0));
      screen.value()->Show(moment, 1.0);
    }
  }
  std::ifstream log(settings.frame_log);
  std::string line;
  std::getline(log, line);
  EXPECT_EQ(line, "wall_s,simulated_s,x_m,y_m,z_m,eye_x_m,eye_y_m,eye_z_m");
  double before_s = 0.0;
  for (int k = 0; k < 3; ++k) {
    std::array<double, 8> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      ASSERT_TRUE(std::getline(log, line, i + 1 < v.size() ? ',' : '\n'));
      v[i] = std::stod(line);
    }
    EXPECT_GT(v[0], before_s);
    before_s = v[0];
    EXPECT_NEAR(v[1], 0.02 * k, 1e-9);
    EXPECT_NEAR(v[2], 0.6 * k, 1e-6);
    const Eigen::Vector3d eye = scene::MakeCamera(settings.camera, CarAt({0.6 * k, 7.0, 0.0}, 0.0), {}, *world).eye_W;
    EXPECT_LT((Eigen::Vector3d(v[5], v[6], v[7]) - eye).norm(), 2e-6);
  }
  EXPECT_FALSE(std::getline(log, line)) << "as many lines as pictures";
  settings.frame_log = folder.value().path() / "none" / "frames.csv";
  EXPECT_FALSE(ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help").ok());
}

TEST(ViewWindow, MirrorsGoAndComeBackByTheirKey) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
  ViewSettings settings;
  settings.width_px = 320;
  settings.height_px = 180;
  settings.camera = scene::CameraKind::kDriver;
  auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world, false, "help");
  ASSERT_TRUE(screen.ok()) << screen.error().Text();
  scene::SceneSnapshot moment;
  moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const auto shown = [&] { return Shown(*screen.value(), moment); };
  const Image with = shown();
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F4, true));
  EXPECT_NE(shown().rgb, with.rgb);
  EXPECT_TRUE(screen.value()->TakeKey(SDLK_F4, true));
  EXPECT_EQ(shown().rgb, with.rgb);
}

}  // namespace
}  // namespace rodeira::nodes
