// SPDX-License-Identifier: Apache-2.0
// The dashboard before the driver, asked of single pixels: needles, gear and steering wheel say what the car does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/view/scene/vehicles/cabin.hpp"
#include "common/view/scene/vehicles/cabin_body.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

class CabinStill : public DriverStill {
 protected:
  CabinStill() : DriverStill("plane.yaml", kWidth, kHeight) {}
  void SetUp() override {
    DriverStill::SetUp();
    picture_.cabin = true;
  }
  Probe At(const Image& image, const Eigen::Vector3d& p_E, int around = 1) {
    return ProbeAt(image, scene::DriverCamera(Car()), Car().p_WB_W + Car().q_WB * (scene::DriversEye_B(Car()) + p_E),
                   around);
  }
};

TEST_F(CabinStill, TheNeedlesPointAtWhatTheCarDoes) {
  Car().speed_mps = 110.0 / 3.6;
  Car().engine_rpm = 2500.0;
  Car().fuel_used_l = scene::kTank_l - 40.0;
  const Image image = Drawn();
  const std::array<std::pair<double, double>, 3> right_and_wrong = {{{110.0, 70.0}, {2500.0, 4000.0}, {40.0, 15.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const scene::CabinDial& dial = scene::CabinDials()[i];
    const auto needle = [&](double value) {  // some way in from its end, where no tick lies
      const Eigen::Vector3d inner =
          dial.place.middle_E + 0.45 * (scene::NeedleEnd_E(dial, value) - dial.place.middle_E);
      return At(image, inner, 0);
    };
    EXPECT_TRUE(needle(right_and_wrong[i].first).IsRed()) << dial.dial.unit << needle(right_and_wrong[i].first);
    EXPECT_FALSE(needle(right_and_wrong[i].second).IsRed()) << dial.dial.unit << needle(right_and_wrong[i].second);
  }
}

TEST_F(CabinStill, TheGearIsItsOwnSign) {
  std::vector<Image> pictures;
  for (const std::int32_t gear : {-1, 0, 1, 5}) {
    Car().gear = gear;
    pictures.push_back(Drawn());
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i].rgb, pictures.back().rgb) << gear;
  }
  Car().gear = 0;
  EXPECT_EQ(Drawn().rgb, pictures[1].rgb);
}

TEST_F(CabinStill, TheSteeringWheelTurnsOneToOne) {
  for (const double angle_rad : {0.0, 0.45, -0.45}) {
    Car().steering_wheel_rad = angle_rad;
    const Image image = Drawn();
    EXPECT_TRUE(At(image, scene::WheelMark_E(angle_rad)).IsWhite())
        << angle_rad << " " << At(image, scene::WheelMark_E(angle_rad));
    EXPECT_FALSE(At(image, scene::WheelMark_E(angle_rad + 0.25)).IsWhite()) << angle_rad;
  }
}

// What is about the driver is the same wherever the car stands: no road is seen through the doors below their panes,
// beside the dashboard, through posts or the roof.
TEST_F(CabinStill, DoorsPostsAndRoofAreAroundTheDriver) {
  const Image here = Drawn();
  Car().p_WB_W += Eigen::Vector3d(39.0, 23.0, 0.0);  // on other squares of the plane
  const Image there = Drawn();
  const scene::CabinShape shape{Car().width_m, Car().height_m, scene::DriversEye_B(Car()).y(),
                                scene::DriversEye_B(Car()).z()};
  const double half = 0.5 * Car().width_m, left = half - shape.eye_left_m;
  const auto same = [&](const Eigen::Vector3d& p_E) {
    const Probe a = At(here, p_E);
    const auto seen = scene::DriverCamera(Car()).Project(Car().p_WB_W + Car().q_WB * (scene::DriversEye_B(Car()) + p_E),
                                                         kWidth, kHeight);
    return seen && a == ProbeAt(there, seen->x(), seen->y(), 1) && !a.IsSky() && !a.IsRed();
  };
  for (const double ahead : {0.50, 0.60, 0.70, 0.80}) {
    EXPECT_TRUE(same({ahead, left - 0.056, -scene::kSill_m - 0.02})) << "the door, " << ahead << " m ahead";
    EXPECT_TRUE(same({ahead, left - 0.056, -scene::kSill_m - 0.01 - 0.04}))
        << "the door, lower, " << ahead << " m ahead";
  }
  for (const double share : {0.1, 0.5, 0.9}) {  // of the post beside the windscreen, from the dashboard to the roof
    const Eigen::Vector3d low(0.84, left - 0.085, -0.30),
        high(scene::kHeader_m - 0.02, 0.7 * half - shape.eye_left_m, shape.roof_m() + 0.02);
    EXPECT_TRUE(same(low + share * (high - low))) << "the post, " << share;
  }
  for (const double aside : {0.15, 0.0, -0.2})
    EXPECT_TRUE(same({scene::kHeader_m, aside, shape.roof_m() + 0.01})) << "the roof's edge, " << aside;
  // Left of that a side window is still open: the door's ledge meets the picture's lower edge where it lies as far to
  // the left as it is low.
  const double ledge = (left - 0.075) / scene::kSill_m * std::tan(26.86 * std::numbers::pi / 180.0),
               middle_px = 0.5 * kHeight / std::tan(26.0 * std::numbers::pi / 180.0);
  for (int x = static_cast<int>(0.5 * kWidth - ledge * middle_px) + 12; x < kWidth; ++x) {
    const Probe lowest = ProbeAt(here, x, kHeight - 2, 0);
    ASSERT_EQ(lowest, ProbeAt(there, x, kHeight - 2, 0)) << "the picture's lower edge at " << x;
  }
}

// The road is seen as if there were no cabin, from the left post to the picture's right edge and from the dials' hood
// to the roof; over the dashboard the bonnet.
TEST_F(CabinStill, TheWindscreenIsFreeAndShowsTheBonnet) {
  const Image with = Drawn();
  picture_.cabin = false;
  const Image without = Drawn();
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (double aside_deg = -39.0; aside_deg <= 22.0; aside_deg += 1.0) {
    for (double up_deg = -12.0; up_deg <= 20.0; up_deg += 1.0) {
      const Eigen::Vector3d ray(1.0, std::tan(aside_deg * kDegree), std::tan(up_deg * kDegree));
      EXPECT_EQ(At(with, ray, 0), At(without, ray, 0)) << aside_deg << " " << up_deg;
    }
  }
  int bonnet = 0;
  for (double down = 0.25; down < 0.40; down += 0.002) bonnet += At(with, {1.0, -0.45, -down}, 0).IsRed() ? 1 : 0;
  EXPECT_GT(bonnet, 20) << "of the picture's rows at some 24 degrees to the right, each 1.5 pixels";
}

TEST_F(CabinStill, OnlyTheDriverSeesItAndOnlyWhereItIsWanted) {
  const Eigen::Vector3d place(0.60, -0.35, -0.29);
  const Probe dash = At(Drawn(), place);
  picture_.cabin = false;
  const Image without = Drawn();
  EXPECT_LT(dash.red, 60.0) << dash;
  EXPECT_TRUE(At(without, place).IsRed()) << "the bonnet";
  picture_.camera = scene::CameraKind::kBonnet;
  const Image bonnet = Drawn();
  picture_.cabin = true;
  EXPECT_EQ(Drawn().rgb, bonnet.rgb);
}

}  // namespace
}  // namespace rodeira::nodes
