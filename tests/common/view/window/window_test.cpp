// SPDX-License-Identifier: Apache-2.0
// A window without a display: panels obey pushed events, pictures show them.
#include "common/view/window/window.hpp"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/common/view/window/pushed_input.hpp"

namespace rodeira::window {
namespace {

constexpr int kWidth = 320, kHeight = 200;

class AWindow : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = Window::Open({Kind::kOffscreen, kWidth, kHeight, "test"});
    if (!opened) GTEST_SKIP() << "no OpenGL here: " << opened.error().Text();
    window_ = std::move(opened).value();
  }
  // Draws until no event waits; the panels are drawn by `draw`.
  template <class Draw>
  Image Show(const Draw& draw) {
    Image seen;
    do {
      open_ = window_->BeginFrame(0);
      if (!open_) return seen;
      draw();
      window_->EndFrame(&seen);
    } while (window_->busy());
    return seen;
  }
  std::unique_ptr<Window> window_;
  bool open_ = true;
};

void Panel(int& clicks, char* text, std::size_t size) {
  ImGui::SetNextWindowPos(ImVec2(0.0f, 0.0f));
  ImGui::SetNextWindowSize(ImVec2(200.0f, 120.0f));
  ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
  ImGui::SetCursorPos(ImVec2(10.0f, 10.0f));
  if (ImGui::Button("press", ImVec2(80.0f, 30.0f))) ++clicks;
  ImGui::SetCursorPos(ImVec2(10.0f, 60.0f));
  ImGui::InputText("##text", text, size);
  ImGui::End();
}

TEST_F(AWindow, ClicksAndLettersArriveHoweverFastTheyCome) {
  int clicks = 0;
  char text[32] = "";
  const auto draw = [&] { Panel(clicks, text, sizeof(text)); };
  Show(draw);
  pushed_input::Click(40, 25);
  pushed_input::Click(40, 25);
  pushed_input::Click(300, 190);  // beside it
  pushed_input::Click(40, 70);
  pushed_input::Type("N222");
  pushed_input::Press(SDL_SCANCODE_BACKSPACE);
  Show(draw);
  Show(draw);
  EXPECT_EQ(clicks, 2);
  EXPECT_STREQ(text, "N22");
}

TEST_F(AWindow, WhatIsDrawnIsReadFromTheTop) {
  const Image seen = Show([] {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(ImVec2(10.0f, 20.0f), ImVec2(60.0f, 40.0f), IM_COL32(255, 0, 0, 255));
  });
  ASSERT_EQ(seen.width_px, kWidth);
  ASSERT_EQ(seen.height_px, kHeight);
  int red = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::uint8_t* pixel = seen.At(x, y);
      const bool inside = x >= 10 && x < 60 && y >= 20 && y < 40;
      const bool is_red = pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 0;
      if (is_red) ++red;
      EXPECT_TRUE(inside || !is_red) << x << " " << y;
      const bool deep_inside = x > 11 && x < 58 && y > 21 && y < 38;
      EXPECT_TRUE(is_red || !deep_inside) << x << " " << y;
    }
  }
  EXPECT_NEAR(red, 50 * 20, 2 * 70);
}

TEST_F(AWindow, ClosingIsToldAndCanBeRefused) {
  SDL_Event event{};
  event.type = SDL_QUIT;
  SDL_PushEvent(&event);
  EXPECT_FALSE(window_->BeginFrame(0));
  window_->StayOpen();
  Show([] {});
  EXPECT_TRUE(open_);
}

TEST_F(AWindow, APictureIsWrittenAsPng) {
  const Image seen = Show([] {
    ImGui::GetBackgroundDrawList()->AddCircleFilled(ImVec2(100.0f, 100.0f), 30.0f, IM_COL32(0, 90, 200, 255));
  });
  auto folder = base::TemporaryFolder::Make("window");
  ASSERT_TRUE(folder.ok());
  const auto path = folder.value().path() / "seen.png";
  ASSERT_TRUE(WritePng(path, seen).ok());
  const auto bytes = base::ReadText(path);
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(bytes.value().substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_FALSE(WritePng("/dev/null/seen.png", seen).ok());
}

// The picture of one word.
Image Written(const std::filesystem::path& font, const char* word) {
  auto opened = Window::Open({Kind::kOffscreen, 120, 40, "test", font});
  if (!opened) return {};
  Image seen;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(opened.value()->BeginFrame(0));
    ImGui::GetBackgroundDrawList()->AddText(ImVec2(8.0f, 8.0f), IM_COL32(255, 255, 255, 255), word);
    opened.value()->EndFrame(&seen);
  }
  return seen;
}

TEST_F(AWindow, GreekAndPortugueseAreWritten) {
  window_.reset();
  if (FontFile().empty()) GTEST_SKIP() << "the package fonts-dejavu-core is not here";
  // No two words look alike, as they would with a mark in place of letters that the font lacks.
  const char* words[] = {"Οδός",  "Πάτρα", "πάτρα", "ὁδός", "São João", "Sao Joao", "Coruña",
                         "Город", "a → b", "…",     "??",   "????",     "?????"};
  std::vector<Image> pictures;
  for (const char* word : words) pictures.push_back(Written(FontFile(), word));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(pictures[i], pictures[j]) << words[i] << " " << words[j];
  }
}

TEST_F(AWindow, WithoutTheFontItsOwnLettersAreThere) {
  window_.reset();
  auto folder = base::TemporaryFolder::Make("font");
  ASSERT_TRUE(folder.ok());
  for (const std::filesystem::path& font :
       {std::filesystem::path(), folder.value().path() / "none.ttf", folder.value().path()}) {
    EXPECT_NE(Written(font, "road"), Written(font, "lane")) << font;
    EXPECT_NE(Written(font, "São"), Written(font, "Sao")) << font;
    EXPECT_EQ(Written(font, "ω"), Written(font, "ψ")) << font;
  }
}

TEST(Window, WithoutADisplayThereIsASentence) {
  const char* names[] = {"DISPLAY", "WAYLAND_DISPLAY"};
  std::string kept[2];
  for (int i = 0; i < 2; ++i)
    kept[i] = std::getenv(names[i]) != nullptr ? std::getenv(names[i]) : "", ::unsetenv(names[i]);
  const auto opened = Window::Open({Kind::kWindow, kWidth, kHeight, "test"});
  for (int i = 0; i < 2; ++i) {
    if (!kept[i].empty()) ::setenv(names[i], kept[i].c_str(), 1);
  }
  ASSERT_FALSE(opened.ok());
  EXPECT_EQ(opened.error().Text(), "a window is requested, but there is no display; set DISPLAY");
  EXPECT_EQ(opened.error().exit_status(), 2);
}

TEST(Window, ADisplayThatDoesNotAnswerIsNamed) {
  const char* set = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  const std::string kept = set != nullptr ? set : "", kept_wayland = wayland != nullptr ? wayland : "";
  ::unsetenv("WAYLAND_DISPLAY");
  ::setenv("DISPLAY", ":5517", 1);  // no display has such a number
  const auto opened = Window::Open({Kind::kWindow, kWidth, kHeight, "test"});
  if (kept.empty())
    ::unsetenv("DISPLAY");
  else
    ::setenv("DISPLAY", kept.c_str(), 1);
  if (!kept_wayland.empty()) ::setenv("WAYLAND_DISPLAY", kept_wayland.c_str(), 1);
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.error().Text().find("no display answers (DISPLAY=:5517"), std::string::npos)
      << opened.error().Text();
  EXPECT_EQ(opened.error().exit_status(), 2);
}

}  // namespace
}  // namespace rodeira::window
