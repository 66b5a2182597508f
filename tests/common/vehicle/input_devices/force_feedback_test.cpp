// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/force_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace rodeira::input_devices {
namespace {

ForceSettings Bare() {
  ForceSettings settings;
  settings.friction_Nm = 0.0;
  settings.damping_Nmsprad = 0.0;
  return settings;
}

// From a second on at rest the formula is what it says.
double Settled(const ForceSettings& settings, const ForceMoment& moment) {
  ForceFeedback law(settings);
  double share = 0.0;
  for (int i = 0; i <= 200; ++i) share = law.Step(moment, 10.0 + 0.01 * i);
  return share;
}

TEST(ForceFeedback, TheRoadsTorqueComesInItsShareAndNeverMore) {
  ForceSettings settings = Bare();
  EXPECT_NEAR(Settled(settings, {0.0, 7.85, 2.0}), settings.share * 2.0 / settings.device_Nm, 1e-12);
  EXPECT_NEAR(Settled(settings, {0.5, 7.85, -2.0}), -settings.share * 2.0 / settings.device_Nm, 1e-12)
      << "positive is to the left, both ways";
  settings.most_Nm = 1.1;
  for (const double torque_Nm : {50.0, 1e9, -50.0})
    EXPECT_EQ(Settled(settings, {0.0, 7.85, torque_Nm}), std::copysign(0.5, torque_Nm));
  EXPECT_EQ(Settled(settings, {0.0, 7.85, std::numeric_limits<double>::quiet_NaN()}), 0.0);
}

TEST(ForceFeedback, ItFadesInEvenlyAndAgainAfterEachPause) {
  const ForceSettings settings = Bare();
  const double full = settings.share * 2.0 / settings.device_Nm;
  ForceFeedback law(settings);
  double now_s = 3.0;
  for (int life = 0; life < 2; ++life) {
    EXPECT_EQ(law.Step({0.0, 7.85, 2.0}, now_s), 0.0) << "at first nothing";
    for (int i = 1; i <= 150; ++i) {
      now_s += 0.01;
      ASSERT_NEAR(law.Step({0.0, 7.85, 2.0}, now_s), full * std::min(1.0, 0.01 * i), 1e-9) << i;
    }
    now_s += 0.2;  // longer than stale_s: a pause
  }
  law.Forget();
  EXPECT_EQ(law.Step({0.0, 7.85, 2.0}, now_s), 0.0) << "the wheel was away";
}

// Friction and damping take energy out of every motion, whichever way: their torque times the speed is never positive.
TEST(ForceFeedback, FrictionHoldsAgainstEveryMotion) {
  ForceFeedback law(ForceSettings{});
  double wheel_rad = 0.0;
  for (int i = 0; i < 100; ++i) (void)law.Step({wheel_rad, 7.85, 0.0}, 0.01 * i);
  double work = 0.0, most = 0.0;
  for (int i = 100; i < 700; ++i) {
    const double speed = 3.0 * std::cos(0.01 * i);
    wheel_rad += 0.01 * speed;
    const double share = law.Step({wheel_rad, 7.85, 0.0}, 0.01 * i);
    work += share * speed * 0.01;
    most = std::max(most, std::fabs(share));
  }
  EXPECT_LT(work, -0.5 * 0.12 / 2.2 * 6.0);
  EXPECT_NEAR(most, (0.12 + 0.03 * 3.0) / 2.2, 0.003);
}

TEST(ForceFeedback, TheStopPushesBackOnEitherSideAtOnce) {
  const ForceSettings settings = Bare();
  for (const double side : {1.0, -1.0}) {
    ForceFeedback law(settings);
    EXPECT_EQ(law.Step({side * 7.85, 7.85, 0.0}, 1.0), 0.0);
    EXPECT_NEAR(law.Step({side * (7.85 + 0.1), 7.85, 0.0}, 1.01), -side * 0.6 / settings.device_Nm, 1e-9)
        << "before it has faded in";
    EXPECT_EQ(law.Step({side * 9.5, 7.85, 0.0}, 1.02), -side) << "limited";
  }
}

// The high-pass of a step of the loads' difference: e^(-t / T) in the filter's own steps, T / (T + dt) each.
TEST(ForceFeedback, ABumpUnderOneWheelIsFeltAndPassesWithTheWheelStraight) {
  ForceSettings settings = Bare();
  settings.fade_s = 0.1;
  ForceFeedback law(settings);
  double now_s = 5.0;
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(law.Step({0.0, 7.85, 0.0, -700.0}, now_s += 0.01), 0.0)
        << "load that shifts slowly is not the road: " << i;
  double expected_Nm = ForceFeedback::kFeelArm_m * 300.0;
  constexpr double kKept = ForceFeedback::kFeelSlow_s / (ForceFeedback::kFeelSlow_s + 0.01);
  for (int i = 0; i < 50; ++i) {
    expected_Nm *= kKept;
    ASSERT_NEAR(law.Step({0.0, 7.85, 0.0, -400.0}, now_s += 0.01), expected_Nm / settings.device_Nm, 1e-12)
        << "more load on the left pulls to the left: " << i;
  }
  EXPECT_NEAR(ForceFeedback::kFeelArm_m * 300.0, 0.1875, 1e-12) << "Nm at the rim, of 300 N";
}

TEST(ForceFeedback, TheRoadsRoughnessIsLimitedAndNothingAfterAPause) {
  ForceSettings settings = Bare();
  settings.fade_s = 0.1;
  ForceFeedback law(settings);
  double now_s = 5.0;
  for (int i = 0; i < 100; ++i) (void)law.Step({0.0, 7.85, 0.0, 0.0}, now_s += 0.01);
  EXPECT_NEAR(law.Step({0.0, 7.85, 0.0, 1e6}, now_s += 0.01), ForceFeedback::kFeelMost_Nm / settings.device_Nm, 1e-12);
  EXPECT_EQ(law.Step({0.0, 7.85, 0.0, std::numeric_limits<double>::quiet_NaN()}, now_s += 0.01), 0.0);
  EXPECT_TRUE(std::isfinite(law.Step({0.0, 7.85, 0.0, -1e6}, now_s += 0.01))) << "and is not remembered";
  now_s += 0.5;
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(law.Step({0.0, 7.85, 0.0, 900.0}, now_s += 0.01), 0.0) << "what is after a pause is what is usual";
  settings.road_feel = 0.0;
  ForceFeedback deaf(settings);
  for (int i = 0; i < 200; ++i) ASSERT_EQ(deaf.Step({0.0, 7.85, 0.0, i % 2 == 0 ? 900.0 : -900.0}, now_s += 0.01), 0.0);
}

// A motor that goes on with what it was told until that ends, on a clock of the test's.
class FakeMotor final : public ForceDevice {
 public:
  struct Told {
    double at_s, share, for_s;
  };
  FakeMotor(const double& now_s, std::vector<Told>& told, const bool& there)
      : now_s_(now_s), told_(told), there_(there) {}
  bool Push(double share, double for_s) override {
    if (there_) told_.push_back({now_s_, share, for_s});
    return there_;
  }

 private:
  const double& now_s_;
  std::vector<Told>& told_;
  const bool& there_;
};

TEST(ForceDriver, WithoutCommandsTheWheelIsFreeWithinATenthOfASecond) {
  double now_s = 0.0;
  std::vector<FakeMotor::Told> told;
  bool there = true;
  ForceDriver driver(Bare(), std::make_unique<FakeMotor>(now_s, told, there));
  for (int i = 0; i < 200; ++i) {
    now_s = 0.01 * i;
    driver.Tell({0.0, 7.85, 2.0}, now_s);
  }
  ASSERT_EQ(told.size(), 200u);
  for (std::size_t i = 1; i < told.size(); ++i)
    ASSERT_GT(told[i - 1].at_s + told[i - 1].for_s, told[i].at_s) << "no gap while it drives: " << i;
  EXPECT_LE(told.back().for_s, 0.1);
  EXPECT_GT(told.back().share, 0.0);
  // After the pause it begins at nothing.
  now_s += 5.0;
  driver.Tell({0.0, 7.85, 2.0}, now_s);
  EXPECT_EQ(told.back().share, 0.0);
  // As fast as possible activations come by the hundred a millisecond: the device is told no oftener than it can hear.
  const std::size_t before = told.size();
  for (int i = 0; i < 1000; ++i) driver.Tell({0.0, 7.85, 2.0}, now_s += 1e-5);
  EXPECT_LE(told.size() - before, 3u);
}

TEST(ForceDriver, AWheelThatIsUnpluggedIsLetGoOf) {
  double now_s = 0.0;
  std::vector<FakeMotor::Told> told;
  bool there = true;
  ForceDriver driver(Bare(), std::make_unique<FakeMotor>(now_s, told, there));
  for (; now_s < 2.0; now_s += 0.01) driver.Tell({0.0, 7.85, 2.0}, now_s);
  there = false;
  driver.Tell({0.0, 7.85, 2.0}, now_s += 0.01);
  EXPECT_FALSE(driver.has_device());
  there = true;
  driver.Change(std::make_unique<FakeMotor>(now_s, told, there));
  driver.Tell({0.0, 7.85, 2.0}, now_s += 0.01);
  EXPECT_EQ(told.back().share, 0.0) << "it fades in anew";
}

}  // namespace
}  // namespace rodeira::input_devices
