// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "common/core/base/temporary_folder.hpp"
#include "launch/rodeira/start_window/start_window.hpp"
#include "tests/common/view/window/pushed_input.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {

// The start window without a display, and a person's mouse and keys on it: pushed events.
class StartHands : public testing::Test {
 protected:
  static constexpr int kWidth = 820, kHeight = 640;

  void SetUp() override {
    auto opened = window::Window::Open({window::Kind::kOffscreen, kWidth, kHeight, "test"});
    if (!opened) GTEST_SKIP() << "no OpenGL here: " << opened.error().Text();
    window_ = std::move(opened).value();
    auto made = base::TemporaryFolder::Make("start");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    ::setenv("XDG_CONFIG_HOME", folder_->path().c_str(), 1);
    std::filesystem::current_path(SourceDir());
    Open("/bin/true");
  }
  void TearDown() override { ::unsetenv("XDG_CONFIG_HOME"); }

  // Recordings are looked for in this test's own folder.
  void Open(const std::string& program) {
    start_.emplace(FindStartFiles(".", folder_->path(), folder_->path() / "rodeira"), program);
  }

  window::Image Frame() {
    window::Image seen;
    do {
      EXPECT_TRUE(window_->BeginFrame(0));
      start_->Draw(kWidth, kHeight);
      window_->EndFrame(&seen);
    } while (window_->busy());
    return seen;
  }
  // A frame that handles the input and lays out the panels, but is not rendered.
  void LayOut() {
    do {
      EXPECT_TRUE(window_->BeginFrame(0));
      start_->Draw(kWidth, kHeight);
      ImGui::EndFrame();
    } while (window_->busy());
  }
  // Goes over the window with the mouse until it is on the widget of this name, and clicks there. False where there is
  // none. `in`: the panel that it is in; an opened list is "##Combo_00".
  bool Click(const char* label, const char* in = "start") {
    Frame();
    const ImGuiWindow* panel = ImGui::FindWindowByName(in);
    if (panel == nullptr) return false;
    const ImGuiID wanted = const_cast<ImGuiWindow*>(panel)->GetID(label);
    for (int y = 12; y < kHeight; y += 10) {
      for (const int x : {25, 60, 160, 300, 480, 660}) {
        window::pushed_input::MoveTo(x, y);
        LayOut();
        if (ImGui::GetCurrentContext()->HoveredId != wanted) continue;
        window::pushed_input::Click(x, y);
        Frame();
        return true;
      }
    }
    return false;
  }
  // In a field that was clicked: this in place of what stood there.
  void TypeInstead(const std::string& text) {
    window::pushed_input::Press(SDL_SCANCODE_A, KMOD_CTRL);
    Frame();
    window::pushed_input::Type(text);
    Frame();
    Frame();
  }
  // What is seen now, for people, where they ask for it.
  void Keep(const char* name) {
    if (const char* pictures = std::getenv("RODEIRA_PICTURES"))
      (void)window::WritePng(std::filesystem::path(pictures) / name, Frame());
  }

  std::unique_ptr<window::Window> window_;
  std::optional<base::TemporaryFolder> folder_;
  std::optional<StartWindow> start_;
};

}  // namespace rodeira::cli
