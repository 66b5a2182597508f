// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "nodes/editor/editor_app.hpp"
#include "tests/common/view/window/pushed_input.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"

namespace rodeira::nodes {

namespace pushed_input = window::pushed_input;

// A desk without a display, and a person's hands on it.
class EditorAppTest : public testing::Test {
 public:
  static constexpr double kLeft_px = 300.0, kTop_px = 19.0;  // the canvas' corner

 protected:
  void SetUp() override {
    auto made = base::TemporaryFolder::Make("desk");
    ASSERT_TRUE(made.ok());
    folder_.emplace(std::move(made).value());
    auto opened = window::Window::Open({window::Kind::kOffscreen, 1280, 800, "test"});
    if (!opened) GTEST_SKIP() << "no OpenGL here: " << opened.error().Text();
    window_ = std::move(opened).value();
    Sit();
  }
  void TearDown() override { app_.reset(); }

  void Sit(const std::filesystem::path& file = {}) {
    app_.reset();
    app_ = std::make_unique<EditorApp>(*window_, file, folder_->path() / "kept");
    Show();
  }
  // Until nothing waits any more.
  void Show() {
    for (int i = 0; i < 2000; ++i) {
      open_ = app_->Frame(0);
      if (!open_ || (!window_->busy() && !work().picture.loading())) break;
    }
    if (open_) open_ = app_->Frame(0);
  }
  Work& work() { return app_->work(); }
  const editor::Document& document() { return work().session.document(); }
  std::string Said() { return work().session.said().text; }

  std::filesystem::path At(const std::string& name) const { return folder_->path() / name; }
  // A place of the plane, in pixels of the window.
  Eigen::Vector2i On(double x_m, double y_m) {
    const Eigen::Vector2d px = work().view.ToPixels({x_m, y_m});
    return {static_cast<int>(std::lround(px.x() + kLeft_px)), static_cast<int>(std::lround(px.y() + kTop_px))};
  }
  void Drag(const Eigen::Vector2i& from, const Eigen::Vector2i& to, Uint8 button = SDL_BUTTON_LEFT) {
    pushed_input::MoveTo(from.x(), from.y());
    Show();
    pushed_input::Button(from.x(), from.y(), true, button);
    for (int i = 1; i <= 2; ++i) {
      const Eigen::Vector2i at = from + (to - from) * i / 2;
      Show();
      pushed_input::MoveTo(at.x(), at.y());
    }
    Show();
    pushed_input::Button(to.x(), to.y(), false, button);
    Show();
  }
  void Press(SDL_Scancode key, Uint16 modifiers = KMOD_NONE) {
    pushed_input::Press(key, modifiers);
    Show();
  }
  // By the wheel over the panels, until an item is seen there.
  void Reveal(const std::string& place) {
    constexpr double kLowest_px = 740.0;
    const auto seen = [&] { return work().places.contains(place) && work().places[place].y() < kLowest_px; };
    for (int i = 0; i < 40 && !seen(); ++i) {
      pushed_input::MoveTo(294, 500);
      pushed_input::Wheel(-1);
      Show();
    }
  }
  void Click(const std::string& place) {
    Reveal(place);
    ASSERT_TRUE(work().places.contains(place)) << place;
    const Eigen::Vector2d at = work().places[place];
    pushed_input::Click(static_cast<int>(at.x()), static_cast<int>(at.y()));
    Show();
  }
  // Over what stands in the field that has the keys.
  void Write(const std::string& text) {
    pushed_input::Press(SDL_SCANCODE_A, KMOD_CTRL);
    Show();
    pushed_input::Type(text);
    Show();
  }
  // One of a list that opens.
  void ChooseOne(const std::string& place, const std::string& one) {
    Click(place);
    Click(place + ": " + one);
  }
  // Into a field; it counts when the field is left.
  void Fill(const std::string& place, const std::string& text) {
    Click(place);
    Write(text);
    Press(SDL_SCANCODE_RETURN);
  }
  // On the ground.
  void ClickOn(double x_m, double y_m) {
    const Eigen::Vector2i at = On(x_m, y_m);
    pushed_input::Click(at.x(), at.y());
    Show();
  }
  void OpenTheGoodMap() {
    ASSERT_TRUE(base::WriteWhole(At("a.motors"), traffic_map::GoodMap()).ok());
    Sit(At("a.motors"));
  }
  // Writes the picture where RODEIRA_PICTURES names a folder.
  void Keep(const std::string& name) {
    const char* folder = std::getenv("RODEIRA_PICTURES");
    window::Image seen;
    app_->Frame(0, &seen);
    EXPECT_TRUE(folder == nullptr || window::WritePng(std::filesystem::path(folder) / name, seen).ok());
  }

  std::optional<base::TemporaryFolder> folder_;
  std::unique_ptr<window::Window> window_;
  std::unique_ptr<EditorApp> app_;
  bool open_ = true;
};

}  // namespace rodeira::nodes
