// SPDX-License-Identifier: Apache-2.0
// The menu of a window, by a mouse of the test's, without a display.
#include <SDL.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nodes/view/frame/png.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/screen_hands.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 640, kHeight = 600;

class MenuTest : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    world_ = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
    settings_.width_px = kWidth;
    settings_.height_px = kHeight;
    settings_.instruments = false;
    settings_.quality = Quality::kLow;
    settings_.volume = 0.4;
    settings_.cars = {{0, "ego"}};
    moment_.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings_, *world_, false, "help");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    screen_ = std::move(screen).value();
  }
  Image Frame() {
    moment_.time_ns += 20'000'000;  // a window in which time stands says so
    if (recorded_) {
      screen_->Show(moment_, 1.0, Timeline());
      return screen_->renderer().Read();
    }
    return Shown(*screen_, moment_);
  }
  // Pictures that are not read: until panels have their size, and until a click has its effect.
  void ShowThree() {
    for (int i = 0; i < 3; ++i) {
      moment_.time_ns += 20'000'000;
      if (recorded_)
        screen_->Show(moment_, 1.0, Timeline());
      else
        screen_->Show(moment_, 1.0);
    }
  }
  Image Settled() {
    ShowThree();
    return Frame();
  }
  static SDL_Event MotionTo(int x_px, int y_px) {
    SDL_Event event{};
    event.type = SDL_MOUSEMOTION;
    event.motion.x = x_px;
    event.motion.y = y_px;
    return event;
  }
  bool MoveTo(int x_px, int y_px) { return screen_->TakeMouse(MotionTo(x_px, y_px)); }
  // Where this entry is: the mouse goes over another menu of the same size until it is on it. What it has met before is
  // known. The left upper corner where there is no such entry.
  Eigen::Vector2d PlaceOf(const std::string& entry) {
    MenuSight sight;
    sight.live = !recorded_;
    const auto draw = [&] { (void)other_->Draw(sight, kWidth, kHeight); };
    if (other_ == nullptr) {
      other_ = std::make_unique<Menu>();
      other_->Toggle();
      for (int i = 0; i < 3; ++i) draw();
    }
    draw();  // its panels are ImGui's current ones then
    const ImGuiID wanted = ImGui::FindWindowByName("menu")->GetID(entry.c_str());
    for (; !places_.contains(wanted) && next_y_px_ < kHeight; next_y_px_ += 4) {
      for (const int x : {kWidth - 230, kWidth - 180, kWidth - 110, kWidth - 60}) {
        if (!other_->Take(MotionTo(x, next_y_px_))) continue;
        draw();
        places_.try_emplace(ImGui::GetCurrentContext()->HoveredId, x, next_y_px_);
      }
    }
    const auto found = places_.find(wanted);
    return found == places_.end() ? Eigen::Vector2d(0.0, 0.0) : found->second;
  }
  // False where there is no such entry. Down and up come before the next picture, as a fast click does; then the mouse
  // goes away.
  bool Click(const std::string& entry) {
    const Eigen::Vector2d at = PlaceOf(entry);
    if (at.x() == 0.0) return false;
    ShowThree();
    EXPECT_TRUE(screen_->TakeMouse(MotionTo(static_cast<int>(at.x()), static_cast<int>(at.y()))));
    EXPECT_TRUE(nodes::Click(*screen_, at)) << "a click on the menu is the menu's";
    ShowThree();
    (void)MoveTo(kWidth / 4, kHeight / 2);
    return true;
  }
  void Open() {
    ASSERT_TRUE(screen_->TakeKey(SDLK_F1, true));
    ShowThree();
  }
  // What is seen now, for people, where they ask for it.
  void Keep(const char* name) {
    if (const char* pictures = std::getenv("RODEIRA_PICTURES"))
      (void)WritePng(std::filesystem::path(pictures) / name, Frame());
  }

  ViewSettings settings_;
  std::shared_ptr<const road::World> world_;
  scene::SceneSnapshot moment_;
  bool recorded_ = false;
  std::unique_ptr<ViewWindow> screen_;
  std::unique_ptr<Menu> other_;                // for PlaceOf
  std::map<ImGuiID, Eigen::Vector2d> places_;  // entries that the mouse has met on it
  int next_y_px_ = 4;
};

TEST_F(MenuTest, ItComesAndGoesByItsKeyAndLeavesThePictureAsItWas) {
  const Image bare = Frame();
  Open();
  const Image menu = Frame();
  int other = 0, elsewhere = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is = !std::equal(bare.At(x, y), bare.At(x, y) + 3, menu.At(x, y));
      other += is ? 1 : 0;
      elsewhere += is && x < kWidth - 250 ? 1 : 0;
    }
  }
  EXPECT_GT(other, 50'000);
  EXPECT_EQ(elsewhere, 0) << "the world beside it is drawn as before";
  EXPECT_TRUE(screen_->TakeKey(SDLK_F1, true));
  EXPECT_EQ(Frame().rgb, bare.rgb);
  Open();
  ASSERT_TRUE(Click("###close"));
  EXPECT_EQ(Settled().rgb, bare.rgb);
}

TEST_F(MenuTest, ACameraIsChosenByItsName) {
  Open();
  Keep("menu.png");
  ASSERT_FALSE(scene::CameraNames().empty());
  for (std::size_t i = 0; i < scene::CameraNames().size(); ++i) {
    ASSERT_TRUE(Click(std::string(scene::CameraNames()[i])));
    EXPECT_TRUE(screen_->TakeKey(SDLK_F1, true));
    const Image seen = Frame();
    Picture picture = PictureOf(settings_, moment_);
    picture.camera = static_cast<scene::CameraKind>(i);
    screen_->renderer().Draw(picture);
    EXPECT_EQ(seen.rgb, screen_->renderer().Read().rgb) << scene::CameraNames()[i];
    Open();
  }
}

// The left button is the window's own: beside the menu it chooses, on the menu it does not.
TEST_F(MenuTest, WhatIsBesideItIsTheWorlds) {
  Open();
  EXPECT_FALSE(MoveTo(100, 300));
  EXPECT_FALSE(screen_->TakeMouse(ButtonAt({100.0, 300.0}, true, SDL_BUTTON_RIGHT))) << "who drives by it";
  EXPECT_TRUE(MoveTo(kWidth - 60, 60));
  EXPECT_TRUE(screen_->TakeMouse(ButtonAt({kWidth - 60.0, 60.0}, true, SDL_BUTTON_RIGHT)));
  EXPECT_FALSE(screen_->TakeMouse(ButtonAt({kWidth - 60.0, 60.0}, false, SDL_BUTTON_RIGHT)))
      << "what was pressed elsewhere is let go of";
}

TEST_F(MenuTest, SwitchesAndTheVolumeAreThoseOfTheKeys) {
  Open();
  const auto world = [this] {  // beside the menu
    const Image all = Settled();
    std::vector<std::uint8_t> left;
    for (int y = 0; y < kHeight; ++y) left.insert(left.end(), all.At(0, y), all.At(kWidth - 250, y));
    return left;
  };
  const auto bare = world();
  for (const char* entry : {"###all keys", "###statistics"}) {
    ASSERT_TRUE(Click(entry));
    EXPECT_NE(world(), bare) << entry;
    ASSERT_TRUE(Click(entry));
    EXPECT_EQ(world(), bare) << entry;
  }
  ASSERT_TRUE(Click("###sound"));
  EXPECT_EQ(screen_->Loudness(1.0), 0.0);
  ASSERT_TRUE(Click("###sound"));
  EXPECT_EQ(screen_->Loudness(1.0), 0.4);
  ASSERT_TRUE(Click("volume"));
  EXPECT_NE(screen_->Loudness(1.0), 0.4) << "as far along the bar as the mouse was";
  EXPECT_GE(screen_->Loudness(1.0), 0.0);
  EXPECT_LE(screen_->Loudness(1.0), 1.0);
  EXPECT_FALSE(screen_->asked_to_close());
  ASSERT_TRUE(Click("###close the window"));
  EXPECT_TRUE(screen_->asked_to_close());
}

TEST_F(MenuTest, WhatChangesTheRunIsAskedFor) {
  std::vector<scenario::Request> asked;
  screen_->set_ask([&](const scenario::Request& request) {
    asked.push_back(request);
    return true;
  });
  Open();
  ASSERT_TRUE(Click("rain"));
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].argument, "rain");
  ASSERT_TRUE(Click("###back to the start"));
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[1].name, "place");
  EXPECT_EQ(asked[1].x_m, world_->start().x_m);
  ASSERT_TRUE(Click("###place the car by a click"));
  EXPECT_EQ(asked.size(), 2u) << "that click was the menu's";
  EXPECT_TRUE(nodes::Click(*screen_, {150.0, 500.0}));
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_EQ(asked[2].name, "place");
}

TEST_F(MenuTest, ARecordingsMenuChangesNoRun) {
  recorded_ = true;
  Open();
  EXPECT_FALSE(Click("###back to the start"));
  EXPECT_FALSE(Click("###pause, and go on"));
  EXPECT_FALSE(Click("rain"));
  EXPECT_TRUE(Click("###end"));
  EXPECT_TRUE(screen_->asked_to_close());
}

TEST_F(MenuTest, ItsButtonComesWhereTheMouseIsNearTheCorner) {
  const Image bare = Frame();
  EXPECT_FALSE(MoveTo(300, 300));
  EXPECT_EQ(Frame().rgb, bare.rgb);
  EXPECT_FALSE(screen_->is_restless());
  EXPECT_FALSE(MoveTo(kWidth - 20, 20));
  EXPECT_TRUE(screen_->is_restless()) << "a recording that stands still is drawn again too";
  EXPECT_NE(Settled().rgb, bare.rgb);
  EXPECT_FALSE(screen_->is_restless());
  EXPECT_FALSE(MoveTo(300, 300));
  EXPECT_EQ(Frame().rgb, bare.rgb);
  EXPECT_FALSE(MoveTo(kWidth - 40, 25));
  (void)Settled();
  EXPECT_TRUE(nodes::Click(*screen_, {kWidth - 40.0, 25.0}));
  (void)Settled();
  EXPECT_TRUE(Click("###close")) << "it is open";
}

}  // namespace
}  // namespace rodeira::nodes
