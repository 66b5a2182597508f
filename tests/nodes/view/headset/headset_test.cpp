// SPDX-License-Identifier: Apache-2.0
// Two eyes through OpenXR's own loader and a runtime that keeps what it is shown (fake_openxr.cpp). Where something
// must be seen follows from OpenXR's words alone: a pose, angles to the edges, a metre is a metre.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <thread>

#include "common/runtime/launch/live_keys.hpp"
#include "nodes/view/window/render_thread.hpp"
#include "nodes/view/window/view_window.hpp"
#include "tests/nodes/view/headset/fake_headset.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/nodes/view/virtual_display.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

FakeHeadset& Fake() {
  static auto* const ask =
      reinterpret_cast<FakeHeadset* (*)()>(::dlsym(::dlopen(FAKE_OPENXR, RTLD_NOW), "rodeira_fake_headset"));
  return *ask();
}

XrFovf Edges(double left_deg, double right_deg, double up_deg, double down_deg) {
  const auto rad = [](double deg) { return static_cast<float>(deg * kDegree); };
  return {rad(left_deg), rad(right_deg), rad(up_deg), rad(down_deg)};
}

class InTheHeadset : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    ::setenv("XR_RUNTIME_JSON", FAKE_OPENXR_MANIFEST, 1);
    std::destroy_at(&Fake());
    std::construct_at(&Fake());
    Fake().views[0].fov = Edges(-50.0, 35.0, 40.0, -45.0);
    Fake().views[1].fov = Edges(-35.0, 50.0, 40.0, -45.0);
    SetHead({0.0, 0.0, 0.0}, 0.0);
    world_ = road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value();
    settings_.width_px = 320;
    settings_.height_px = 180;
    settings_.headset = true;
    settings_.quality = Quality::kMedium;
    settings_.cabin = false;
    moment_.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
    scene::AgentPose agent;
    agent.id = 5;
    agent.colour = scene::Colour::Of(0xd010c0);
    agent.p_WB_W = moment_.cars[0].p_WB_W + moment_.cars[0].q_WB * Eigen::Vector3d(kAhead_m, kLeft_m, 0.0);
    agent.q_WB = moment_.cars[0].q_WB;
    moment_.agents.push_back(agent);
  }
  void TearDown() override { ::unsetenv("XR_RUNTIME_JSON"); }

  // In OpenXR's axes: right, up, backward; turned to the left about the vertical.
  static void SetHead(const Eigen::Vector3f& middle, double left_rad) {
    const auto sine = static_cast<float>(std::sin(0.5 * left_rad)),
               cosine = static_cast<float>(std::cos(0.5 * left_rad));
    for (int i = 0; i < 2; ++i) {
      const float aside = (i == 0 ? -0.5F : 0.5F) * kApart_m;
      Fake().views[static_cast<std::size_t>(i)].pose = {
          {0.0F, sine, 0.0F, cosine},
          {middle.x() + aside * static_cast<float>(std::cos(left_rad)), middle.y(),
           middle.z() - aside * static_cast<float>(std::sin(left_rad))}};
    }
  }
  std::unique_ptr<ViewWindow> Opened() {
    auto screen = ViewWindow::Open(SurfaceKind::kOffscreen, settings_, *world_, false, "help");
    EXPECT_TRUE(screen.ok());
    return std::move(screen).value();
  }
  // Edges of an eye's picture, at a metre's depth: left, right, low, high.
  static Eigen::Vector4d TangentsOf(std::size_t eye) {
    const XrFovf& view = Fake().views[eye].fov;
    return Eigen::Vector4d(static_cast<double>(view.angleLeft), static_cast<double>(view.angleRight),
                           static_cast<double>(view.angleDown), static_cast<double>(view.angleUp))
        .array()
        .tan();
  }
  static const std::uint8_t* PixelOf(std::size_t eye, int x, int row) {
    return &Fake().rgba[eye][static_cast<std::size_t>(4 * ((Fake().height_px - 1 - row) * Fake().width_px + x))];
  }
  // The row, from the top, of something so far ahead of an eye that is level and to that height over it.
  static double Row(std::size_t eye, double ahead_m, double up_m) {
    const Eigen::Vector4d tangents = TangentsOf(eye);
    return Fake().height_px * (tangents[3] - up_m / ahead_m) / (tangents[3] - tangents[2]);
  }
  // The column midway between the edges of the other car, between its bumper and its window, where only its tail is
  // seen, so far ahead.
  static double TailColumn(std::size_t eye, double ahead_m) {
    double sum = 0.0, rows = 0.0;
    for (int row = static_cast<int>(Row(eye, ahead_m, 0.80 - 1.20));
         row <= static_cast<int>(Row(eye, ahead_m, 0.60 - 1.20)); ++row) {
      int first = -1, last = -1;
      for (int x = 0; x < Fake().width_px; ++x) {
        const std::uint8_t* pixel = PixelOf(eye, x, row);
        if (pixel[0] < 60 || pixel[0] < 2 * pixel[1]) continue;  // its paint or its lamps
        first = first < 0 ? x : first;
        last = x;
      }
      if (first < 0) continue;
      sum += 0.5 * (first + last + 1);
      ++rows;
    }
    EXPECT_GT(rows, 1.0) << "the car ahead is not seen";
    return sum / std::max(rows, 1.0);
  }
  // The column in which something lies that is so far ahead of that eye and to its left, by the angles of OpenXR.
  static double Column(std::size_t eye, double ahead_m, double left_m) {
    const Eigen::Vector4d tangents = TangentsOf(eye);
    return Fake().width_px * (-left_m / ahead_m - tangents[0]) / (tangents[1] - tangents[0]);
  }

  static constexpr double kAhead_m = 12.0, kLeft_m = 0.36;  // of the car's middle; its tail is two metres nearer
  static constexpr double kTail_m = kAhead_m - 2.0 - 0.10,
                          kTailLeft_m =
                              kLeft_m - 0.22 * 1.65;  // from the driver's eye, which sits there in its own car
  static constexpr float kApart_m = 0.5F;
  std::shared_ptr<const road::World> world_;
  ViewSettings settings_;
  scene::SceneSnapshot moment_;
};

TEST_F(InTheHeadset, TheEyesDifferByTheirDistanceAndTheirFrusta) {
  const auto screen = Opened();
  ASSERT_TRUE(screen->has_headset());
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  EXPECT_EQ(Fake().frames, 1);
  ASSERT_EQ(Fake().layers, 1);
  EXPECT_EQ(Fake().wrong, 0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    EXPECT_EQ(Fake().said[eye].fov.angleLeft, Fake().views[eye].fov.angleLeft);
    EXPECT_EQ(Fake().said[eye].pose.position.x, Fake().views[eye].pose.position.x);
  }
  const double left = TailColumn(0, kTail_m), right = TailColumn(1, kTail_m),
               half_m = 0.5 * static_cast<double>(kApart_m);
  EXPECT_NEAR(left, Column(0, kTail_m, kTailLeft_m - half_m), 1.0);
  EXPECT_NEAR(right, Column(1, kTail_m, kTailLeft_m + half_m), 1.0);
  // What both frusta would make of one eye in the middle, and the parallax, which is eight pixels here.
  const double one_eye = Column(0, kTail_m, kTailLeft_m) - Column(1, kTail_m, kTailLeft_m),
               tangents = TangentsOf(0)[1] - TangentsOf(0)[0];
  EXPECT_NEAR(left - right - one_eye, Fake().width_px / tangents * static_cast<double>(kApart_m) / kTail_m, 0.8);
  // The horizon of the plane, where the upper and lower edge put it.
  int horizon = 0;
  while (horizon < Fake().height_px && PixelOf(0, 20, horizon)[2] > PixelOf(0, 20, horizon)[0] + 8) ++horizon;
  EXPECT_NEAR(horizon, Row(0, 1e6, 0.0), 3.0);
}

TEST_F(InTheHeadset, TheHeadMovesAndTurnsInTheCar) {
  const auto screen = Opened();
  const double aside_m = 0.4, forward_m = 1.5, turn_rad = 12.0 * kDegree;
  SetHead({static_cast<float>(aside_m), 0.0F, static_cast<float>(-forward_m)}, turn_rad);
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  const double ahead_m = kTail_m - forward_m, left_m = kTailLeft_m + aside_m;
  const double turned_ahead_m = std::cos(turn_rad) * ahead_m + std::sin(turn_rad) * left_m,
               turned_left_m = std::cos(turn_rad) * left_m - std::sin(turn_rad) * ahead_m;
  const double half_m = 0.5 * static_cast<double>(kApart_m);
  EXPECT_NEAR(TailColumn(0, turned_ahead_m), Column(0, turned_ahead_m, turned_left_m - half_m), 2.0);
  EXPECT_NEAR(TailColumn(1, turned_ahead_m), Column(1, turned_ahead_m, turned_left_m + half_m), 2.0);

  // The whole street turned and moved, car and all: nothing is seen of it inside.
  const auto before = Fake().rgba;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()));
  for (auto* body : {&moment_.cars[0].p_WB_W, &moment_.agents[0].p_WB_W})
    *body = turn * *body + Eigen::Vector3d(-40.0, 25.0, 0.0);
  moment_.cars[0].q_WB = turn * moment_.cars[0].q_WB;
  moment_.agents[0].q_WB = turn * moment_.agents[0].q_WB;
  const double left = TailColumn(0, turned_ahead_m);
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  EXPECT_NE(Fake().rgba, before) << "the sun stands elsewhere";
  EXPECT_NEAR(TailColumn(0, turned_ahead_m), left, 1.0);
}

// The window's own camera, texts and mirrors stay the window's.
TEST_F(InTheHeadset, TheWindowGoesOnAsWithoutOne) {
  settings_.headset = false;
  Image without;
  {
    const auto screen = Opened();
    EXPECT_FALSE(screen->WaitForHeadset());
    screen->Show(moment_, 1.0);
    without = screen->renderer().Read();
  }
  settings_.headset = true;
  const auto screen = Opened();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(screen->WaitForHeadset());
    screen->Show(moment_, 1.0);
    EXPECT_EQ(screen->renderer().Read().rgb, without.rgb) << i;
  }
  EXPECT_EQ(Fake().frames, 3);
}

TEST_F(InTheHeadset, ItIsTakenOffAndTheWindowGoesOn) {
  {
    const auto screen = Opened();
    ASSERT_TRUE(screen->WaitForHeadset());
    screen->Show(moment_, 1.0);
    Fake().takes_off = true;
    testing::internal::CaptureStderr();
    EXPECT_FALSE(screen->WaitForHeadset());
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "rodeira: warning: the headset was asked to show something else\n");
    EXPECT_FALSE(screen->has_headset());
    screen->Show(moment_, 1.0);
    EXPECT_EQ(Fake().frames, 1);
  }
  EXPECT_EQ(Fake().living, 0);
  EXPECT_EQ(Fake().wrong, 0);
}

TEST_F(InTheHeadset, ALostOneIsNamed) {
  const auto screen = Opened();
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  Fake().loses_frames = true;
  testing::internal::CaptureStderr();
  EXPECT_FALSE(screen->WaitForHeadset());
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "rodeira: warning: the headset shows nothing more (xrWaitFrame: XR_ERROR_SESSION_LOST)\n");
  screen->Show(moment_, 1.0);
  EXPECT_EQ(Fake().living, 0);
}

// Nothing is drawn for a head at an unknown place; the frame is ended all the same.
TEST_F(InTheHeadset, ThePlaceOfTheHeadIsUnknown) {
  const auto screen = Opened();
  Fake().knows_where = false;
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  EXPECT_EQ(Fake().frames, 1);
  EXPECT_EQ(Fake().layers, 0);
  Fake().knows_where = true;
  ASSERT_TRUE(screen->WaitForHeadset());
  screen->Show(moment_, 1.0);
  EXPECT_EQ(Fake().layers, 1);
}

// A sentence, and it goes on on the screen.
TEST_F(InTheHeadset, WithoutOneThereIsASentence) {
  const auto said = [&] {
    testing::internal::CaptureStderr();
    const auto screen = Opened();
    EXPECT_FALSE(screen->has_headset());
    EXPECT_FALSE(screen->WaitForHeadset());
    screen->Show(moment_, 1.0);
    return testing::internal::GetCapturedStderr();
  };
  Fake().plugged_in = false;
  EXPECT_THAT(said(),
              testing::HasSubstr("rodeira: warning: no headset: this PC's OpenXR runtime has no headset (xrGetSystem: "
                                 "XR_ERROR_FORM_FACTOR_UNAVAILABLE); one that is plugged in and switched on "
                                 "was expected; shown in the window alone\n"));
  EXPECT_EQ(Fake().living, 0);
}

// In a process of its own: OpenXR's loader looks for its runtime once.
TEST_F(InTheHeadset, WithoutARuntimeOrItsOpenGlThereIsASentence) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto open = [&] {
    const auto screen = Opened();
    const bool goes_on = !screen->has_headset() && !screen->WaitForHeadset();
    screen->Show(moment_, 1.0);
    std::exit(goes_on ? 0 : 1);
  };
  Fake().egl = false;
  EXPECT_EXIT(open(), testing::ExitedWithCode(0),
              "no headset: this PC's OpenXR runtime does not offer XR_MNDX_egl_enable");
  ::setenv("XR_RUNTIME_JSON", "/nobody/here.json", 1);
  EXPECT_EXIT(open(), testing::ExitedWithCode(0), "no headset: no OpenXR runtime answers on this PC");
}

// A window of X11 on a display of its own: the runtime gets that window's context, and shows what it shows without a
// display.
TEST_F(InTheHeadset, InAWindowOfX11) {
  ::unsetenv("WAYLAND_DISPLAY");
  std::array<std::vector<std::uint8_t>, 2> without;
  {
    const auto screen = Opened();
    ASSERT_TRUE(screen->WaitForHeadset());
    screen->Show(moment_, 1.0);
    without = Fake().rgba;
    EXPECT_FALSE(Fake().by_glx);
  }
  const VirtualDisplay display;
  if (!display.there()) GTEST_SKIP() << "the package xvfb is not there";
  Fake().egl = false;  // it is not asked for here
  {
    auto screen = ViewWindow::Open(SurfaceKind::kWindow, settings_, *world_, false, "help");
    ASSERT_TRUE(screen.ok()) << screen.error().Text();
    ASSERT_TRUE(screen.value()->has_headset()) << Fake().refused;
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(screen.value()->WaitForHeadset());
      screen.value()->Show(moment_, 1.0);
    }
    EXPECT_TRUE(Fake().by_glx);
    EXPECT_EQ(Fake().layers, 1);
    EXPECT_EQ(Fake().rgba, without);
  }
  EXPECT_EQ(Fake().living, 0);
  EXPECT_EQ(Fake().wrong, 0);
}

// The view's own thread: frames are shown as long as the run goes on, without a display too.
TEST_F(InTheHeadset, ARunIsShownInIt) {
  settings_.window = WindowMode::kNever;
  auto render_thread = RenderThread::Open(settings_, world_);
  ASSERT_TRUE(render_thread.ok()) << render_thread.error().Text();
  ASSERT_NE(render_thread.value(), nullptr);
  EXPECT_TRUE(render_thread.value()->has_window());
  render_thread.value()->Show(moment_);
  moment_.time_ns = 20'000'000;
  render_thread.value()->Show(moment_);
  const double begin_s = launch::WallSeconds();
  while (Fake().frames < 5 && launch::WallSeconds() - begin_s < 60.0)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  render_thread.value().reset();
  EXPECT_GE(Fake().frames, 5);
  EXPECT_EQ(Fake().layers, 1);
  EXPECT_EQ(Fake().living, 0);
  EXPECT_EQ(Fake().wrong, 0);
}

TEST_F(InTheHeadset, WithoutOneAndWithoutAWindowNothingIsDrawn) {
  settings_.window = WindowMode::kNever;
  Fake().plugged_in = false;
  testing::internal::CaptureStderr();
  auto render_thread = RenderThread::Open(settings_, world_);
  ASSERT_TRUE(render_thread.ok()) << render_thread.error().Text();
  EXPECT_EQ(render_thread.value(), nullptr);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("nothing is shown"));
}

}  // namespace
}  // namespace rodeira::nodes
