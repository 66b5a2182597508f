// SPDX-License-Identifier: Apache-2.0
// Forces of mechanisms against closed forms: those of joints, drag, springs, bushings, anti-roll bars, torques.
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

// Joint forces of a four-bar linkage against Newton's and Euler's equations of its three rods, solved by themselves
// from where the rods are and how fast: eight forces and three angular accelerations from nine equations of motion and
// the coupler's end, which both ends give.
TEST(Reactions, JointForcesOfAFourBarAreNewtonsAndEulers) {
  Mechanism bars = Parsed(R"(
planar: true
gravity_mps2: [0, -9.81, 0]
points:
  A: {at_m: [0, 0, 0], fixed: true}
  B: {at_m: [0.1, 0.4, 0], velocity_mps: [-1.6, 0.4, 0]}
  C: {at_m: [0.9, 0.7, 0]}
  D: {at_m: [1, 0, 0], fixed: true}
bodies:
  crank: {kind: rod, points: [A, B], mass_kg: 1}
  coupler: {kind: rod, points: [B, C], mass_kg: 2}
  rocker: {kind: rod, points: [C, D], mass_kg: 1.5}
outputs: {ax: joint crank A.x, ay: joint crank A.y, bx: joint coupler B.x, by: joint coupler B.y, cx: joint rocker C.x,
  cy: joint rocker C.y,
  dx: joint rocker D.x, dy: joint rocker D.y, vbx: B.vx, vby: B.vy, vcx: C.vx, vcy: C.vy}
)");
  using Flat = Eigen::Vector2d;
  const auto about = [](const Flat& r) { return Flat(-r.y(), r.x()); };  // z × r
  const Flat down(0.0, -9.81), a_m(0.0, 0.0), d_m(1.0, 0.0);
  double most_N = 0.0;
  for (int i = 1; i <= 40; ++i) {
    RunTo(bars, 0.02 * i, 0.0005);
    const Flat b_m = PointOf(bars, "B").head<2>(), c_m = PointOf(bars, "C").head<2>();
    const Flat v_b(Value(bars, "vbx"), Value(bars, "vby")), v_c(Value(bars, "vcx"), Value(bars, "vcy"));
    const auto rate = [&](const Flat& r, const Flat& v) { return about(r).dot(v) / r.squaredNorm(); };
    const Flat crank = b_m - a_m, coupler = c_m - b_m, rocker = c_m - d_m;
    const double w1 = rate(crank, v_b), w2 = rate(coupler, v_c - v_b), w3 = rate(rocker, v_c);
    // Unknowns: forces at A, B, C, D (on crank, coupler, rocker, rocker), angular accelerations.
    Eigen::Matrix<double, 11, 11> m = Eigen::Matrix<double, 11, 11>::Zero();
    Eigen::Matrix<double, 11, 1> right = Eigen::Matrix<double, 11, 1>::Zero();
    int row = 0;
    const auto body = [&](double mass_kg, const Flat& middle, const Flat& length,
                          const std::vector<std::tuple<int, double, Flat>>& forces,
                          const std::vector<std::pair<int, Flat>>& accelerates, const Flat& known, int turn) {
      for (const auto& [force, sign, at] : forces) {
        m.block<2, 2>(row, 2 * force) += sign * Eigen::Matrix2d::Identity();
        m.block<1, 2>(row + 2, 2 * force) += sign * about(at - middle).transpose();
      }
      for (const auto& [which, by] : accelerates) m.block<2, 1>(row, 8 + which) -= mass_kg * by;
      right.segment<2>(row) = mass_kg * (known - down);
      m(row + 2, 8 + turn) -= mass_kg * length.squaredNorm() / 12.0;
      row += 3;
    };
    const Flat inward_b = -w1 * w1 * crank, inward_c = inward_b - w2 * w2 * coupler;
    body(1.0, 0.5 * (a_m + b_m), crank, {{0, 1.0, a_m}, {1, -1.0, b_m}}, {{0, 0.5 * about(crank)}}, 0.5 * inward_b, 0);
    body(2.0, 0.5 * (b_m + c_m), coupler, {{1, 1.0, b_m}, {2, -1.0, c_m}},
         {{0, about(crank)}, {1, 0.5 * about(coupler)}}, 0.5 * (inward_b + inward_c), 1);
    body(1.5, 0.5 * (c_m + d_m), rocker, {{2, 1.0, c_m}, {3, 1.0, d_m}}, {{2, 0.5 * about(rocker)}},
         -0.5 * w3 * w3 * rocker, 2);
    m.block<2, 1>(row, 8) = about(crank);
    m.block<2, 1>(row, 9) = about(coupler);
    m.block<2, 1>(row, 10) = -about(rocker);
    right.segment<2>(row) = -w3 * w3 * rocker - inward_c;
    const Eigen::Matrix<double, 11, 1> solved = m.partialPivLu().solve(right);
    int k = 0;
    for (const std::string force : {"ax", "ay", "bx", "by", "cx", "cy", "dx", "dy"}) {
      EXPECT_NEAR(Value(bars, force), solved[k], 2e-3 * (1.0 + solved.head<8>().norm()))
          << force << " at " << 0.02 * i << " s";
      most_N = std::max(most_N, std::fabs(solved[k++]));
    }
  }
  EXPECT_GT(most_N, 50.0);
}

// v' = -k v² with k = rho A / 2m: v = v0 / (1 + k v0 t), and the way is ln(1 + k v0 t) / k.
TEST(Drag, SlowsAThrownBodyAsTheClosedFormSays) {
  Mechanism ball = Parsed(R"(
gravity_mps2: [0, 0, 0]
points: {P: {at_m: [0, 0, 0], velocity_mps: [30, 0, 40]}}
bodies: {ball: {kind: particle, points: [P], mass_kg: 2}}
forces: {air: {kind: drag, point: P, drag_area_m2: 0.1, density_kgpm3: 1.25}}
outputs: {x_m: P.x, z_m: P.z, vx_mps: P.vx, drag_N: force air}
)");
  RunTo(ball, 3.0, 0.001);
  const double k = 0.5 * 1.25 * 0.1 / 2.0, slower = 1.0 + k * 50.0 * 3.0;
  EXPECT_NEAR(Value(ball, "vx_mps"), 0.6 * 50.0 / slower, 1e-5);
  EXPECT_NEAR(Value(ball, "x_m"), 0.6 * std::log(slower) / k, 1e-5);
  EXPECT_NEAR(Value(ball, "z_m"), 0.8 * std::log(slower) / k, 1e-5);
  EXPECT_NEAR(std::fabs(Value(ball, "drag_N")), 2.0 * k * std::pow(50.0 / slower, 2), 1e-3);
}

TEST(Springs, AMassOnASpringAndDamperFollowsTheClosedForm) {
  Mechanism mass = Parsed(R"(
gravity_mps2: [0, 0, 0]
points:
  O: {at_m: [0, 0, 0], fixed: true}
  P: {at_m: [1.1, 0, 0], fixed: yz}
distances:
  s: {points: [O, P]}
bodies:
  mass: {kind: particle, points: [P], mass_kg: 2}
forces:
  spring: {kind: spring, coordinate: s, stiffness_Npm: 200, free_m: 1, damping_Nspm: 4}
outputs: {x: P.x, pull: force spring}
)");
  RunTo(mass, 1.5, 0.0005);
  const double w0 = 10.0, zeta = 4.0 / (2.0 * std::sqrt(200.0 * 2.0));
  const double wd = w0 * std::sqrt(1.0 - zeta * zeta);
  const double expected =
      1.0 + 0.1 * std::exp(-zeta * w0 * 1.5) * (std::cos(wd * 1.5) + zeta * w0 / wd * std::sin(wd * 1.5));
  EXPECT_NEAR(Value(mass, "x"), expected, 1e-6);
}

// The same by a spring between points, with a curve of which the mass sees one straight part, and a stop.
TEST(Springs, CurvesAndStops) {
  const char* kText = R"(
gravity_mps2: [0, 0, -10]
points:
  O: {at_m: [0, 0, 2], fixed: true}
  P: {at_m: [0, 0, 1]}
bodies:
  mass: {kind: particle, points: [P], mass_kg: 1}
forces:
  spring: {kind: spring, points: [O, P], spring_m_N: [[-1, -50], [0, 0], [0.5, 100]], free_m: 1, damping_Nspm: 20}
outputs: {z: P.z, force: force spring}
)";
  Mechanism hangs = Parsed(kText);
  RunTo(hangs, 20.0, 0.001);
  EXPECT_NEAR(Value(hangs, "z"), 1.0 - 10.0 / 200.0, 1e-9);  // 200 N/m in tension
  EXPECT_NEAR(Value(hangs, "force"), 10.0, 1e-7);
  std::string stopped = kText;
  stopped.replace(stopped.find("free_m: 1,"), 10, "free_m: 1, stops_m: [0.5, 1.01], stop_stiffness_Npm: 9800,");
  Mechanism stop = Parsed(stopped);
  RunTo(stop, 20.0, 0.001);
  // 200 x + 9800 (x - 0.01) = 10
  EXPECT_NEAR(Value(stop, "z"), 1.0 - 108.0 / 10000.0, 1e-9);
}

// A bushing is loaded by a weight: it gives by m g / k, and its torque carries the arm.
TEST(Bushings, GiveByForceOverStiffness) {
  Mechanism beam = Parsed(R"(
points:
  A: {at_m: [0, 0, 0], fixed: true}
  B: {at_m: [0, 0, 0]}
vectors:
  x0: {direction: [1, 0, 0], fixed: true}
  y0: {direction: [0, 1, 0], fixed: true}
  z0: {direction: [0, 0, 1], fixed: true}
  x1: {direction: [1, 0, 0]}
  y1: {direction: [0, 1, 0]}
  z1: {direction: [0, 0, 1]}
bodies:
  wall: {points: [A], vectors: [x0, y0, z0], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [1, 1, 1]}
  arm: {points: [B], vectors: [x1, y1, z1], mass_kg: 2, centre_m: [0.3, 0, 0], inertia_kgm2: [0.01, 0.1, 0.1]}
markers:
  tip: {body: arm, at_m: [1, 0, 0]}
forces:
  bush: {kind: bushing, first: wall, second: arm, at_m: [0, 0, 0], stiffness_Npm: [1e5, 1e5, 1e5], damping_Nspm: [500,
    500, 500], stiffness_Nmprad: 2000, damping_Nmsprad: 20}
outputs: {z: B.z, tip: tip.z, force: force bush}
)");
  RunTo(beam, 5.0, 0.001);
  EXPECT_NEAR(Value(beam, "force"), 2.0 * 9.81, 1e-6);
  EXPECT_NEAR(Value(beam, "z"), -2.0 * 9.81 / 1e5, 1e-8);
  // torque m g l cos = k sin(angle)
  const double sine = -(Value(beam, "tip") - Value(beam, "z"));
  EXPECT_NEAR(2000.0 * sine, 2.0 * 9.81 * 0.3 * std::sqrt(1.0 - sine * sine), 1e-4);
}

// The same on the ends of a rod, which has no frame of its own: each end gives by its share of the weight, along the
// wall's own axes, which lie askew here.
TEST(Bushings, HoldThePointsOfARod) {
  Mechanism rod = Parsed(R"(
points:
  A: {at_m: [0, 0, 0], fixed: true}
  P: {at_m: [0, 1, 0]}
  Q: {at_m: [0, 2, 0]}
vectors:
  x0: {direction: [1, 0, 0], fixed: true}
  y0: {direction: [0, 1, 0], fixed: true}
  z0: {direction: [0, 0, 1], fixed: true}
bodies:
  wall: {points: [A], vectors: [x0, y0, z0], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [1, 1, 1]}
  rod: {kind: rod, points: [P, Q], mass_kg: 4}
forces:
  left: {kind: bushing, first: wall, point: P, stiffness_Npm: [3e4, 2e4, 5e4], damping_Nspm: [300, 200, 500]}
  right: {kind: bushing, first: wall, point: Q, stiffness_Npm: [3e4, 2e4, 1e5], damping_Nspm: [300, 200, 1000]}
outputs: {p: P.z, q: Q.z, x: P.x, left: force left}
)");
  RunTo(rod, 3.0, 0.001);
  EXPECT_NEAR(Value(rod, "p"), -2.0 * 9.81 / 5e4, 1e-9);
  EXPECT_NEAR(Value(rod, "q"), -2.0 * 9.81 / 1e5, 1e-9);
  EXPECT_NEAR(Value(rod, "x"), 0.0, 1e-12);
  EXPECT_NEAR(Value(rod, "left"), 2.0 * 9.81, 1e-5);
}

// A rod in bushings on a free body, thrown: what the bushings do to one they do to the other, so that momentum, angular
// momentum and energy of both together stay.
TEST(Bushings, MakeNoMomentumFromNothing) {
  Mechanism pair = Parsed(R"(
gravity_mps2: [0, 0, 0]
points:
  A: {at_m: [0, 0, 0]}
  E: {at_m: [1, 0, 0]}
  P: {at_m: [0.5, 0.2, 0]}
  Q: {at_m: [0.5, 1.2, 0], velocity_mps: [1, 0, 0]}
vectors: {x1: {direction: [1, 0, 0]}, y1: {direction: [0, 1, 0]}, z1: {direction: [0, 0, 1]}}
bodies:
  frame: {points: [A, E], vectors: [x1, y1, z1], mass_kg: 3, centre_m: [0, 0, 0], inertia_kgm2: [0.5, 0.5, 0.4]}
  rod: {kind: rod, points: [P, Q], mass_kg: 1.2}
forces:
  one: {kind: bushing, first: frame, point: P, stiffness_Npm: [900, 400, 600]}
  two: {kind: bushing, first: frame, point: Q, stiffness_Npm: [500, 800, 600]}
outputs: {ax: A.x, ay: A.y, avx: A.vx, avy: A.vy, px: P.x, py: P.y, pvx: P.vx, pvy: P.vy, qx: Q.x, qy: Q.y, qvx: Q.vx,
  qvy: Q.vy,
          ex: E.x, ey: E.y, evx: E.vx, evy: E.vy, energy: energy}
)");
  const auto v = [&pair](const char* name) { return Value(pair, name); };
  const auto angular = [&v] {
    const double cx = 0.5 * (v("px") + v("qx")), cy = 0.5 * (v("py") + v("qy")), cvx = 0.5 * (v("pvx") + v("qvx")),
                 cvy = 0.5 * (v("pvy") + v("qvy"));
    const double frame_turning =
        (v("ex") - v("ax")) * (v("evy") - v("avy")) - (v("ey") - v("ay")) * (v("evx") - v("avx"));
    const double wx = v("qx") - v("px"), wy = v("qy") - v("py");
    const double rod_turning = wx * (v("qvy") - v("pvy")) - wy * (v("qvx") - v("pvx"));  // of a length of 1 m
    return 3.0 * (v("ax") * v("avy") - v("ay") * v("avx")) + 0.4 * frame_turning + 1.2 * (cx * cvy - cy * cvx) +
           1.2 / 12.0 * rod_turning;
  };
  const auto along = [&v] { return 3.0 * v("avx") + 0.6 * (v("pvx") + v("qvx")); };
  const double angular0 = angular(), along0 = along(), energy0 = v("energy");
  double given = 0.0;
  for (int i = 1; i <= 20; ++i) {
    RunTo(pair, 0.1 * i, 0.0005);
    given = std::max(given, std::fabs(v("avx")));
    EXPECT_NEAR(along(), along0, 1e-9);
    EXPECT_NEAR(angular(), angular0, 2e-5 * std::fabs(angular0));  // of order two in the step
    EXPECT_NEAR(v("energy"), energy0, 1e-4 * energy0);
  }
  EXPECT_GT(given, 0.1);  // they do act
}

// Two masses on springs, joined by a bar: both together swing with k/m, against each other with (k + 2 bar)/m.
TEST(AntiRollBars, ResistOnlyTheDifference) {
  constexpr const char* kText = R"(
gravity_mps2: [0, 0, 0]
points:
  A0: {at_m: [0, 0, 0], fixed: true}
  B0: {at_m: [1, 0, 0], fixed: true}
  A: {at_m: [0, 0, 1], fixed: xy, velocity_mps: [0, 0, 1]}
  B: {at_m: [1, 0, 1.5], fixed: xy, velocity_mps: [0, 0, 0]}
bodies: {a: {kind: particle, points: [A], mass_kg: 2}, b: {kind: particle, points: [B], mass_kg: 2}}
distances: {a: {points: [A0, A]}, b: {points: [B0, B]}}
forces:
  left: {kind: spring, coordinate: a, stiffness_Npm: 100}
  right: {kind: spring, coordinate: b, stiffness_Npm: 100}
  bar: {kind: anti_roll, coordinates: [a, b], stiffness_Npm: 150}
outputs: {a: A.z, b: B.z, energy: energy, bar: force bar}
)";
  Mechanism axle = Parsed(kText);
  const double together = std::sqrt(100.0 / 2.0), against = std::sqrt(400.0 / 2.0);
  RunTo(axle, 1.0, 1e-4);
  const double half = 0.5 * std::sin(together) / together, other = 0.5 * std::sin(against) / against;
  EXPECT_NEAR(Value(axle, "a"), 1.0 + half + other, 1e-6);
  EXPECT_NEAR(Value(axle, "b"), 1.5 + half - other, 1e-6);
  EXPECT_NEAR(Value(axle, "bar"), 150.0 * (-2.0 * other), 1e-3);
  EXPECT_NEAR(Value(axle, "energy"), 1.0, 1e-6);
  // Damping alone makes the difference die out, and leaves the motion together.
  std::string damped = kText;
  const auto at = damped.find("stiffness_Npm: 150");
  damped.replace(at, 18, "stiffness_Npm: 150, damping_Nspm: 40");
  Mechanism calm = Parsed(damped);
  RunTo(calm, 2.0, 1e-4);
  EXPECT_NEAR(Value(calm, "a") - 1.0, 0.5 * std::sin(2.0 * together) / together, 1e-6);
  EXPECT_NEAR(Value(calm, "b") - Value(calm, "a"), 0.5, 1e-6);
}

TEST(Torques, TurnABody) {
  Mechanism wheel = Parsed(R"(
gravity_mps2: [0, 0, 0]
points: {O: {at_m: [0, 0, 0], fixed: true}}
vectors:
  x: {direction: [1, 0, 0]}
  y: {direction: [0, 1, 0]}
  z: {direction: [0, 0, 1], fixed: true}
bodies:
  disc: {points: [O], vectors: [x, y, z], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [0.5, 0.5, 0.9]}
angles:
  turn: {of: [x], from: [world x], to: [world y]}
forces:
  motor: {kind: torque, body: disc, axis: [0, 0, 1], torque_Nm: 1.8}
outputs: {turn: turn, rate: turn.rate}
)");
  RunTo(wheel, 2.0, 0.0005);
  EXPECT_NEAR(Value(wheel, "rate"), 4.0, 1e-5);
  EXPECT_NEAR(Value(wheel, "turn"), 4.0, 1e-5);
}

}  // namespace
}  // namespace rodeira::multibody
