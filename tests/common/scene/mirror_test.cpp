#include "common/scene/mirror.hpp"

#include <gtest/gtest.h>

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
  const auto at = MirrorCamera(car, mirror).Project(car.p_WB_W + car.q_WB * Eigen::Vector3d(-behind_m, left_m, 0.9), width_px, height_px);
  if (!at || at->x() < 0.0 || at->x() > width_px || at->y() < 0.0 || at->y() > height_px) return std::nullopt;
  return at->x();
}

// Backward, the car's left is the picture's right: it must be reversed to be on the driver's left.
TEST(Mirror, ShowsWhatIsBehind) {
  EXPECT_NEAR(At(Mirror::kInside, 40.0, 0.0).value(), 150.0, 1e-6);
  EXPECT_GT(At(Mirror::kInside, 40.0, 5.0).value(), 200.0);
  EXPECT_LT(At(Mirror::kInside, 40.0, -5.0).value(), 100.0);
  // Who overtakes beside the car's end is out of the inside mirror and in the left one.
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
        EXPECT_TRUE(place.right <= there.left || there.right <= place.left || place.high <= there.low || there.high <= place.low) << NameOf(mirror) << " " << NameOf(other) << " " << aspect;
      }
    }
  }
}

// Which mirrors are on each of so many screens, 0.7 m before the eye and as wide: "left inside right", a dash where one is not.
std::string On(const std::vector<std::pair<double, double>>& angles_deg_and_asides_m) {
  std::vector<ScreenPlane> screens;
  for (const auto& [angle_deg, aside_m] : angles_deg_and_asides_m) screens.push_back({0.7, 0.4, 0.7, angle_deg * 3.14159265358979 / 180.0, 0.2, aside_m});
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

TEST(Mirror, IsKnownByItsName) {
  for (const Mirror mirror : kAllMirrors) EXPECT_EQ(MirrorOf(NameOf(mirror)), mirror);
  EXPECT_FALSE(MirrorOf("middle"));
}

}  // namespace
}  // namespace rodeira::scene
