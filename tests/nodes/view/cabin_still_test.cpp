// The dashboard before the driver, asked of single pixels: needles, gear and steering wheel say what the car does.
#include <gtest/gtest.h>

#include "common/scene/cabin.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::view {
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
    return ProbeAt(image, scene::DriverCamera(Car()), Car().p_WB_W + Car().q_WB * (scene::DriversEye_B(Car()) + p_E), around);
  }
};

TEST_F(CabinStill, TheNeedlesPointAtWhatTheCarDoes) {
  Car().speed_mps = 110.0 / 3.6;
  Car().engine_rpm = 2500.0;
  Car().fuel_l = 40.0;
  const Image image = Drawn();
  const std::array<std::pair<double, double>, 3> right_and_wrong = {{{110.0, 70.0}, {2500.0, 4000.0}, {40.0, 15.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const scene::CabinDial& dial = scene::CabinDials()[i];
    const auto needle = [&](double value) {  // some way in from its end, where no tick lies
      const Eigen::Vector3d inner = dial.place.middle_E + 0.45 * (scene::NeedleEnd_E(dial, value) - dial.place.middle_E);
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
    EXPECT_TRUE(At(image, scene::WheelMark_E(angle_rad)).IsWhite()) << angle_rad << " " << At(image, scene::WheelMark_E(angle_rad));
    EXPECT_FALSE(At(image, scene::WheelMark_E(angle_rad + 0.25)).IsWhite()) << angle_rad;
  }
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
}  // namespace rodeira::view
