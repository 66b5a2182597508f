// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/mirror.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace rodeira::scene {
namespace {

CarPose Car() {
  CarPose car;
  car.p_WB_W = {100.0, 50.0, 3.0};
  car.q_WB = Attitude(0.7, 0.0, 0.0);
  return car;
}
// Where in a mirror's direct picture of 300 pixels' width a place is seen, relative to the car: from its left edge.
std::optional<double> At(Mirror mirror, double behind_m, double left_m) {
  const CarPose car = Car();
  const int width_px = 300, height_px = static_cast<int>(300 / ShapeOf(mirror));
  const auto at = MirrorCamera(car, mirror)
                      .Project(car.p_WB_W + car.q_WB * Eigen::Vector3d(-behind_m, left_m, 0.9), width_px, height_px);
  if (!at || at->x() < 0.0 || at->x() > width_px || at->y() < 0.0 || at->y() > height_px) return std::nullopt;
  return at->x();
}

// Backward, the car's left is the picture's right: it must be reversed to be on the driver's left.
TEST(Mirror, ShowsWhatIsBehind) {
  EXPECT_NEAR(At(Mirror::kInside, 40.0, 0.0).value(), 150.0, 1e-6);
  EXPECT_GT(At(Mirror::kInside, 40.0, 5.0).value(), 200.0);
  EXPECT_LT(At(Mirror::kInside, 40.0, -5.0).value(), 100.0);
  // A car that overtakes beside the car's end is out of the inside mirror and in the left one.
  EXPECT_FALSE(At(Mirror::kInside, 6.0, 3.2));
  EXPECT_TRUE(At(Mirror::kLeft, 6.0, 3.2));
  EXPECT_FALSE(At(Mirror::kRight, 6.0, 3.2));
  EXPECT_TRUE(At(Mirror::kRight, 6.0, -3.2));
  EXPECT_NEAR(At(Mirror::kLeft, 8.0, 3.2).value(), 300.0 - At(Mirror::kRight, 8.0, -3.2).value(), 1e-6);
  for (const Mirror mirror : kAllMirrors) EXPECT_FALSE(At(mirror, -20.0, 0.0)) << "ahead";
}

TEST(Mirror, HasAPlaceOfItsOwnInPicturesOfAnyShape) {
  for (const double aspect : {4.0 / 3.0, 16.0 / 10.0, 16.0 / 9.0, 21.0 / 9.0}) {
    for (const Mirror mirror : kAllMirrors) {
      const MirrorPlace place = PlaceOf(mirror, aspect);
      EXPECT_GE(place.left, 0.0);
      EXPECT_GE(place.low, 0.0);
      EXPECT_LE(place.right, 1.0);
      EXPECT_LE(place.high, 1.0);
      EXPECT_NEAR((place.right - place.left) * aspect / (place.high - place.low), ShapeOf(mirror), 1e-9);
      for (const Mirror other : kAllMirrors) {
        if (other == mirror) continue;
        const MirrorPlace there = PlaceOf(other, aspect);
        EXPECT_TRUE(place.right <= there.left || there.right <= place.left || place.high <= there.low ||
                    there.high <= place.low)
            << NameOf(mirror) << " " << NameOf(other) << " " << aspect;
      }
    }
  }
}

// Which mirrors are on each of so many screens, 0.7 m before the eye and as wide: "left inside right", a dash where one
// is not.
std::string On(const std::vector<std::pair<double, double>>& angles_deg_and_asides_m) {
  std::vector<ScreenPlane> screens;
  for (const auto& [angle_deg, aside_m] : angles_deg_and_asides_m)
    screens.push_back({0.7, 0.4, 0.7, angle_deg * 3.14159265358979 / 180.0, 0.2, aside_m});
  std::string all;
  for (std::size_t i = 0; i < screens.size(); ++i) {
    const auto on = MirrorsOn(screens, i);
    all += (i == 0 ? "" : " ") + std::string{on[0] ? 'l' : '-', on[1] ? 'i' : '-', on[2] ? 'r' : '-'};
  }
  return all;
}

TEST(Mirror, IsOnTheScreenWhereItIsLookedFor) {
  EXPECT_EQ(On({{53.66, 0.0}, {0.0, 0.0}, {-53.66, 0.0}}), "l-- -i- --r");
  EXPECT_EQ(On({{-53.66, 0.0}, {53.66, 0.0}, {0.0, 0.0}}), "--r l-- -i-") << "in whatever order they are named";
  EXPECT_EQ(On({{0.0, 0.0}}), "lir");
  EXPECT_EQ(On({{180.0, 0.0}, {0.0, 0.0}}), "--- lir") << "a screen behind the driver";
  EXPECT_EQ(On({{-180.0, 0.0}, {170.0, 0.0}, {-10.0, 0.0}}), "--- --- lir");
  EXPECT_EQ(On({{30.0, 0.0}, {-30.0, 0.0}}), "l-- -ir");
  EXPECT_EQ(On({{0.0, 0.0}, {0.0, -0.7}}), "-ir l--") << "one plane, the second screen's middle 45 degrees to the left";
  EXPECT_EQ(On({{100.0, 0.0}, {50.0, 0.0}, {0.0, 0.0}, {-50.0, 0.0}, {-100.0, 0.0}}), "--- l-- -i- --r ---");
}

// By hand: the default car's mirrors seen from its driver's eye, by the angle to the left and below the horizon, on a
// flat screen.
TEST(Mirror, StandsOnAScreenWhereItIsOnTheCar) {
  const CarPose pose = Car();
  const Body car(pose);
  const Eigen::Vector3d eye_B = DriversEye_B(car);
  constexpr double kAspect = 16.0 / 9.0, kWide_m = 0.708, kHigh_m = 0.398, kAway_m = 0.7, kEye_m = 0.22;
  for (const double side : {1.0, -1.0}) {
    const Mirror mirror = side > 0.0 ? Mirror::kLeft : Mirror::kRight;
    const double forward_m = car.front_m - 0.33 * car.length_m - eye_B.x(),
                 aside_m = side * (0.5 * car.width_m + 0.12) - eye_B.y(), up_m = 0.69 * car.height_m - eye_B.z();
    const double look_rad = std::atan2(aside_m, forward_m), screen_rad = side * 53.66 * 3.14159265358979 / 180.0;
    const MirrorPlace place = PlaceOn({kWide_m, kHigh_m, kAway_m, screen_rad, kEye_m, 0.0}, car, mirror, kAspect);
    const double right_m = 0.5 * kWide_m - kAway_m * std::tan(look_rad - screen_rad);
    const double low_m = kEye_m + kAway_m * up_m / (std::hypot(forward_m, aside_m) * std::cos(look_rad - screen_rad));
    EXPECT_NEAR(0.5 * (place.left + place.right), right_m / kWide_m, 1e-9) << NameOf(mirror);
    EXPECT_NEAR(0.5 * (place.low + place.high),
                std::max(low_m / kHigh_m, 0.5 * (place.high - place.low) + 0.012 * kAspect), 1e-9)
        << NameOf(mirror);
    EXPECT_NEAR((place.right - place.left) * kAspect / (place.high - place.low), ShapeOf(mirror), 1e-9);
  }
}

TEST(Mirror, IsWholeOnItsScreen) {
  const CarPose pose = Car();
  const Body car(pose);
  for (double screen_deg = -180.0; screen_deg <= 180.0; screen_deg += 7.5) {
    for (const double eye_m : {-0.5, 0.2, 1.0}) {
      for (const Mirror mirror : kAllMirrors) {
        const MirrorPlace place = PlaceOn({0.708, 0.398, 0.7, screen_deg * 3.14159265358979 / 180.0, eye_m, 0.0}, car,
                                          mirror, 16.0 / 9.0),
                          usual = PlaceOf(mirror, 16.0 / 9.0);
        EXPECT_GE(std::min(place.left, place.low), 0.0) << screen_deg;
        EXPECT_LE(std::max(place.right, place.high), 1.0) << screen_deg;
        EXPECT_NEAR(place.right - place.left, usual.right - usual.left, 1e-12);
        EXPECT_NEAR(place.high - place.low, usual.high - usual.low, 1e-12);
        if (mirror == Mirror::kInside) {
          EXPECT_EQ(place.left, usual.left);
        }
      }
    }
  }
}

TEST(Mirror, IsKnownByItsName) {
  for (const Mirror mirror : kAllMirrors) EXPECT_EQ(MirrorOf(NameOf(mirror)), mirror);
  EXPECT_FALSE(MirrorOf("middle"));
}

}  // namespace
}  // namespace rodeira::scene
