// SPDX-License-Identifier: Apache-2.0
// A window and the run's control socket: space pauses, and the window says what the clock says.
#include <SDL.h>
#include <SDL_opengl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "common/core/base/temporary_folder.hpp"
#include "launch/rodeira/run/control_server.hpp"
#include "nodes/view/window/loading.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

class PausedRun : public testing::Test {
 protected:
  void SetUp() override {
    auto made = base::TemporaryFolder::Make("desk");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    world_ = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
    moment_.time_ns = 1'500'000'000;
    moment_.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  }
  void TearDown() override { ::unsetenv(launch::RunControlClient::kVariable); }

  void Serve() {
    auto server = cli::ControlServer::Open(folder_->path() / "run.ctl");
    ASSERT_TRUE(server.ok()) << server.error().Text();
    server_ = std::move(server).value();
    ::setenv(launch::RunControlClient::kVariable, (folder_->path() / "run.ctl").c_str(), 1);
  }
  void OpenScreen() {
    ViewSettings settings;
    settings.width_px = 320;
    settings.height_px = 180;
    settings.instruments = false;
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings, *world_, false, "help");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    screen_ = std::move(screen).value();
  }
  Image Shown() {
    screen_->Show(moment_, 1.0);
    return screen_->renderer().Read();
  }
  // The next line that the window asks, while it goes on showing the same.
  cli::AskedLine NextRequest() {
    for (int i = 0; i < 2000; ++i) {
      if (auto line = server_->Next()) return *line;
      screen_->Show(moment_, 1.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ADD_FAILURE() << "nothing is asked";
    return {"", [](const std::string&) {}};
  }

  std::optional<base::TemporaryFolder> folder_;
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<cli::ControlServer> server_;
  std::unique_ptr<ViewWindow> screen_;
  scene::SceneSnapshot moment_;
};

TEST_F(PausedRun, SpacePausesAndTheWindowSaysWhatTheClockSays) {
  RODEIRA_NEEDS_PICTURES();
  Serve();
  OpenScreen();
  EXPECT_FALSE(screen_->TakeKey(SDLK_SPACE, true)) << "nothing is shown yet";
  const Image running = Shown();
  EXPECT_TRUE(screen_->TakeKey(SDLK_SPACE, true));
  cli::AskedLine asked = NextRequest();
  EXPECT_EQ(asked.line, "toggle");
  asked.answer("ok paused at 1.500 s (step 1500)");
  const Image paused = Shown();
  EXPECT_NE(paused.rgb, running.rgb) << "it stands over the picture";
  asked = NextRequest();
  EXPECT_EQ(asked.line, "state") << "who knows who lets it go on";
  asked.answer("ok paused at 1.500 s (step 1500); driver waits for ego");
  EXPECT_EQ(Shown().rgb, paused.rgb);
  EXPECT_TRUE(screen_->TakeKey(SDLK_RETURN, true));
  while ((asked = NextRequest()).line == "state") asked.answer("ok paused at 1.500 s (step 1500)");
  EXPECT_EQ(asked.line, "step");
  asked.answer("ok 1 step from 1.500 s (step 1500)");
  moment_.time_ns += 20'000'000;
  EXPECT_EQ(Shown().rgb, running.rgb) << "time goes on";
}

TEST_F(PausedRun, WhereTheClockIsElsewhereTheWindowSaysSo) {
  RODEIRA_NEEDS_PICTURES();
  OpenScreen();
  const Image running = Shown();
  EXPECT_TRUE(screen_->TakeKey(SDLK_SPACE, false));
  EXPECT_NE(Shown().rgb, running.rgb) << "a note";
}

TEST_F(PausedRun, ARecordingsKeysAreItsOwn) {
  RODEIRA_NEEDS_PICTURES();
  Serve();
  OpenScreen();
  screen_->Show(moment_, 1.0, Timeline());
  EXPECT_FALSE(screen_->TakeKey(SDLK_SPACE, false));
  EXPECT_FALSE(screen_->TakeKey(SDLK_RETURN, false));
  EXPECT_FALSE(server_->Next().has_value());
}

// A window before its first picture: a bar as long as the way that was gone, and the title in words.
TEST(Loading, TheBarIsAsLongAsTheWay) {
  RODEIRA_NEEDS_PICTURES();
  EXPECT_EQ(LoadingTitle("Rodeira: N222", 0.3, "the ground is built"), "Rodeira: N222, 30 %: the ground is built");
  auto surface = Surface::Open(SurfaceKind::kOffscreen, 400, 100, "test");
  ASSERT_TRUE(surface.ok()) << surface.error().Text();
  const auto bright = [&] {
    std::vector<unsigned char> row(4 * 400);
    glReadPixels(0, 50, 400, 1, GL_RGBA, GL_UNSIGNED_BYTE, row.data());
    int count = 0;
    for (std::size_t x = 0; x < 400; ++x) count += row[4 * x] > 150 ? 1 : 0;
    return count;
  };
  for (const double share : {0.0, 0.25, 1.0, 7.0}) {
    DrawLoadingBar(400, 100, share);
    EXPECT_EQ(bright(), static_cast<int>(240 * std::min(share, 1.0))) << share;
  }
  glClear(GL_COLOR_BUFFER_BIT);
  EXPECT_EQ(bright(), 0) << "the whole of what comes next is cleared";
}

}  // namespace
}  // namespace rodeira::nodes
