// SPDX-License-Identifier: Apache-2.0
// The speed that a banked bend allows, against forces resolved apart from the plan.
#include <gtest/gtest.h>

#include <cmath>

#include "common/driving/driver/speed_plan.hpp"

namespace rodeira::driver {
namespace {

constexpr double kGravity_mps2 = 9.81;

// A bend of constant radius on ground that leans across by a constant slope: rise over the distance to the left.
class BankedBend final : public Way {
 public:
  BankedBend(double curvature_1pm, double bank) : curvature_1pm_(curvature_1pm), bank_(bank) {}

  double length_m() const override { return 50.0; }
  double SpeedLimit_mps(double) const override { return 50.0; }
  LaneFrame At(double d_m) const override { return {Position(d_m, 0.0), d_m * curvature_1pm_, curvature_1pm_, 0.0}; }
  double VerticalCurvature_1pm(double) const override { return 0.0; }
  Eigen::Vector3d Position(double d_m, double offset_m) const override {
    const double turned = d_m * curvature_1pm_, radius = 1.0 / curvature_1pm_;
    return {(radius - offset_m) * std::sin(turned), radius - (radius - offset_m) * std::cos(turned), bank_ * offset_m};
  }
  std::optional<Place> Locate(double, double, std::optional<double>) const override { return std::nullopt; }

 private:
  double curvature_1pm_, bank_;
};

// Along the ground to the outside of the bend, a metre of weight across it: weight and centrifugal force as vectors.
double Sideways_mps2(double speed_mps, double curvature_1pm, double bank) {
  const Eigen::Vector2d left = Eigen::Vector2d(1.0, bank).normalized(), up(-left.y(), left.x());
  const Eigen::Vector2d force(-speed_mps * speed_mps * curvature_1pm, -kGravity_mps2);  // to the left, up
  return (curvature_1pm > 0.0 ? -1.0 : 1.0) * force.dot(left) / -force.dot(up) * kGravity_mps2;
}

double Speed(double curvature_1pm, double bank, const SpeedPlanSettings& settings) {
  return SpeedPlan(BankedBend(curvature_1pm, bank), settings).At(20.0).speed_mps;
}

// Where the ground leans outward the car feels what is comfortable, no more and no less: v² = g R tan(atan(a / g) -
// lean).
TEST(SpeedPlan, ABendThatLeansOutwardIsFeltAsOneOnTheLevel) {
  const SpeedPlanSettings settings;
  for (const double curvature : {0.01, -0.01, 0.05, -0.1}) {
    for (const double lean : {0.0, 0.01, 0.025, 0.06, 0.1, 0.14}) {
      const double bank = std::copysign(lean, curvature),
                   speed =
                       Speed(curvature, bank, settings);  // a bend to the left leans outward where the left is higher
      EXPECT_NEAR(Sideways_mps2(speed, curvature, bank), settings.lateral_mps2, 1e-9) << curvature << " " << lean;
    }
  }
}

// Leaning inward no car is told to drive faster than on the level.
TEST(SpeedPlan, ABendThatLeansInwardIsDrivenAsOnTheLevel) {
  const SpeedPlanSettings settings;
  for (const double curvature : {0.01, -0.05}) {
    for (const double lean : {0.02, 0.1, 0.5})
      EXPECT_NEAR(Speed(curvature, std::copysign(lean, -curvature), settings),
                  std::sqrt(settings.lateral_mps2 / std::fabs(curvature)), 1e-9);
  }
}

// Ground that leans outward by more than is comfortable: the bend adds a quarter of the comfortable, never more than
// 0.6 of what tips the car over, else a crawl.
TEST(SpeedPlan, NoCarTipsOverWhereTheGroundLeansOutward) {
  SpeedPlanSettings settings;
  for (const double tips : {5.8, 6.9, 10.5}) {
    settings.tips_mps2 = tips;
    int crawls = 0, free = 0;
    for (double lean = 0.2; lean < 0.9; lean += 0.01) {
      const double speed = Speed(0.01, lean, settings), bend = 0.01 * speed * speed,
                   felt = Sideways_mps2(speed, 0.01, lean);
      EXPECT_LE(bend, 0.25 * settings.lateral_mps2 + 1e-9);
      if (felt > 0.6 * tips + 1e-9) {
        EXPECT_NEAR(bend, 0.2, 1e-9) << lean;
        ++crawls;
      } else if (felt < 0.6 * tips - 1e-9) {
        EXPECT_NEAR(bend, 0.25 * settings.lateral_mps2, 1e-9) << lean;
        ++free;
      }
    }
    EXPECT_GT(crawls, 5);
    EXPECT_GT(free, 5);
  }
}

// A car that is comfortable on the level with more than its tyres' track stands for does not get it.
TEST(SpeedPlan, ABriskDriverKeepsOffTippingToo) {
  SpeedPlanSettings settings;
  settings.lateral_mps2 = 6.0, settings.tips_mps2 = 6.0;
  EXPECT_NEAR(Sideways_mps2(Speed(0.02, 0.0, settings), 0.02, 0.0), 0.6 * settings.tips_mps2, 1e-9);
  EXPECT_NEAR(Sideways_mps2(Speed(0.02, 0.1, settings), 0.02, 0.1), 0.6 * settings.tips_mps2, 1e-9);
}

}  // namespace
}  // namespace rodeira::driver
