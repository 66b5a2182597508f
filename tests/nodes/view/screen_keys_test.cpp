// SPDX-License-Identifier: Apache-2.0
// The keys of a run's window that only show, and the legend of what is shown over the ground. Without a display.
#include <SDL.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "nodes/view/overlays/heat_node.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/screen_hands.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

class ScreenKeys : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    world_ = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
    settings_.width_px = 640;
    settings_.height_px = 360;
    settings_.instruments = false;
    moment_.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
    Open(false);
  }
  void Open(bool resizable) {
    screen_.reset();
    auto screen =
        ViewWindow::Open(SurfaceKind::kOffscreen, settings_, *world_, resizable, "first line of help\nand another");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    screen_ = std::move(screen).value();
  }
  Image Shown() { return nodes::Shown(*screen_, moment_); }
  bool Press(int symbol, bool driven = true) { return screen_->TakeKey(symbol, driven); }
  // How many pixels of the upper left corner, where lines of text stand, are not as they were.
  static int Written(const Image& before, const Image& after) {
    int written = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 320; ++x) written += std::equal(before.At(x, y), before.At(x, y) + 3, after.At(x, y)) ? 0 : 1;
    }
    return written;
  }

  ViewSettings settings_;
  std::shared_ptr<const road::World> world_;
  scene::SceneSnapshot moment_;
  std::unique_ptr<ViewWindow> screen_;
};

TEST_F(ScreenKeys, HelpAndStatisticsComeAndGo) {
  const Image bare = Shown();
  ASSERT_TRUE(Press(SDLK_h));
  EXPECT_GT(Written(bare, Shown()), 500);
  ASSERT_TRUE(Press(SDLK_h));
  EXPECT_EQ(Shown().rgb, bare.rgb);
  ASSERT_TRUE(Press(SDLK_F3));
  EXPECT_GT(Written(bare, Shown()), 500);
  EXPECT_FALSE(Press(SDLK_s, true)) << "the brake of who drives";
  EXPECT_TRUE(Press(SDLK_s, false));
  EXPECT_EQ(Shown().rgb, bare.rgb);
}

// Each press is the next of the kinds, and the picture is that of its camera.
TEST_F(ScreenKeys, TheCameraGoesRound) {
  std::set<std::vector<std::uint8_t>> seen;
  for (std::size_t i = 0; i < scene::CameraNames().size(); ++i) {
    Picture picture = PictureOf(settings_, moment_);
    picture.camera = static_cast<scene::CameraKind>(i);
    screen_->renderer().Draw(picture);
    const auto expected = screen_->renderer().Read().rgb;
    EXPECT_EQ(Shown().rgb, expected) << scene::CameraNames()[i];
    seen.insert(expected);
    EXPECT_TRUE(Press(SDLK_k));
  }
  EXPECT_EQ(seen.size(), scene::CameraNames().size());
  EXPECT_TRUE(seen.contains(Shown().rgb)) << "and from the first on again";
}

TEST_F(ScreenKeys, AWindowOfWhichNoFramesAreReadFillsTheScreenAndComesBack) {
  const auto is_full = [] { return (SDL_GetWindowFlags(SDL_GL_GetCurrentWindow()) & SDL_WINDOW_FULLSCREEN) != 0; };
  EXPECT_TRUE(Press(SDLK_f));
  EXPECT_FALSE(is_full()) << "its size is that of its frames";
  Open(true);
  EXPECT_FALSE(is_full());
  EXPECT_TRUE(Press(SDLK_f));
  EXPECT_TRUE(is_full());
  EXPECT_TRUE(Press(SDLK_f));
  EXPECT_FALSE(is_full());
}

TEST_F(ScreenKeys, SoundIsAsLoudAsItWasToldAndSwitchedOffAndOn) {
  settings_.volume = 0.4;
  Open(false);
  EXPECT_EQ(screen_->Loudness(1.0), 0.4);
  EXPECT_EQ(screen_->Loudness(-2.0), 0.4) << "of a recording that goes backward";
  EXPECT_EQ(screen_->Loudness(0.5), 0.2);
  EXPECT_EQ(screen_->Loudness(0.0), 0.0);
  EXPECT_TRUE(Press(SDLK_F5));
  EXPECT_EQ(screen_->Loudness(1.0), 0.0);
  EXPECT_TRUE(Press(SDLK_F5));
  EXPECT_EQ(screen_->Loudness(1.0), 0.4);
  EXPECT_TRUE(Press(SDLK_F11));
  EXPECT_NEAR(screen_->Loudness(1.0), 0.5, 1e-12);
  EXPECT_TRUE(Press(SDLK_F10));
  EXPECT_TRUE(Press(SDLK_F10));
  EXPECT_NEAR(screen_->Loudness(1.0), 0.3, 1e-12);
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(Press(SDLK_F10));
  EXPECT_EQ(screen_->Loudness(1.0), 0.0);
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(Press(SDLK_F11));
  EXPECT_EQ(screen_->Loudness(1.0), 1.0) << "no louder";
  EXPECT_TRUE(Press(SDLK_F5));
  EXPECT_TRUE(Press(SDLK_F10));
  EXPECT_NEAR(screen_->Loudness(1.0), 0.9, 1e-12) << "who turns it down hears it";
  const Image quiet = Shown();
  EXPECT_TRUE(Press(SDLK_F10));
  EXPECT_GT(Written(quiet, Shown()), 50) << "the window says how loud";
  settings_.sound = false;
  Open(false);
  EXPECT_EQ(screen_->Loudness(1.0), 0.0);
  EXPECT_TRUE(Press(SDLK_F5));
  EXPECT_TRUE(Press(SDLK_F5));
  EXPECT_TRUE(Press(SDLK_F11));
  EXPECT_EQ(screen_->Loudness(1.0), 0.0) << "a window that was told to be silent";
}

TEST(HeatLegend, SaysWhatTheColoursMean) {
  const auto legend = [](scene::HeatKind kind) {
    const HeatLegend all = LegendOf({kind, 12.4, {}});
    return all.title + ": " + all.low + " " + all.middle + " " + all.high;
  };
  EXPECT_EQ(legend(scene::HeatKind::kSpeed), "speed, % of the limit, of 12 s: 0 50 100");
  EXPECT_EQ(legend(scene::HeatKind::kFlow), "flow, vehicles/h, of 12 s: 0 900 1800");
  EXPECT_EQ(legend(scene::HeatKind::kDensity), "density, vehicles/km, of 12 s: 80 40 0");
  EXPECT_EQ(legend(scene::HeatKind::kFuel), "fuel, l/100 km, of 12 s: 20 10 0");
}

// The bar goes from red through yellow to green; each statistic has its own legend, and behind the last there is none.
TEST_F(ScreenKeys, EachStatisticHasItsLegend) {
  const Image bare = Shown();
  const auto bar = [](const Image& image, int x) {
    return ProbeAt(image, 0.5 * x, 0.5 * 157, 0);
  };  // in half the size at which panels are laid out
  std::set<std::vector<std::uint8_t>> legends;
  for (std::size_t i = 0; i < scene::kHeatKinds; ++i) {
    ASSERT_TRUE(Press(SDLK_F8));
    moment_.time_ns += 20'000'000;
    const Image image = Shown();
    const Probe red = bar(image, 32), yellow = bar(image, 208), green = bar(image, 384);
    EXPECT_TRUE(red.red > 200.0 && red.green < 40.0 && red.blue < 20.0) << red;
    EXPECT_TRUE(yellow.red > 200.0 && yellow.green > 200.0 && yellow.blue < 20.0) << yellow;
    EXPECT_TRUE(green.red < 40.0 && green.green > 200.0 && green.blue < 20.0) << green;
    legends.insert(std::vector<std::uint8_t>(image.At(0, 60), image.At(0, 96)));
  }
  EXPECT_EQ(legends.size(), scene::kHeatKinds);
  ASSERT_TRUE(Press(SDLK_F8));
  const Probe none = bar(Shown(), 32);
  EXPECT_FALSE(none.red > 200.0 && none.green < 40.0) << none;
  EXPECT_NEAR(none.red, bar(bare, 32).red, 2.0);
}

}  // namespace
}  // namespace rodeira::nodes
