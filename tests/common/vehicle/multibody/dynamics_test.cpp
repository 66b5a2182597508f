// SPDX-License-Identifier: Apache-2.0
// Mechanisms against closed forms: order, energy, free bodies, driven coordinates, redundant joints.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <tuple>
#include <vector>

#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

Mechanism Parsed(const std::string& text) {
  auto mechanism = ParseMechanism("rodeira: mechanism/1\n" + text, "test.yaml");
  EXPECT_TRUE(mechanism.ok()) << (mechanism.ok() ? "" : mechanism.error().Text());
  return std::move(mechanism).value();
}

Vector3d PointOf(const Mechanism& mechanism, const std::string& name) {
  const auto& entities = mechanism.system->drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    if (entities[i].name == name) return mechanism.system->motion().At(static_cast<int>(i));
  }
  ADD_FAILURE() << "no point " << name;
  return Vector3d::Zero();
}

// Error against the published end falls fourfold when the step is halved.
TEST(Order, IsTwo) {
  double before = 0.0;
  for (const double step : {0.004, 0.002, 0.001}) {
    Mechanism pendulum = Example("pendulum");
    RunTo(pendulum, 1.0, step);
    const double error =
        std::hypot(Value(pendulum, "x_m") + 0.986291751131875, Value(pendulum, "y_m") + 0.165010853125541);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << step;
    }
    before = error;
  }
}

TEST(Order, OfAndrewsIsTwo) {
  double before = 0.0;
  for (const double step : {4e-6, 2e-6, 1e-6}) {
    Mechanism andrews = Example("andrews");
    RunTo(andrews, 0.03, step);
    const double error = std::fabs(Value(andrews, "beta_rad") - 15.8107711951537071);
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / error), 2.0, 0.1) << step;
    }
    before = error;
  }
}

TEST(Energy, DriftFallsFourfoldWhenTheStepIsHalved) {
  double before = 0.0;
  for (const double step : {0.004, 0.002}) {
    Mechanism pendulum = Example("pendulum");
    double drift = 0.0;
    for (int i = 1; i <= 500; ++i) {
      RunTo(pendulum, 0.02 * i, step);
      drift = std::max(drift, std::fabs(Value(pendulum, "energy_J")));
    }
    if (before > 0.0) {
      EXPECT_NEAR(before / drift, 4.0, 0.6);
    }
    before = drift;
  }
}

// A free body with two equal moments: its axis goes round the angular momentum with L / A (A the equal moment).
TEST(FreeBody, AxisGoesRoundTheAngularMomentum) {
  const double a = 0.4, c = 0.1, spin = 12.0, tumble = 3.0;
  // w = (tumble, 0, spin); points on the axes, drawn at rest in the origin.
  Mechanism body = Parsed(R"(
gravity_mps2: [0, 0, 0]
points:
  G: {at_m: [0, 0, 0], velocity_mps: [0, 0, 0]}
vectors:
  u: {direction: [1, 0, 0]}
  v: {direction: [0, 1, 0]}
  w: {direction: [0, 0, 1]}
bodies:
  top: {points: [G], vectors: [u, v, w], mass_kg: 2, centre_m: [0, 0, 0], inertia_kgm2: [0.4, 0.4, 0.1]}
outputs: {energy: energy}
)");
  System& system = *body.system;
  const Vector3d turning(tumble, 0.0, spin);
  for (std::size_t i = 0; i < system.drawing().entities.size(); ++i) {
    const auto& entity = system.drawing().entities[i];
    if (entity.kind != EntityKind::kVector || entity.fixed[0]) continue;
    const Vector3d rate = turning.cross(entity.at);
    for (int k = 0; k < 3; ++k) system.qd()[3 * i + static_cast<std::size_t>(k)] = rate[k];
  }
  ASSERT_TRUE(system.FindAccelerations());
  EXPECT_NEAR(system.KineticEnergy(), 0.5 * (a * tumble * tumble + c * spin * spin), 1e-12);
  const Vector3d momentum(a * tumble, 0.0, c * spin);
  const double precession = momentum.norm() / a;
  for (int i = 0; i < 20000; ++i) ASSERT_TRUE(system.Step(1e-4).converged);
  const Vector3d expected = Eigen::AngleAxisd(2.0 * precession, momentum.normalized()) * Vector3d::UnitZ();
  const Vector3d axis = system.drawing().bodies[0].frame.Rotation(system.q().data()).col(2);
  EXPECT_LT((axis - expected).norm(), 2e-5);
  EXPECT_NEAR(system.KineticEnergy(), 0.5 * (a * tumble * tumble + c * spin * spin), 1e-5);
}

// A general body of five points and a vector falls as a point does, and its ties hold.
TEST(FreeBody, FallsWithoutTurning) {
  Mechanism body = Parsed(R"(
points:
  A: {at_m: [0, 0, 0]}
  B: {at_m: [1, 0.1, 0]}
  C: {at_m: [0.2, 1, 0.1]}
  D: {at_m: [0.1, 0.3, 1]}
  E: {at_m: [0.5, 0.5, 0.5]}
vectors:
  u: {direction: [1, 1, 0]}
bodies:
  rock: {points: [A, B, C, D, E], vectors: [u], mass_kg: 3, centre_m: [0.3, 0.2, 0.1], inertia_kgm2: [0.4, 0.5, 0.6,
    0.05, -0.02, 0.01]}
outputs: {z: E.z, vz: E.vz, az: E.az, x: B.x}
)");
  EXPECT_EQ(body.system->variables(), 18);
  EXPECT_EQ(body.system->degrees_of_freedom(), 6);
  RunTo(body, 1.0, 0.01);
  EXPECT_NEAR(Value(body, "z"), 0.5 - 0.5 * 9.81, 1e-9);
  EXPECT_NEAR(Value(body, "vz"), -9.81, 1e-9);
  EXPECT_NEAR(Value(body, "az"), -9.81, 1e-6);
  EXPECT_NEAR(Value(body, "x"), 1.0, 1e-9);
}

TEST(Coordinates, ADrivenCrankSlider) {
  Mechanism slider = Parsed(R"(
planar: true
gravity_mps2: [0, 0, 0]
points:
  O: {at_m: [0, 0, 0], fixed: true}
  C: {at_m: [0.1, 0, 0]}
  S: {at_m: [0.4, 0, 0], fixed: y}
angles:
  crank: {of: [O, C]}
bodies:
  web: {kind: rod, points: [O, C], mass_kg: 1}
  rod: {kind: rod, points: [C, S], mass_kg: 1}
  piston: {kind: particle, points: [S], mass_kg: 0.5}
constraints:
  motor: {kind: drive, coordinate: crank, rate_per_s: 20}
outputs: {x: S.x, vx: S.vx, ax: S.ax, angle: crank, rate: crank.rate}
)");
  EXPECT_EQ(slider.system->degrees_of_freedom(), 0);
  RunTo(slider, 0.37, 0.001);
  const double a = 20.0 * 0.37, r = 0.1, l = 0.3, w = 20.0;
  const double root = std::sqrt(l * l - r * r * std::sin(a) * std::sin(a));
  EXPECT_NEAR(Value(slider, "angle"), a, 1e-9);
  EXPECT_NEAR(Value(slider, "x"), r * std::cos(a) + root, 1e-9);
  EXPECT_NEAR(Value(slider, "vx"), -r * w * std::sin(a) * (1.0 + r * std::cos(a) / root), 1e-7);
  const double d2 =
      -(r * r * std::cos(2.0 * a)) / root - std::pow(r * r * std::sin(a) * std::cos(a), 2) / std::pow(root, 3);
  EXPECT_NEAR(Value(slider, "ax"), w * w * (-r * std::cos(a) + d2), 1e-4);
}

// A04: six revolutes about Y Z X Y Z X on the edges of a cube move, though counting says that they cannot.
TEST(Redundant, BricardsLoopMovesAndKeepsItsEnergy) {
  Mechanism loop = Example("bricard");
  EXPECT_EQ(loop.system->degrees_of_freedom(), 1);
  const double start = Value(loop, "energy_J");
  double low = Value(loop, "x_m"), high = low, drift = 0.0;
  for (int i = 1; i <= 100; ++i) {
    const Worst worst = RunTo(loop, 0.1 * i, 0.001);
    EXPECT_LE(worst.violation_m, 1e-8);
    EXPECT_LE(worst.violation_mps, 1e-6);
    low = std::min(low, Value(loop, "x_m"));
    high = std::max(high, Value(loop, "x_m"));
    drift = std::max(drift, std::fabs(Value(loop, "energy_J") - start));
    // Bricard's closed form: the cosines between neighbouring rods are by turns c and d, with c d + c + d = 0.
    std::array<Vector3d, 6> rods;
    for (int k = 0; k < 6; ++k)
      rods[static_cast<std::size_t>(k)] =
          PointOf(loop, "P" + std::to_string((k + 1) % 6)) - PointOf(loop, "P" + std::to_string(k));
    const double c = rods[0].dot(rods[1]), d = rods[1].dot(rods[2]);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(rods[k].dot(rods[(k + 1) % 6]), k % 2 == 0 ? c : d, 1e-7) << i;
    EXPECT_NEAR(c * d + c + d, 0.0, 1e-7) << i;
  }
  EXPECT_GT(high - low, 0.5);  // it does move
  EXPECT_LT(drift, 1e-3);
}

}  // namespace
}  // namespace rodeira::multibody
