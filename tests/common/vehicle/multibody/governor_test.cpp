// SPDX-License-Identifier: Apache-2.0
// A05 of the benchmark library, the stiff flyball governor: against its three equations of motion, written down from
// Lagrange's and integrated by Runge and Kutta at a step that follows the stiff springs.
#include <array>

#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

// Angle of the rods below the horizontal, height of the slider, and their rates; the turn follows from angular
// momentum.
using State = std::array<double, 5>;  // turn, angle, height, angle's rate, height's rate

struct Governor {
  double ball_kg = 5.0, rod_kg = 0.3, slider_kg = 3.0;
  double across_kgm2 = 0.3 * (1.0 + 1e-4) / 12.0, along_kgm2 = 0.3 * 1e-4 / 6.0, slider_kgm2 = 3.0 * 0.01 / 6.0;
  double stiffness_Npm = 8e5, damping_Nspm = 4e4, free_m = 0.5, offset_m = 0.05, g = 9.81;
  double momentum = 0.0;

  // About the shaft, and its derivative by the rods' angle.
  double Inertia(double b) const {
    const double c = std::cos(b), s = std::sin(b);
    return along_kgm2 + slider_kgm2 +
           2.0 * (ball_kg * std::pow(offset_m + c, 2) + rod_kg * std::pow(offset_m + 0.5 * c, 2) + across_kgm2 * c * c +
                  along_kgm2 * s * s);
  }
  double InertiaSlope(double b) const {
    const double c = std::cos(b), s = std::sin(b);
    return 2.0 * (-2.0 * s * ball_kg * (offset_m + c) - s * rod_kg * (offset_m + 0.5 * c) -
                  2.0 * c * s * (across_kgm2 - along_kgm2));
  }
  double Speed(const State& x) const { return momentum / Inertia(x[1]); }

  State Rates(const State& x) const {
    const double b = x[1], c = std::cos(b), s = std::sin(b);
    const double out = 0.5 * c, down = 1.0 - 0.5 * s - x[2];  // from the slider's end to the rod's middle
    const double length = std::hypot(out, down);
    const double by_angle = (-0.5 * s * out - 0.5 * c * down) / length, by_height = -down / length;
    const double pull = stiffness_Npm * (length - free_m) + damping_Nspm * (by_angle * x[3] + by_height * x[4]);
    const double speed = Speed(x);
    const double hinge_kgm2 = 2.0 * (across_kgm2 + 0.25 * rod_kg + ball_kg);
    const double angle =
        (0.5 * InertiaSlope(b) * speed * speed + 2.0 * g * c * (ball_kg + 0.5 * rod_kg) - 2.0 * pull * by_angle) /
        hinge_kgm2;
    const double height = -g - 2.0 * pull * by_height / slider_kg;
    return {speed, x[3], x[4], angle, height};
  }

  State RunTo(double until_s) {
    State x = {0.0, 3.14159265358979323846 / 6.0, 0.5, 0.0, 0.0};
    momentum = Inertia(x[1]) * 2.0 * 3.14159265358979323846;
    const auto steps = static_cast<int>(std::lround(until_s / 2e-5));
    const double h = until_s / steps;
    const auto at = [](const State& a, const State& slope, double factor) {
      State sum = a;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * slope[i];
      return sum;
    };
    for (int i = 0; i < steps; ++i) {
      const State k1 = Rates(x), k2 = Rates(at(x, k1, 0.5 * h)), k3 = Rates(at(x, k2, 0.5 * h)),
                  k4 = Rates(at(x, k3, h));
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += h / 6.0 * (k1[k] + 2.0 * k2[k] + 2.0 * k3[k] + k4[k]);
    }
    return x;
  }
};

double Off(double step_s, double until_s, const State& expected) {
  Mechanism governor = Example("governor");
  RunTo(governor, until_s, step_s);
  return std::max({std::fabs(Value(governor, "slider_m") - expected[2]),
                   std::fabs(Value(governor, "turn_rad") - expected[0]),
                   std::fabs(Value(governor, "ball_z_m") - (1.0 - std::sin(expected[1])))});
}

TEST(StiffGovernor, FollowsItsThreeEquationsOfMotion) {
  EXPECT_EQ(Example("governor").system->degrees_of_freedom(), 4);  // turn, slider, and each rod, which move alike
  Governor lagrange;
  const State two = lagrange.RunTo(2.0);
  EXPECT_GT(std::fabs(two[2] - 0.5), 0.005) << "the slider does move";
  const double ten_ms = Off(0.01, 2.0, two), five_ms = Off(0.005, 2.0, two), one_ms = Off(0.001, 2.0, two);
  EXPECT_NEAR(std::log2(ten_ms / five_ms), 2.0,
              0.1);  // though springs and dampers are a thousand times faster than that
  EXPECT_LT(one_ms, 1e-4);
  EXPECT_LT(Off(0.001, 10.0, lagrange.RunTo(10.0)), 5e-4);
}

TEST(StiffGovernor, KeepsItsAngularMomentumAndLosesEnergyOnly) {
  Mechanism governor = Example("governor");
  const Governor lagrange;
  const auto momentum = [&] {
    return lagrange.Inertia(std::asin(1.0 - Value(governor, "ball_z_m"))) * Value(governor, "speed_radps");
  };
  const double start = momentum();
  double before = Value(governor, "energy_J");
  for (int i = 1; i <= 20; ++i) {
    RunTo(governor, 0.5 * i, 0.001);
    EXPECT_NEAR(momentum(), start, 1e-4 * start);
    EXPECT_LT(Value(governor, "energy_J"), before + 1e-3 * std::fabs(before));
    before = std::min(before, Value(governor, "energy_J"));
  }
}

}  // namespace
}  // namespace rodeira::multibody
