// SPDX-License-Identifier: Apache-2.0
// A window before its world is read: it is open, says that it reads, and handles its events.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "common/core/base/temporary_folder.hpp"
#include "nodes/view/playback/replay_window.hpp"
#include "nodes/view/window/loading.hpp"
#include "nodes/view/window/render_thread.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/virtual_display.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

using namespace std::chrono_literals;

class Reading : public testing::Test {
 protected:
  void SetUp() override {
    settings_.width_px = 320;
    settings_.height_px = 180;
    settings_.window = WindowMode::kAlways;
    settings_.sound = false;
    if (!display_.there()) GTEST_SKIP() << "the package xvfb is not there";
    auto surface = OpenSurface(SurfaceKind::kWindow, settings_, true);
    if (!surface.ok()) GTEST_SKIP() << "no OpenGL here: " << surface.error().Text();
  }
  // Where bright pixels are on the display's middle row, which is the window's, from left to right: an XWD file that
  // the server writes as it draws.
  std::vector<int> Bright() const {
    std::ifstream file(folder_.path() / "Xvfb_screen0", std::ios::binary);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    const auto word = [&](std::size_t number) {
      return static_cast<std::size_t>(bytes[4 * number] << 24 | bytes[4 * number + 1] << 16 |
                                      bytes[4 * number + 2] << 8 | bytes[4 * number + 3]);
    };
    constexpr std::size_t kHeaderSize = 0, kPitch = 12, kColours = 19;
    if (bytes.size() < 100) return {};
    const std::size_t row = word(kHeaderSize) + 12 * word(kColours) + 240 * word(kPitch);
    std::vector<int> bright;
    for (std::size_t x = 0; x < 640 && row + 4 * x < bytes.size(); ++x) {
      if (bytes[row + 4 * x] > 150) bright.push_back(static_cast<int>(x));
    }
    return bright;
  }
  // Reads nothing until the bar has been seen, and a piece of it that moves; what was seen stands in `seen_`.
  base::Result<ReadWorld> LookAtTheBar() {
    const auto end = std::chrono::steady_clock::now() + 20s;
    for (std::vector<int> now; std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(10ms)) {
      now = Bright();
      if (now.size() != kPiece_px) continue;
      if (!seen_.empty() && now.front() != seen_.front()) {
        moved_ = true;
        break;
      }
      seen_ = now;
    }
    return ReadWorld{road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value(), {}};
  }

  static constexpr std::size_t kPiece_px = 38;  // a fifth of 192, six tenths of the window's width; between two columns
  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("reading").value();
  VirtualDisplay display_{{"-fbdir", folder_.path().string()}};
  ViewSettings settings_;
  std::vector<int> seen_;
  bool moved_ = false;
};

TEST_F(Reading, ARunsWindowIsThereBeforeItsWorldIs) {
  const auto render_thread = RenderThread::Open(settings_, [this] { return LookAtTheBar(); });
  ASSERT_TRUE(render_thread.ok()) << render_thread.error().Text();
  EXPECT_FALSE(seen_.empty());
  EXPECT_TRUE(moved_);
  ASSERT_NE(render_thread.value(), nullptr);
  EXPECT_TRUE(render_thread.value()->has_window());
}

TEST_F(Reading, ARecordingsWindowIsThereBeforeItsWorldIs) {
  const auto window = ReplayWindow::Open(settings_, [this] { return LookAtTheBar(); });
  ASSERT_TRUE(window.ok()) << window.error().Text();
  EXPECT_FALSE(seen_.empty());
  EXPECT_TRUE(moved_);
}

TEST_F(Reading, WhatIsWrongWithTheWorldIsTheAnswer) {
  const auto reader = [&]() -> base::Result<ReadWorld> {
    (void)LookAtTheBar();
    return base::WrongInput("file.not_found", "there is no such world");
  };
  const auto render_thread = RenderThread::Open(settings_, reader);
  ASSERT_FALSE(render_thread.ok());
  EXPECT_EQ(render_thread.error().Text(), "there is no such world");
  EXPECT_EQ(render_thread.error().exit_status(), 2);
}

// Where a window must be and cannot, no world is waited for.
TEST(ReadingNothing, WithoutADisplay) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  ViewSettings settings;
  settings.window = WindowMode::kAlways;
  bool asked = false;
  const auto render_thread = RenderThread::Open(settings, [&]() -> base::Result<ReadWorld> {
    asked = true;
    return base::WrongInput("file.cannot_read", "read");
  });
  EXPECT_FALSE(render_thread.ok());
  EXPECT_FALSE(asked);
}

TEST(ReadingTitle, SaysHowLongItHasTaken) {
  EXPECT_EQ(WorkTitle("Rodeira", 2.9, "the world is read"), "Rodeira, 2 s: the world is read");
}

}  // namespace
}  // namespace rodeira::nodes
