// SPDX-License-Identifier: Apache-2.0
// What a driver sees in the mirrors, asked of single pixels: reversed left to right.
#include <gtest/gtest.h>

#include <GL/gl.h>

#include "common/runtime/launch/launch.hpp"
#include "nodes/view/frame/eye_buffer.hpp"
#include "nodes/view/view_settings.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

class MirrorStill : public DriverStill {
 protected:
  explicit MirrorStill(Quality quality = Quality::kMedium) : DriverStill("plane.yaml", kWidth, kHeight, quality) {}
  void SetUp() override {
    DriverStill::SetUp();
    if (IsSkipped()) return;
    picture_.mirrors.fill(true);
    AddBehind(1, 14.0, 3.5, scene::Colour::Of(0xc01010));   // red, to the left
    AddBehind(2, 14.0, -3.5, scene::Colour::Of(0x1030c0));  // blue, to the right
  }
  Eigen::Vector3d PointBehind(double behind_m, double left_m, double up_m) {
    return Car().p_WB_W + Car().q_WB * Eigen::Vector3d(-behind_m, left_m, up_m);
  }
  void AddBehind(std::uint64_t id, double behind_m, double left_m, scene::Colour colour) {
    scene::AgentPose agent;
    agent.id = id;
    agent.colour = colour;
    agent.p_WB_W = PointBehind(behind_m, left_m, 0.0);
    agent.q_WB = Car().q_WB;
    picture_.moment.agents.push_back(agent);
  }
  // On the picture's screen, where it has one.
  scene::MirrorPlace Place(scene::Mirror mirror) const {
    constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
    return picture_.screen ? scene::PlaceOn(*picture_.screen, scene::Body(picture_.moment.cars[0]), mirror, kAspect)
                           : scene::PlaceOf(mirror, kAspect);
  }
  // Where a place behind the car is seen in a mirror, in pixels of the picture; `reversed` as mirrors do.
  Eigen::Vector2d Seen(const scene::CarPose& car, scene::Mirror mirror, const Eigen::Vector3d& p_W,
                       bool reversed) const {
    const scene::MirrorPlace place = Place(mirror);
    const double wide = (place.right - place.left) * kWidth, high = (place.high - place.low) * kHeight;
    const auto at = scene::MirrorCamera(car, mirror).Project(p_W, 10'000, 10'000);
    const double x = at->x() / 10'000.0, y = at->y() / 10'000.0;
    return {place.left * kWidth + (reversed ? 1.0 - x : x) * wide, (1.0 - place.high) * kHeight + y * high};
  }
  // Whether two pictures show something else in a mirror.
  bool Differ(const Image& a, const Image& b, scene::Mirror mirror, int more_than = 1000) const {
    const scene::MirrorPlace place = Place(mirror);
    int pixels = 0;
    for (int y = static_cast<int>((1.0 - place.high) * kHeight) + 4;
         y < static_cast<int>((1.0 - place.low) * kHeight) - 4; ++y) {
      for (int x = static_cast<int>(place.left * kWidth) + 4; x < static_cast<int>(place.right * kWidth) - 4; ++x)
        pixels += std::memcmp(a.At(x, y), b.At(x, y), 3) != 0;
    }
    return pixels > more_than;
  }
};

TEST_F(MirrorStill, LeftIsLeft) {
  const Image image = Drawn();
  // The bonnets of the two, 14 m behind: 2 m before their middles, at 0.75 m.
  const auto bonnet = [&](scene::Mirror mirror, double left_m, bool reversed) {
    const Eigen::Vector2d at = Seen(Car(), mirror, PointBehind(12.5, left_m, 0.85), reversed);
    return ProbeAt(image, at.x(), at.y());
  };
  EXPECT_TRUE(bonnet(scene::Mirror::kInside, 3.5, true).IsRed()) << bonnet(scene::Mirror::kInside, 3.5, true);
  EXPECT_TRUE(bonnet(scene::Mirror::kInside, -3.5, true).IsBlue()) << bonnet(scene::Mirror::kInside, -3.5, true);
  EXPECT_TRUE(bonnet(scene::Mirror::kInside, 3.5, false).IsBlue())
      << "where it would be in a picture that is not reversed the other one is";
  EXPECT_TRUE(bonnet(scene::Mirror::kLeft, 3.5, true).IsRed()) << bonnet(scene::Mirror::kLeft, 3.5, true);
  EXPECT_TRUE(bonnet(scene::Mirror::kRight, -3.5, true).IsBlue()) << bonnet(scene::Mirror::kRight, -3.5, true);
  // Each of the outer ones shows the car's own flank on the side where it is.
  const scene::MirrorPlace left = scene::PlaceOf(scene::Mirror::kLeft, static_cast<double>(kWidth) / kHeight);
  const Probe flank = ProbeAt(image, left.right * kWidth - 6.0, (1.0 - left.low) * kHeight - 30.0, 3);
  EXPECT_TRUE(flank.IsRed()) << flank;
}

TEST_F(MirrorStill, OnlyTheChosenOnesAndOnlyForTheDriver) {
  const Image all = Drawn();
  picture_.mirrors = {false, false, false};
  const Image none = Drawn();
  for (const scene::Mirror mirror : scene::kAllMirrors) EXPECT_TRUE(Differ(all, none, mirror)) << scene::NameOf(mirror);
  picture_.mirrors = {false, true, false};
  const Image inside = Drawn();
  EXPECT_FALSE(Differ(inside, none, scene::Mirror::kLeft));
  EXPECT_TRUE(Differ(inside, none, scene::Mirror::kInside));
  EXPECT_FALSE(Differ(inside, none, scene::Mirror::kRight));
  picture_.camera = scene::CameraKind::kChase;
  const Image chase = Drawn();
  picture_.mirrors = {false, false, false};
  EXPECT_EQ(chase.rgb, Drawn().rgb);
}

// On three screens about a seat each mirror is where its driver looks for it, and shows the car that is behind on that
// side; nothing is said of it in the launch file.
TEST_F(MirrorStill, EachOfThreeScreensHasItsOwn) {
  const auto launch = launch::Launch::Load(SourceDir() + "/launch/three_screens.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  for (const auto& [name, own] : {std::pair("left", scene::Mirror::kLeft), std::pair("centre", scene::Mirror::kInside),
                                  std::pair("right", scene::Mirror::kRight)}) {
    const auto settings = ReadWindowSettings(launch.value(), launch.value().roster().Find(name));
    ASSERT_TRUE(settings.ok()) << settings.error().Text();
    picture_.screen = PictureOf(settings.value(), {}).screen;
    picture_.mirrors = {false, false, false};
    const Image none = Drawn();
    picture_.mirrors = PictureOf(settings.value(), {}).mirrors;
    const Image seen = Drawn();
    for (const scene::Mirror mirror : scene::kAllMirrors)
      EXPECT_EQ(Differ(seen, none, mirror), mirror == own) << name << ": " << scene::NameOf(mirror);
    const auto bonnet = [&](double left_m) {
      const Eigen::Vector2d at = Seen(Car(), own, PointBehind(12.5, left_m, 0.85), true);
      return ProbeAt(seen, at.x(), at.y());
    };
    EXPECT_TRUE(own == scene::Mirror::kRight || bonnet(3.5).IsRed()) << name << ": " << bonnet(3.5);
    EXPECT_TRUE(own == scene::Mirror::kLeft || bonnet(-3.5).IsBlue()) << name << ": " << bonnet(-3.5);
  }
}

// The same picture again, after others, has the same pixels: mirrors keep nothing.
TEST_F(MirrorStill, APictureIsAFunctionOfWhatItShows) {
  const Image first = Drawn();
  picture_.moment.cars[0].p_WB_W.x() += 30.0;
  (void)Drawn();
  picture_.moment.cars[0].p_WB_W.x() -= 30.0;
  EXPECT_EQ(Drawn().rgb, first.rgb);
}

class MirrorsInTurn : public MirrorStill {
 protected:
  MirrorsInTurn() : MirrorStill(Quality::kLow) {}
  // The next picture of a drive at 20 m/s, 40 ms later.
  Image Next() {
    picture_.moment.time_ns += 40'000'000;
    Car().p_WB_W += 0.8 * (Car().q_WB * Eigen::Vector3d::UnitX());
    return InTurn();
  }
  // As a window draws it.
  Image InTurn() {
    renderer_->Draw(picture_);
    return renderer_->Read();
  }
  Image Whole() { return Drawn(); }
};

// At low quality a window's pictures draw one mirror each, in a fixed order; every third picture it is that one's turn
// again.
TEST_F(MirrorsInTurn, OneOfThreeIsNewInEachPicture) {
  (void)Whole();
  std::array<int, scene::kMirrors> changed{};
  Image before = Whole();
  for (int i = 0; i < 6; ++i) {
    const Image now = Next();
    int new_ones = 0;
    for (const scene::Mirror mirror : scene::kAllMirrors) {
      const bool is_new = Differ(now, before, mirror, 20);
      new_ones += is_new;
      changed[static_cast<std::size_t>(mirror)] += is_new;
    }
    EXPECT_EQ(new_ones, 1) << i;
    before = now;
  }
  for (const int times : changed) EXPECT_EQ(times, 2);
}

// So it stays where pictures of another size and without mirrors come in between, as those of a headset's eyes do:
// nothing is made anew for them.
TEST_F(MirrorsInTurn, AHeadsetsEyesInBetweenChangeNothing) {
  EyeBuffer eye(320, 240, 0, GL_RGBA8);
  ASSERT_TRUE(eye.whole());
  (void)Whole();
  Image before = Whole();
  for (int i = 0; i < 3; ++i) {
    Picture in_headset = picture_;
    in_headset.mirrors.fill(false);
    renderer_->DrawInto(in_headset, eye.target());
    const Image now = Next();
    int new_ones = 0;
    for (const scene::Mirror mirror : scene::kAllMirrors) new_ones += Differ(now, before, mirror, 20);
    EXPECT_EQ(new_ones, 1) << i;
    before = now;
  }
}

// Pictures for files, those after a leap, and those of time that stands, show all three as they are.
TEST_F(MirrorsInTurn, WhatIsKeptOrDoesNotGoOnIsDrawnWhole) {
  for (int i = 0; i < 4; ++i) (void)Next();
  const Image standing = InTurn();
  EXPECT_EQ(Whole().rgb, standing.rgb) << "the same time again";
  (void)Next();
  const Image whole = Whole();
  (void)Next();
  picture_.moment.time_ns += 5'000'000'000;
  (void)InTurn();
  picture_.moment.time_ns -= 5'040'000'000;
  Car().p_WB_W -= 0.8 * (Car().q_WB * Eigen::Vector3d::UnitX());
  EXPECT_EQ(InTurn().rgb, whole.rgb) << "a leap";
}

}  // namespace
}  // namespace rodeira::nodes
