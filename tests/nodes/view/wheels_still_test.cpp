// SPDX-License-Identifier: Apache-2.0
// The procedural car's wheels as parts of their own: each turns, steers and moves with its suspension, and nothing else
// of the car does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/view/scene/vehicles/car_mesh.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 960, kHeight = 540;
constexpr std::size_t kFrontLeft = 0, kRearLeft = 2;

// The left flank, level; without the sun's shadows, which move too.
class WheelsStill : public DriverStill {
 protected:
  WheelsStill() : DriverStill("plane.yaml", kWidth, kHeight, Quality::kLow) {}
  void SetUp() override {
    DriverStill::SetUp();
    picture_.camera = scene::CameraKind::kOrbit;
    picture_.aim.azimuth_rad = -0.5 * std::numbers::pi;
    picture_.aim.elevation_rad = 0.03;
    picture_.aim.distance_m = 5.0;
  }
  // Where a wheel is seen: the box around it, turned to whatever side.
  Eigen::AlignedBox2d BoxOf(std::size_t wheel) {
    const scene::CarShape shape = scene::CarShape::Of(Car());
    const double reach_m = std::hypot(shape.wheel_radius_m, 0.5 * shape.wheel_width_m) + 0.03;
    Eigen::AlignedBox2d box;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d away((corner & 1) != 0 ? reach_m : -reach_m, (corner & 2) != 0 ? reach_m : -reach_m,
                                 (corner & 4) != 0 ? reach_m : -reach_m);
      const Eigen::Vector3d p_W =
          Car().p_WB_W + Car().q_WB * (Car().wheels[wheel].hub_B + Eigen::Vector3d(0.0, shape.tread_out_m, 0.0) + away);
      box.extend(*renderer_->CameraOf(picture_).Project(p_W, kWidth, kHeight));
    }
    return box;
  }
  struct Changed {
    int pixels = 0;
    Eigen::AlignedBox2d box;
  };
  static Changed Between(const Image& a, const Image& b) {
    Changed changed;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (std::memcmp(a.At(x, y), b.At(x, y), 3) == 0) continue;
        ++changed.pixels;
        changed.box.extend(Eigen::Vector2d(x, y));
      }
    }
    return changed;
  }
  Probe At(const Image& image, const Eigen::Vector3d& p_B) {
    return ProbeAt(image, renderer_->CameraOf(picture_), Car().p_WB_W + Car().q_WB * p_B, 1);
  }
  // The outer side of a left wheel, at a place relative to its hub.
  Eigen::Vector3d Flank(std::size_t wheel, double ahead_m, double up_m) {
    const scene::CarShape shape = scene::CarShape::Of(Car());
    return Car().wheels[wheel].hub_B + Eigen::Vector3d(ahead_m, shape.tread_out_m + 0.5 * shape.wheel_width_m, up_m);
  }
};

TEST_F(WheelsStill, AWheelTurnsByItsAngle) {
  const Image still = Drawn();
  Car().wheels[kRearLeft].spin_rad = 0.2 * std::numbers::pi;  // from a gap between spokes to a spoke
  const Image turned = Drawn();
  const Changed changed = Between(still, turned);
  EXPECT_GT(changed.pixels, 100);
  EXPECT_TRUE(BoxOf(kRearLeft).contains(changed.box))
      << "nothing else moved: " << changed.box.min().transpose() << " … " << changed.box.max().transpose();
  // The gap that was above is a tenth of a turn forward now: wheels roll forward, their upper side ahead.
  const double out = 0.42 * scene::CarShape::Of(Car()).wheel_radius_m, angle = 0.2 * std::numbers::pi;
  EXPECT_LT(At(still, Flank(kRearLeft, 0.0, out)).green, At(turned, Flank(kRearLeft, 0.0, out)).green - 20.0);
  EXPECT_LT(At(turned, Flank(kRearLeft, out * std::sin(angle), out * std::cos(angle))).green,
            At(still, Flank(kRearLeft, out * std::sin(angle), out * std::cos(angle))).green - 20.0);
  // Five gaps: after a fifth of a turn it looks as it did.
  Car().wheels[kRearLeft].spin_rad = 0.4 * std::numbers::pi;
  EXPECT_LT(Between(still, Drawn()).pixels, changed.pixels / 4);
}

TEST_F(WheelsStill, AWheelSteers) {
  picture_.camera = scene::CameraKind::kTop;  // from above one sees the tyre stand out of the body
  picture_.aim.map_height_m = 8.0;
  const Image straight = Drawn();
  Car().wheels[kFrontLeft].steer_rad = 0.5;
  const Image left = Drawn();
  Car().wheels[kFrontLeft].steer_rad = -0.5;
  const Image right = Drawn();
  const Eigen::AlignedBox2d box = BoxOf(kFrontLeft);
  const Changed to_left = Between(straight, left), to_right = Between(straight, right);
  EXPECT_TRUE(to_left.pixels > 20 && to_right.pixels > 20);
  EXPECT_TRUE(box.contains(to_left.box) && box.contains(to_right.box)) << "nothing else moved";
  // To the left the tyre's front end stands out, to the right its rear end: dark where the road was seen.
  const scene::CarShape shape = scene::CarShape::Of(Car());
  const auto tyre = [&](const Image& image, double end) {
    const Eigen::Vector3d corner(end * 0.8 * shape.wheel_radius_m, 0.4 * shape.wheel_width_m, 0.0);
    const Eigen::Vector3d turned = Eigen::AngleAxisd(end * 0.5, Eigen::Vector3d::UnitZ()) * corner;
    return At(image, Car().wheels[kFrontLeft].hub_B + Eigen::Vector3d(0.0, shape.tread_out_m, 0.0) + turned).green;
  };
  EXPECT_LT(tyre(left, 1.0), tyre(right, 1.0) - 10.0);
  EXPECT_LT(tyre(right, -1.0), tyre(left, -1.0) - 10.0);
}

TEST_F(WheelsStill, AWheelMovesWithItsSuspension) {
  Car().p_WB_W.z() += 0.5;  // in the air
  const Image rest = Drawn();
  const Eigen::Vector3d below = Flank(kFrontLeft, 0.0, -scene::CarShape::Of(Car()).wheel_radius_m - 0.05);
  EXPECT_GT(At(rest, below).green, 60.0) << "the ground behind it";
  const Eigen::AlignedBox2d before = BoxOf(kFrontLeft);
  Car().wheels[kFrontLeft].hub_B.z() -= 0.12;
  const Image dropped = Drawn();
  EXPECT_LT(At(dropped, below).green, 60.0) << "its tyre";
  const Changed changed = Between(rest, dropped);
  EXPECT_TRUE(before.merged(BoxOf(kFrontLeft)).contains(changed.box)) << "the body stays, and so do other wheels";
}

}  // namespace
}  // namespace rodeira::nodes
