// SPDX-License-Identifier: Apache-2.0
// Watching a recording: what keys and mouse do, and what the bar shows. Off-screen: SDL's events need no display.
#include <SDL.h>
#include <gtest/gtest.h>

#include "nodes/view/overlays/timeline_bar.hpp"
#include "nodes/view/playback/replay_keys.hpp"
#include "nodes/view/playback/replay_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::int64_t kMs = 1'000'000, kS = 1000 * kMs;

TEST(ReplayKeys, MoveThePlayer) {
  scene::Player player(100 * kS, 20 * kMs);
  const std::vector<std::int64_t> marks = {20 * kS, 55 * kS};
  const auto after = [&](int symbol, int modifiers = 0) {
    EXPECT_TRUE(TakeReplayKey(player, marks, symbol, modifiers)) << symbol;
    return player.now_ns();
  };
  EXPECT_EQ(after(SDLK_3), 30 * kS);
  EXPECT_EQ(after(SDLK_KP_9), 90 * kS);
  EXPECT_EQ(after(SDLK_END), 100 * kS);
  EXPECT_EQ(after(SDLK_HOME), 0);
  EXPECT_EQ(after(SDLK_RIGHT, KMOD_LCTRL), 10 * kS);
  EXPECT_EQ(after(SDLK_RIGHT, KMOD_RSHIFT), 11 * kS);
  EXPECT_EQ(after(SDLK_LEFT, KMOD_LSHIFT), 10 * kS);
  EXPECT_EQ(after(SDLK_LEFT, KMOD_RCTRL), 0);
  EXPECT_FALSE(player.paused());
  EXPECT_EQ(after(SDLK_RIGHT), 20 * kMs);
  EXPECT_TRUE(player.paused());
  EXPECT_EQ(after(SDLK_LEFT), 0);
  EXPECT_EQ(after(SDLK_PAGEUP), 0) << "no mark before";
  EXPECT_EQ(after(SDLK_PAGEDOWN), 20 * kS);
  EXPECT_EQ(after(SDLK_PAGEDOWN), 55 * kS);
  EXPECT_EQ(after(SDLK_PAGEDOWN), 55 * kS) << "no mark behind";
  EXPECT_EQ(after(SDLK_PAGEUP), 20 * kS);
  after(SDLK_SPACE);
  EXPECT_FALSE(player.paused());
  after(SDLK_r);
  EXPECT_TRUE(player.backward());
  after(SDLK_PLUS);
  EXPECT_EQ(player.speed(), 2.0);
  after(SDLK_MINUS);
  after(SDLK_KP_MINUS);
  EXPECT_EQ(player.speed(), 0.5);
  for (const int other : {SDLK_k, SDLK_TAB, SDLK_0, SDLK_z, SDLK_UP})
    EXPECT_FALSE(TakeReplayKey(player, marks, other, 0)) << other;
}

TEST(ReplayKeys, AreAllInTheHelp) {
  for (const char* part : {"space", "left right", "shift", "ctrl", "home end", "page up", "+ -", "1 to 9", "mouse",
                           "\nr  ", "\nk  camera", "escape  end"}) {
    EXPECT_NE(ReplayHelp().find(part), std::string::npos) << part;
  }
  EXPECT_EQ(ReplayHelp().find("place the car"), std::string::npos) << "what was recorded stays as it is";
  EXPECT_EQ(ReplayHelp().find("weather"), std::string::npos);
}

TEST(TimelineOf, SaysWhereOneIs) {
  scene::Player player(7325 * kS, 20 * kMs);
  player.Seek(3725 * kS + 456 * kMs);
  const std::vector<ReplayMark> marks = {{60 * kS, "start of the lap"}, {3726 * kS, "lorry", MarkKind::kEvent}};
  Timeline timeline = TimelineOf(player, marks);
  EXPECT_EQ(timeline.where, "1:02:05.46 / 2:02:05.00   x 1");
  EXPECT_NEAR(timeline.share, 3725.456 / 7325.0, 1e-12);
  EXPECT_EQ(timeline.note, "lorry");
  ASSERT_EQ(timeline.marks.size(), 1u);
  ASSERT_EQ(timeline.events.size(), 1u);
  EXPECT_NEAR(timeline.marks[0], 60.0 / 7325.0, 1e-12);
  EXPECT_NEAR(timeline.events[0], 3726.0 / 7325.0, 1e-12);
  player.Seek(61 * kS + kMs);
  player.Pause();
  player.Reverse();
  player.set_speed(0.5);
  timeline = TimelineOf(player, marks);
  EXPECT_EQ(timeline.where, "1:01.00 / 2:02:05.00   x -0.5  paused");
  EXPECT_EQ(timeline.note, "") << "more than a second away";
}

TEST(TimelinePlace, PixelsAndSharesAreEachOthersInverse) {
  for (const auto& [width, height] :
       {std::pair(64, 64), std::pair(960, 540), std::pair(1280, 720), std::pair(7680, 4320)}) {
    const PanelSize size = PanelsOf(width, height);
    const TimelinePlace place(size);
    for (const double share : {0.0, 0.1, 0.5, 1.0})
      EXPECT_NEAR(place.ShareAt(static_cast<double>(size.scale * place.XOf(share))), share, 1e-5);
    EXPECT_EQ(place.ShareAt(-5.0), 0.0);
    EXPECT_EQ(place.ShareAt(width), 1.0);
  }
}

// Panels have the same share of a picture whatever its size, down to half their size at 1280 x 720, which is still
// read.
TEST(PanelSize, GoesWithThePicturesHeight) {
  const auto units = [](int width, int height) {
    return std::pair(PanelsOf(width, height).width, PanelsOf(width, height).height);
  };
  EXPECT_EQ(units(1280, 720), std::pair(1280.0F, 720.0F));
  EXPECT_EQ(units(1920, 1080), std::pair(1280.0F, 720.0F));
  EXPECT_EQ(units(3840, 2160), std::pair(1280.0F, 720.0F));
  EXPECT_EQ(units(640, 360), std::pair(1280.0F, 720.0F));
  EXPECT_EQ(units(320, 180), std::pair(640.0F, 360.0F)) << "smaller letters could not be read";
  EXPECT_EQ(units(960, 960), std::pair(960.0F, 960.0F)) << "its width counts";
  EXPECT_EQ(PanelsOf(1920, 1080).scale, 1.5F);
}

TEST(TimelineBar, IsSeenOverThePicture) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml");
  Picture picture;
  picture.moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const auto draw = [&] { return RenderStill(*world.value(), picture, 960, 540).value(); };
  const Image without = draw();
  picture.timeline = Timeline{0.4, {0.25, 0.8}, "0:04.00 / 0:10.00", "a mark", "keys", {0.7}};
  const Image with = draw();
  const TimelinePlace place(PanelsOf(960, 540));
  const double track = 540.0 - 0.75 * 18.0;  // from above
  const auto at = [&](double share) { return ProbeAt(with, 0.75 * static_cast<double>(place.XOf(share)), track, 0); };
  EXPECT_TRUE(at(0.1).IsBlue()) << at(0.1);
  EXPECT_TRUE(at(0.25).IsYellow()) << at(0.25);
  EXPECT_TRUE(at(0.4).IsWhite()) << at(0.4);
  EXPECT_TRUE(at(0.8).IsYellow()) << at(0.8);
  const Probe event = at(0.7);
  EXPECT_TRUE(event.green > 150.0 && event.green > 1.5 * event.red && event.green > 1.3 * event.blue)
      << "an event has a colour of its own: " << event;
  EXPECT_FALSE(at(0.6).IsBlue() || at(0.6).IsYellow() || at(0.6).IsWhite()) << at(0.6);
  // Above the bar, the note and the instruments nothing is changed.
  const auto upper = 3 * 960 * 350;
  EXPECT_TRUE(std::equal(with.rgb.begin(), with.rgb.begin() + upper, without.rgb.begin()));
}

// The loop itself: one event at a time is put before it, and what it then shows is looked at.
TEST(ReplayWindow, AnswersWhileItStands) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml");
  ViewSettings settings;
  settings.width_px = 640;
  settings.height_px = 360;
  auto window = ReplayWindow::Open(
      settings,
      [&] {
        return ReadWorld{world.value(), {}};
      },
      SurfaceKind::kOffscreen);
  ASSERT_TRUE(window.ok()) << window.error().Text();
  const auto key = [](SDL_Keycode symbol) {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = symbol;
    return event;
  };
  const auto mouse = [](Uint32 type, int x_px, int y_px) {
    SDL_Event event{};
    event.type = type;
    if (type == SDL_MOUSEMOTION) {
      event.motion.x = x_px;
      event.motion.y = y_px;
    } else {
      event.button.button = SDL_BUTTON_LEFT;
      event.button.x = x_px;
      event.button.y = y_px;
    }
    return event;
  };
  const int middle = 320, bar = 340, above = 100;
  struct Told {
    SDL_Event event;
    std::int64_t expected_ns;
  };
  const std::vector<Told> told = {{key(SDLK_RIGHT), 20 * kMs},
                                  {key(SDLK_PAGEDOWN), 20 * kMs},  // no mark is known yet
                                  {key(SDLK_5), 5 * kS},
                                  {key(SDLK_k), 5 * kS},  // another camera, the same time
                                  {mouse(SDL_MOUSEBUTTONDOWN, 100, above), 5 * kS},
                                  {mouse(SDL_MOUSEMOTION, 200, bar), 5 * kS},  // it was not taken on the bar
                                  {mouse(SDL_MOUSEBUTTONDOWN, 0, bar), 0},
                                  {mouse(SDL_MOUSEMOTION, middle, above), 5 * kS},  // and here it was
                                  {mouse(SDL_MOUSEBUTTONUP, middle, above), 5 * kS},
                                  {mouse(SDL_MOUSEMOTION, 0, bar), 5 * kS},
                                  {key(SDLK_END), 10 * kS},
                                  {key(SDLK_PAGEUP), 2 * kS}};
  scene::Player player(10 * kS, 20 * kMs);
  player.Pause();
  std::size_t next = 0;
  std::int64_t shown_ns = -1;
  const auto moment_at = [&](std::int64_t time_ns) {
    shown_ns = time_ns;
    scene::SceneSnapshot moment;
    moment.time_ns = time_ns;
    moment.cars.push_back(CarAt({0.0, 0.0, 0.0}, 0.0));
    return base::Result<scene::SceneSnapshot>(moment);
  };
  const auto stop = [&] {
    EXPECT_TRUE(next == 0 || next > told.size() || shown_ns == told[next - 1].expected_ns)
        << shown_ns << " after event " << next - 1;
    SDL_Event event = next < told.size() ? told[next].event : key(SDLK_ESCAPE);
    ++next;
    SDL_PushEvent(&event);
    return next > told.size() + 5;
  };
  bool given = false;
  const auto take_marks = [&]() -> std::optional<base::Result<std::vector<ReplayMark>>> {
    if (given || next < 5) return std::nullopt;  // they are read beside the window
    given = true;
    return std::vector<ReplayMark>{{2 * kS, "mark"}};
  };
  EXPECT_TRUE(window.value()->Watch(player, take_marks, moment_at, stop).ok());
  EXPECT_EQ(next, told.size() + 1) << "escape ends it";
  EXPECT_EQ(shown_ns, 2 * kS);
}

// The recording is seen all the same, and why is told at the end.
TEST(ReplayWindow, MarksThatCannotBeReadEndNothing) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml");
  auto window = ReplayWindow::Open(
      {},
      [&] {
        return ReadWorld{world.value(), {}};
      },
      SurfaceKind::kOffscreen);
  ASSERT_TRUE(window.ok()) << window.error().Text();
  scene::Player player(10 * kS, 20 * kMs);
  int shown = 0, asked = 0;
  const auto moment_at = [&](std::int64_t time_ns) {
    ++shown;
    scene::SceneSnapshot moment;
    moment.time_ns = time_ns;
    return base::Result<scene::SceneSnapshot>(moment);
  };
  const auto take_marks = [&]() -> std::optional<base::Result<std::vector<ReplayMark>>> {
    if (asked != 1) return std::nullopt;
    return base::Result<std::vector<ReplayMark>>(base::WrongInput("recording.damaged", "a mark is damaged"));
  };
  const auto status = window.value()->Watch(player, take_marks, moment_at, [&] { return ++asked > 4; });
  EXPECT_EQ(shown, 4);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().Text(), "a mark is damaged");
}

// A damaged place holds the player; past it the rest is seen, and the error is told at the end.
TEST(ReplayWindow, StandsStillWhereTheFileIsDamaged) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml");
  auto window = ReplayWindow::Open(
      {},
      [&] {
        return ReadWorld{world.value(), {}};
      },
      SurfaceKind::kOffscreen);
  ASSERT_TRUE(window.ok()) << window.error().Text();
  scene::Player player(10 * kS, 20 * kMs);
  player.Seek(5 * kS);
  std::vector<std::int64_t> shown;
  const auto moment_at = [&](std::int64_t time_ns) -> base::Result<scene::SceneSnapshot> {
    if (time_ns >= 5 * kS && time_ns < 6 * kS) return base::WrongInput("recording.damaged", "5 s to 6 s are damaged");
    shown.push_back(time_ns);
    scene::SceneSnapshot moment;
    moment.time_ns = time_ns;
    return moment;
  };
  int asked = 0;
  bool held = false;
  const auto stop = [&] {
    if (asked == 1) held = player.paused();  // it was told to play
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = asked == 1 ? SDLK_9 : SDLK_ESCAPE;
    if (asked > 0) SDL_PushEvent(&event);
    return ++asked > 10;
  };
  const auto status = window.value()->Watch(
      player, [] { return std::nullopt; }, moment_at, stop);
  EXPECT_TRUE(held);
  EXPECT_EQ(shown, std::vector<std::int64_t>{9 * kS});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().Text(), "5 s to 6 s are damaged");
}

}  // namespace
}  // namespace rodeira::nodes
