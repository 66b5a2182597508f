// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/cabin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/vehicles/cabin_body.hpp"

namespace rodeira::scene {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Dial, TheNeedleTurnsClockwiseFromTheLowerLeftAndStaysOnTheScale) {
  EXPECT_NEAR(NeedleAngle_rad(kSpeedDial, 0.0), 225.0 * kDegree, 1e-12);
  EXPECT_NEAR(NeedleAngle_rad(kSpeedDial, 110.0), 90.0 * kDegree, 1e-12);
  EXPECT_NEAR(NeedleAngle_rad(kSpeedDial, 220.0), -45.0 * kDegree, 1e-12);
  EXPECT_EQ(NeedleAngle_rad(kSpeedDial, 500.0), NeedleAngle_rad(kSpeedDial, 220.0));
  EXPECT_EQ(NeedleAngle_rad(kEngineDial, -1.0), NeedleAngle_rad(kEngineDial, 0.0));
}

// Each labelled value has its long tick, light on dark; midway between two small ones there is none.
TEST(Dial, HasATickWhereItsNeedleWouldPoint) {
  constexpr int kSize = 512;
  for (const Dial& dial : {kSpeedDial, kEngineDial, kFuelDial}) {
    const Raster picture = DrawDial(dial, kSize);
    const auto light = [&](double value, double radius) {
      const double angle = NeedleAngle_rad(dial, value);
      const auto px = [&](double part) { return static_cast<int>(0.5 * kSize * (1.0 + radius * part)); };
      return picture.At(px(std::cos(angle)), px(std::sin(angle))).green > 128;
    };
    for (double value = 0.0; value <= dial.most; value += dial.labelled) {
      EXPECT_TRUE(light(value, 0.81)) << dial.unit << value;
      EXPECT_TRUE(light(value, 0.90)) << dial.unit << value;
    }
    for (double value = 0.5 * dial.ticks; value < dial.most; value += dial.ticks)
      EXPECT_FALSE(light(value, 0.88)) << dial.unit << value;
  }
}

// All that a driver must read lies within the picture of the driver's camera, and the road ahead stays free.
TEST(Cabin, TheInstrumentsAreSeenAndTheRoadToo) {
  CarPose car;
  const Camera camera = DriverCamera(car);
  const Eigen::Vector3d eye_B = DriversEye_B(car);
  const auto seen = [&](const Eigen::Vector3d& p_E) {
    const auto at = camera.Project(eye_B + p_E, 1280, 720);
    return at && at->x() >= 0.0 && at->x() < 1280.0 && at->y() >= 0.0 && at->y() < 720.0 ? at : std::nullopt;
  };
  ASSERT_FALSE(CabinDials().empty());
  for (const CabinDial& dial : CabinDials()) {
    for (double share = 0.0; share <= 1.0; share += 0.25)
      EXPECT_TRUE(seen(NeedleEnd_E(dial, share * dial.dial.most))) << dial.dial.unit << share;
  }
  EXPECT_TRUE(seen(GearPlace().middle_E));
  EXPECT_TRUE(seen(WheelMark_E(0.0)));
  const auto road =
      camera.Project(car.p_WB_W + Eigen::Vector3d(9.0, 0.3, 0.0), 1280, 720);  // 9 m before the car's middle
  const Mesh dashboard = BuildDashboard(car.width_m, eye_B.y());
  ASSERT_FALSE(dashboard.positions.empty());
  for (std::size_t i = 0; i < dashboard.positions.size(); ++i) {
    const auto at = camera.Project(eye_B + dashboard.PositionW(i), 1280, 720);
    EXPECT_TRUE(!at || at->y() > road->y()) << dashboard.PositionW(i).transpose();
  }
}

// No eye is in a post: nothing is nearer to the eye than a hand, and the left half of the body is the right one
// mirrored at the car's middle.
TEST(CabinBody, LeavesRoomForAHeadAndIsTheSameOnBothSides) {
  for (const auto& [width_m, height_m] : {std::pair(1.65, 1.42), std::pair(1.9, 1.9), std::pair(1.55, 1.15)}) {
    CarPose car;
    car.width_m = width_m, car.height_m = height_m;
    const Eigen::Vector3d eye_B = DriversEye_B(car);
    const CabinShape shape{width_m, height_m, eye_B.y(), eye_B.z()};
    EXPECT_LE(eye_B.z() + shape.roof_m(), height_m) << "the lining is under the roof";
    const Mesh body = BuildCabinBody(shape);
    Eigen::Vector3d left = Eigen::Vector3d::Zero(), right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < body.triangles.size(); i += 3) {
      const Eigen::Vector3d a = body.PositionW(body.triangles[i]), b = body.PositionW(body.triangles[i + 1]),
                            c = body.PositionW(body.triangles[i + 2]);
      const Eigen::Vector3d across = (b - a).cross(c - a);
      EXPECT_GT(std::min({a.norm(), b.norm(), c.norm(), ((a + b + c) / 3.0).norm()}), 0.13);
      const double middle = (a.y() + b.y() + c.y()) / 3.0 + shape.eye_left_m;  // left of the car's middle
      (middle > 0.0 ? left : right) += across.cwiseAbs();
      for (const Eigen::Vector3d& p : {a, b, c})
        EXPECT_LT(std::fabs(p.y() + shape.eye_left_m), 0.5 * width_m) << "within the body";
    }
    EXPECT_LT((left - right).norm(), 0.02 * left.norm());
  }
}

TEST(Cabin, TurningLeftTakesTheMarkToTheLeft) {
  EXPECT_NEAR(WheelMark_E(0.0).y(), 0.0, 1e-12);
  EXPECT_GT(WheelMark_E(0.5).y(), 0.05);
  EXPECT_LT(WheelMark_E(-0.5).y(), -0.05);
  EXPECT_NEAR((WheelMark_E(1.0) - WheelMark_E(1.0 + 2.0 * std::numbers::pi)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace rodeira::scene
