// SPDX-License-Identifier: Apache-2.0
// Where nothing can be drawn: a sentence that says what is missing and the status of wrong input; where a person would
// expect that, it goes on without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "nodes/view/window/render_thread.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/virtual_display.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

// Each in a process of its own: graphics libraries look round once.
class NoGl : public ::testing::Test {
 protected:
  void SetUp() override {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    settings_.width_px = 320;
    settings_.height_px = 180;
  }
  // Opens what draws a run, says what it answers and ends with that status; 0 and "nothing is drawn" where it goes on
  // without.
  [[noreturn]] void Open() {
    auto render_thread =
        RenderThread::Open(settings_, road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value());
    std::fprintf(stderr, "%s\n",
                 !render_thread.ok()                ? render_thread.error().Text().c_str()
                 : render_thread.value() == nullptr ? "nothing is drawn"
                                                    : "it draws");
    std::_Exit(render_thread.ok() ? 0 : render_thread.error().exit_status());
  }
  static void WithoutRenderer() {
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    ::setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nobody/here", 1);
  }

  ViewSettings settings_;
};

TEST_F(NoGl, PicturesForFilesWantARenderer) {
  settings_.frame_steps = {10};
  EXPECT_EXIT((WithoutRenderer(), Open()), testing::ExitedWithCode(2), "OpenGL.*the package.* expected");
}

TEST_F(NoGl, AWindowThatMustBeWantsADisplay) {
  settings_.window = WindowMode::kAlways;
  EXPECT_EXIT((WithoutRenderer(), Open()), testing::ExitedWithCode(2), "no display.*--headless");
}

TEST_F(NoGl, AWindowThatMayBeIsLeftOut) {
  settings_.window = WindowMode::kAuto;
  EXPECT_EXIT((WithoutRenderer(), Open()), testing::ExitedWithCode(0), "nothing is drawn");
}

class DisplayWithoutGl : public NoGl {
 protected:
  // An X server that has no OpenGL to offer.
  [[noreturn]] void OpenThere() {
    const VirtualDisplay display({"-extension", "GLX"});
    ::setenv("SDL_VIDEO_X11_FORCE_EGL", "0", 1);
    Open();
  }
  void SetUp() override {
    NoGl::SetUp();
    if (std::system("command -v Xvfb >/dev/null 2>&1") != 0) GTEST_SKIP() << "the package xvfb is not there";
  }
};

TEST_F(DisplayWithoutGl, AWindowThatMustBeIsRefused) {
  settings_.window = WindowMode::kAlways;
  EXPECT_EXIT(OpenThere(), testing::ExitedWithCode(2),
              "no OpenGL context can be made \\(.+\\); the package libgl1-mesa-dri was expected");
}

TEST_F(DisplayWithoutGl, AWindowThatMayBeIsLeftOut) {
  settings_.window = WindowMode::kAuto;
  EXPECT_EXIT(OpenThere(), testing::ExitedWithCode(0), "nothing is drawn");
}

// A display without OpenGL is as good as none: pictures for files are drawn beside it.
TEST_F(DisplayWithoutGl, PicturesForFilesAreDrawnAllTheSame) {
  RODEIRA_NEEDS_PICTURES();
  settings_.frame_steps = {10};
  EXPECT_EXIT(OpenThere(), testing::ExitedWithCode(0), "it draws");
}

}  // namespace
}  // namespace rodeira::nodes
