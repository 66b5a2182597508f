// SPDX-License-Identifier: Apache-2.0
// A run that no person drives does not wait until its view has drawn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "nodes/view/view_settings.hpp"
#include "nodes/view/window/render_thread.hpp"
#include "tests/nodes/view/fake_run.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

class DrawingBehind : public testing::Test {
 protected:
  void SetUp() override { RODEIRA_NEEDS_PICTURES(); }

  base::Result<std::unique_ptr<RenderThread>> Open(bool waits, const std::filesystem::path& frame_log = {}) const {
    ViewSettings settings;
    settings.width_px = 64;
    settings.height_px = 64;
    settings.window = WindowMode::kNever;
    settings.frame_steps = {10};
    settings.waits_for_picture = waits;
    settings.frame_log = frame_log;
    return RenderThread::Open(settings, road::World::Load(SourceDir() + "/configs/worlds/plane.yaml").value());
  }
  static Picture At(int step) {
    Picture picture;
    picture.show_instruments = false;
    picture.moment.time_ns = step * 1'000'000;
    picture.moment.cars.push_back(CarAt(CarAtTime(0.001 * step), HeadingAt(0.001 * step)));
    return picture;
  }

  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("behind").value();
};

// What fails while the renderer is made tells both apart: it is opened after the world is read.
TEST_F(DrawingBehind, WhatFailsBeforeTheFirstPictureIsToldLaterWhereTheRunDoesNotWait) {
  const auto nowhere = folder_.path() / "no/such/folder/log.csv";
  const auto waiting = Open(true, nowhere);
  ASSERT_FALSE(waiting.ok());
  const auto behind = Open(false, nowhere);
  ASSERT_TRUE(behind.ok()) << behind.error().Text();
  ASSERT_NE(behind.value(), nullptr);
  (void)behind.value()->Order(At(10), folder_.path() / "10.png");
  const base::Status drained = behind.value()->Drain();
  ASSERT_FALSE(drained.ok());
  EXPECT_EQ(drained.error().id.text(), waiting.error().id.text());
  EXPECT_EQ(behind.value()->status().error().Text(), waiting.error().Text());
}

// More of them than are kept waiting; each file is the one that a view draws that has waited.
TEST_F(DrawingBehind, EveryPictureIsWrittenAndIsTheSame) {
  constexpr int kPictures = 80;
  for (const bool waits : {true, false}) {
    const auto thread = Open(waits);
    ASSERT_TRUE(thread.ok()) << thread.error().Text();
    for (int step = 0; step < kPictures; ++step)
      ASSERT_TRUE(thread.value()->Order(At(step), folder_.path() / fmt::format("{}_{}.png", waits, step)).ok());
    ASSERT_TRUE(thread.value()->Drain().ok());
  }
  for (int step = 0; step < kPictures; ++step) {
    const auto first = base::ReadBytes(folder_.path() / fmt::format("true_{}.png", step)),
               behind = base::ReadBytes(folder_.path() / fmt::format("false_{}.png", step));
    ASSERT_TRUE(first.ok() && behind.ok()) << step;
    EXPECT_EQ(first.value(), behind.value()) << step;
  }
}

TEST(DrawingBehindSettings, ARunWaitsForAPersonAndForAPictureOfItsBeginning) {
  const auto waits = [](const std::string& input, const std::string& view) {
    std::string text = LaunchText(view);
    text.replace(text.find("{kind: input}"), 13, "{kind: input, config: " + input + "}");
    const auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/fake.yaml");
    EXPECT_TRUE(launch.ok());
    const PlainContext context(launch.value(), launch.value().roster().Find("picture"));
    const auto read = ReadViewSettings(context);
    EXPECT_TRUE(read.ok()) << (read.ok() ? "" : read.error().Text());
    return read.value().waits_for_picture;
  };
  const base::TemporaryFolder folder = base::TemporaryFolder::Make("behind").value();
  const auto frames = [&](const std::string& times) {
    return "{frames: {times_s: " + times + ", folder: " + folder.path().string() + "}}";
  };
  EXPECT_FALSE(waits("{source: autopilot}", "{}"));
  EXPECT_FALSE(waits("{source: script}", frames("[0.3]")));
  EXPECT_TRUE(waits("{source: script}", frames("[0, 0.3]")));
  EXPECT_TRUE(waits("{source: autopilot}", "{headset: true}"));
  for (const char* source : {"keyboard", "joystick", "gamepad"})
    EXPECT_TRUE(waits("{source: " + std::string(source) + "}", "{}")) << source;
}

}  // namespace
}  // namespace rodeira::nodes
