// SPDX-License-Identifier: Apache-2.0
// The multibody benchmark library's problems (lim.ii.udc.es/mbsbenchmark) against its published numbers.
#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

constexpr double kPi = 3.14159265358979323846;

double Turned(double from, double to) { return std::remainder(to - from, 2.0 * kPi); }

TEST(Benchmark, A01Pendulum) {
  Mechanism pendulum = Example("pendulum");
  const Worst worst = RunTo(pendulum, 1.0, 0.001);
  EXPECT_NEAR(Value(pendulum, "x_m"), -0.986291751131875, 1e-5);
  EXPECT_NEAR(Value(pendulum, "y_m"), -0.165010853125541, 1e-5);
  RunTo(pendulum, 10.0, 0.001);
  EXPECT_NEAR(Value(pendulum, "x_m"), 0.275087462576117, 1e-4);
  EXPECT_NEAR(Value(pendulum, "y_m"), -0.961419205099125, 1e-4);
  EXPECT_NEAR(Value(pendulum, "energy_J"), 0.0, 1e-4);
  EXPECT_LE(worst.violation_m, 1e-8);
  EXPECT_LE(worst.violation_mps, 1e-6);
}

// From rest at the horizontal it is back after one period.
TEST(Benchmark, A01PendulumComesBackAfterItsPeriod) {
  Mechanism pendulum = Example("pendulum");
  RunTo(pendulum, 2.3678419475762374, 0.0005);
  EXPECT_NEAR(Value(pendulum, "x_m"), 1.0, 1e-9);
  EXPECT_NEAR(Value(pendulum, "y_m"), 0.0, 1e-5);
  // At the lowest point, where v² = 2 g l, the rod bears 3 m g.
  RunTo(pendulum, 2.3678419475762374 * 1.25, 0.0005);
  EXPECT_NEAR(Value(pendulum, "tension_N"), 3.0 * 9.81, 1e-3);
}

TEST(Benchmark, A02FourBars) {
  Mechanism bars = Example("four_bar_2");
  EXPECT_EQ(bars.system->variables(), 6);
  const Worst worst = RunTo(bars, 1.0, 0.001);
  EXPECT_NEAR(Value(bars, "x_m"), -0.195020301949435, 1e-4);
  EXPECT_NEAR(Value(bars, "y_m"), -0.980799205662174, 1e-4);
  RunTo(bars, 10.0, 0.001);
  EXPECT_NEAR(Value(bars, "x_m"), 0.328458111540815, 1e-3);
  EXPECT_NEAR(Value(bars, "y_m"), 0.944518538178601, 1e-3);
  EXPECT_NEAR(Value(bars, "vx_mps"), 1.42305147020694, 1e-3);
  EXPECT_NEAR(Value(bars, "vy_mps"), -0.494868845487043, 1e-3);
  EXPECT_LE(worst.violation_m, 1e-8);
  EXPECT_LE(worst.violation_mps, 1e-6);
}

// θ̈ = -k (g/L) cos θ, integrated here by Runge and Kutta's rule with a thousandth of the step.
TEST(Benchmark, A02FortyFourBarsFollowTheClosedForm) {
  const double n = 40.0, g = 9.81;
  const double k = ((n + 1.0) / 2.0 + n) / ((n + 1.0) / 3.0 + n);
  double angle = 0.5 * kPi, rate = -1.0;  // B0 to the right: falling clockwise
  const double h = 1e-5;
  const auto pull = [&](double a) { return -k * g * std::cos(a); };
  for (int i = 0; i < 200000; ++i) {
    const double k1 = pull(angle), k2 = pull(angle + 0.5 * h * rate),
                 k3 = pull(angle + 0.5 * h * rate + 0.25 * h * h * k1);
    const double k4 = pull(angle + h * rate + 0.5 * h * h * k2);
    angle += h * rate + h * h / 6.0 * (k1 + k2 + k3);
    rate += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  Mechanism bars = Example("four_bar_40");
  EXPECT_EQ(bars.system->variables(), 82);
  RunTo(bars, 2.0, 0.001);
  EXPECT_NEAR(Value(bars, "x_m"), std::cos(angle), 1e-4);
  EXPECT_NEAR(Value(bars, "y_m"), std::sin(angle), 1e-4);
}

TEST(Benchmark, A03AndrewsSqueezer) {
  Mechanism andrews = Example("andrews");
  EXPECT_EQ(andrews.system->variables(), 9);
  Worst worst = RunTo(andrews, 0.01, 1e-5);
  EXPECT_NEAR(Value(andrews, "Fx_m"), -3.89055238864943e-3, 1e-6);
  EXPECT_NEAR(Value(andrews, "Fy_m"), 5.81924411854102e-3, 1e-6);
  worst = RunTo(andrews, 0.03, 1e-5);
  EXPECT_NEAR(Value(andrews, "beta_rad"), 15.8107711951537071, 1e-3);
  EXPECT_LE(worst.violation_m, 1e-8);
  EXPECT_LE(worst.violation_mps, 1e-6);
}

// How far the step must go down for 1e-6 in beta.
TEST(Benchmark, A03AndrewsToAMillionth) {
  Mechanism andrews = Example("andrews");
  RunTo(andrews, 0.03, 5e-7);
  EXPECT_NEAR(Value(andrews, "beta_rad"), 15.8107711951537071, 1e-6);
  EXPECT_NEAR(Value(andrews, "beta_radps"), 1139.92030225910606, 1e-3);
  const double beta = Value(andrews, "beta_rad");
  EXPECT_NEAR(Turned(beta - 15.7563710584118395, Value(andrews, "EF_rad")), 0.0, 1e-6);
  EXPECT_NEAR(Turned(0.0408222401196458 - 0.5 * kPi, Value(andrews, "BE_rad")), 0.0, 1e-6);
  EXPECT_NEAR(Turned(-0.534730116342079594 + 0.524409965879954069 + 0.5 * kPi, Value(andrews, "EG_rad")), 0.0, 1e-6);
  EXPECT_NEAR(Turned(0.524409965879954069, Value(andrews, "AG_rad")), 0.0, 1e-6);
  EXPECT_NEAR(Turned(0.534730116342079594 + 1.04808074104193787, Value(andrews, "HE_rad")), 0.0, 1e-6);
  EXPECT_NEAR(Turned(1.04808074104193787 - 0.5 * kPi, Value(andrews, "AH_rad")), 0.0, 1e-6);
}

}  // namespace
}  // namespace rodeira::multibody
