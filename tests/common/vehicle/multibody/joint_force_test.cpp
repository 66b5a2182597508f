// SPDX-License-Identifier: Apache-2.0
// Joint forces where loads, torques and rods act beside a body's points: against statics, the IVP test set, and
// Newton's and Euler's laws of each body.
#include <Eigen/Geometry>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/common/vehicle/multibody/run_mechanism.hpp"

namespace rodeira::multibody {
namespace {

Mechanism Parsed(const std::string& text) {
  auto mechanism = ParseMechanism(text, "test.yaml");
  EXPECT_TRUE(mechanism.ok()) << (mechanism.ok() ? "" : mechanism.error().Text());
  return std::move(mechanism).value();
}

// A bar from a pin O to P, which a vertical rod of 1 m holds.
std::string Lever(const std::string& forces) {
  return R"(rodeira: mechanism/1
planar: true
gravity_mps2: [0, 0, 0]
points:
  O: {at_m: [0, 0, 0], fixed: true}
  P: {at_m: [1, 0, 0]}
  Q: {at_m: [1, 1, 0], fixed: true}
  R: {at_m: [0.5, 1, 0], fixed: true}
bodies: {bar: {points: [O, P], mass_kg: 1, centre_m: [0.5, 0, 0], inertia_zz_kgm2: 0.1}}
markers: {D: {body: bar, at_m: [0.5, 0, 0]}}
)" + forces +
         "outputs: {Px: joint bar P.x, Py: joint bar P.y, Ox: joint bar O.x, Oy: joint bar O.y, rod: reaction rod}\n";
}

TEST(JointForces, OfALeverAreThoseOfStatics) {
  const std::string rod = "constraints: {rod: {kind: distance, points: [P, Q]}}\n";
  const std::string middle_rod = "constraints: {rod: {kind: distance, points: [D, R]}}\n";
  const std::string down = "forces: {load: {kind: force, point: D, direction: [0, -1, 0], force_N: 100}}\n";
  const std::string at_end = "forces: {load: {kind: force, point: P, direction: [0, -1, 0], force_N: 100}}\n";
  const std::string torque = "forces: {load: {kind: torque, body: bar, axis: [0, 0, -1], torque_Nm: 50}}\n";
  const std::string motor =
      "angles: {turn: {of: [O, P]}}\nforces: {load: {kind: coordinate, coordinate: turn, torque_Nm: -50}}\n";
  const std::string pull = "forces: {load: {kind: spring, points: [D, R], stiffness_Npm: 0, preload_N: -100}}\n";
  struct {
    std::string text;
    double o_N, p_N, rod_N;
  } const cases[] = {{rod + down, 50.0, 50.0, 50.0},
                     {rod + torque, -50.0, 50.0, 50.0},
                     {rod + motor, -50.0, 50.0, 50.0},
                     {rod + pull, 50.0, 50.0, 50.0},
                     {middle_rod + at_end, -100.0, -100.0, 200.0},
                     {middle_rod + torque, -100.0, 0.0, 100.0}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.text);
    const Mechanism lever = Parsed(Lever(each.text));
    EXPECT_NEAR(Value(lever, "rod"), each.rod_N, 1e-6);
    EXPECT_NEAR(Value(lever, "Py"), each.p_N, 1e-6);
    EXPECT_NEAR(Value(lever, "Oy"), each.o_N, 1e-6);
    EXPECT_NEAR(Value(lever, "Px"), 0.0, 1e-6);
    EXPECT_NEAR(Value(lever, "Ox"), 0.0, 1e-6);
  }
}

// The multipliers of the loop through K3 at t = 0 (W. M. Lioen, J. J. B. de Swart, Test set for initial value problem
// solvers, Andrews' squeezing mechanism): the force on K3 at E. The spring pushes at D, beside the line from B to E,
// and K3 does not begin to turn, so both have opposite moments about B: that is the sign.
TEST(JointForces, OfAndrewsMechanismAreThoseOfTheTestSet) {
  std::ifstream file(std::filesystem::path(SourceDir()) / "configs/mechanisms/andrews.yaml");
  std::stringstream text;
  text << file.rdbuf();
  const Mechanism andrews = Parsed(text.str() + "  ex_N: joint K3 E.x\n  ey_N: joint K3 E.y\n");
  const Eigen::Vector2d at_E(Value(andrews, "ex_N"), Value(andrews, "ey_N"));
  EXPECT_NEAR(at_E.x(), 98.5668703962410896, 1e-4);
  EXPECT_NEAR(at_E.y(), -6.12268834425566266, 1e-4);
  constexpr double kGamma = 0.455279819163070380;
  const Eigen::Vector2d b(-0.03635, 0.03273), c(0.014, 0.072), across(std::sin(kGamma), -std::cos(kGamma)),
      along(std::cos(kGamma), std::sin(kGamma));
  const Eigen::Vector2d e = 0.035 * across, d = 0.018 * across + 0.02 * along, spring = c - b - d;
  const Eigen::Vector2d pull = 4530.0 * (spring.norm() - 0.07785) * spring.normalized();
  EXPECT_NEAR(e.x() * at_E.y() - e.y() * at_E.x(), -(d.x() * pull.y() - d.y() * pull.x()), 1e-6);
}

struct Reader {
  const Mechanism& mechanism;
  int Find(const std::string& name) const {
    const auto& entities = mechanism.system->drawing().entities;
    for (std::size_t i = 0; i < entities.size(); ++i) {
      if (entities[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "nothing is named " << name;
    return 0;
  }
  Vector3d At(const std::string& name) const { return mechanism.system->motion().At(Find(name)); }
  Vector3d Rate(const std::string& name) const { return mechanism.system->motion().RateOf(Find(name)); }
  Vector3d Acceleration(const std::string& name) const { return mechanism.system->acceleration().RateOf(Find(name)); }
  Vector3d Triple(const std::string& name) const {
    return {Value(mechanism, name + "x"), Value(mechanism, name + "y"), Value(mechanism, name + "z")};
  }
};

std::string Three(const std::string& name, const std::string& what) {
  std::string text;
  for (const char c : {'x', 'y', 'z'}) text += "  " + name + c + ": " + what + c + "\n";
  return text;
}

// A body in space on a ball joint, under its weight, a torque, a force, drag and a spring at markers, with a bob on a
// rod at a marker and a second rod at a point. Started at a random place with a random speed.
TEST(JointForces, AddUpToNewtonsAndEulersLawsInRandomStates) {
  std::mt19937_64 random(35);
  const auto draw = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  double most_N = 0.0;
  for (int turn = 0; turn < 40; ++turn) {
    SCOPED_TRACE(turn);
    const auto vector = [&draw](double size) {
      return Vector3d(draw(-size, size), draw(-size, size), draw(-size, size));
    };
    const auto list = [](const Vector3d& v) {
      std::ostringstream text;
      text.precision(17);
      text << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
      return text.str();
    };
    const Vector3d centre = vector(0.3), held = vector(0.2) + Vector3d(0.4, 0.0, 0.0), pushed = vector(0.4),
                   sprung = vector(0.4);
    const Vector3d inertia(draw(0.4, 0.6), draw(0.4, 0.6), draw(0.4, 0.6));
    const Vector3d push = vector(1.0), torque = vector(1.0);
    const double force_N = draw(-80.0, 80.0), torque_Nm = draw(-30.0, 30.0);
    Mechanism body = Parsed(
        "rodeira: mechanism/1\npoints:\n  O: {at_m: [0, 0, 0], fixed: true}\n  P: {at_m: [1, 0.2, 0.1]}\n"
        "  B: {at_m: " +
        list(held + Vector3d(0.1, 0.2, -0.8)) + ", velocity_mps: " + list(vector(1.0)) + "}\n" +
        "  S: {at_m: [0.2, 1.5, 0.4], fixed: true}\n  T: {at_m: [1.5, 0.2, 1.4]}\n"
        "vectors: {x: {direction: [1, 0, 0]}, y: {direction: [0, 1, 0]}, z: {direction: [0, 0, 1]}}\n"
        "bodies:\n  body: {points: [O, P], vectors: [x, y, z], mass_kg: 3, centre_m: " +
        list(centre) + ", inertia_kgm2: " + list(inertia) + "}\n  bob: {kind: particle, points: [B], mass_kg: 0.7}\n" +
        "  link: {kind: rod, points: [P, T], mass_kg: 0.5}\n"
        "markers:\n  C: {body: body, at_m: " +
        list(centre) + "}\n  H: {body: body, at_m: " + list(held) + "}\n  F: {body: body, at_m: " + list(pushed) +
        "}\n  K: {body: body, at_m: " + list(sprung) + "}\n" +
        "constraints: {rod: {kind: distance, points: [H, B]}}\nforces:\n  push: {kind: force, point: F, direction: " +
        list(push) + ", force_N: " + std::to_string(force_N) +
        "}\n  turn: {kind: torque, body: body, axis: " + list(torque) + ", torque_Nm: " + std::to_string(torque_Nm) +
        "}\n  spring: {kind: spring, points: [K, S], stiffness_Npm: 60, damping_Nspm: 3, free_m: 0.5}\n"
        "  air: {kind: drag, point: F, drag_area_m2: 0.8}\noutputs:\n" +
        Three("o", "joint body O.") + Three("p", "joint body P.") + Three("b", "joint bob B.") +
        Three("l", "joint link P.") + Three("e", "joint link T.") + Three("ca", "C.a") + Three("c", "C.") +
        Three("h", "H.") + Three("f", "F.") + Three("fv", "F.v") + Three("k", "K.") + "  spring: force spring\n");
    RunTo(body, 0.2, 0.0005);
    const Reader read{body};
    const Vector3d g(0.0, 0.0, -base::kGravity_mps2);
    const Vector3d spring = Value(body, "spring") * (read.At("S") - read.Triple("k")).normalized();
    const Vector3d at_f = std::stod(std::to_string(force_N)) * push.normalized() -
                          0.5 * 1.2 * 0.8 * read.Triple("fv").norm() * read.Triple("fv");
    const Vector3d rod = -(0.7 * read.Acceleration("B") - 0.7 * g);  // by the bob's own law
    EXPECT_LT((read.Triple("b") + rod).norm(), 1e-9);
    EXPECT_LT((read.Triple("p") + read.Triple("l")).norm(), 1e-3 * (1.0 + read.Triple("p").norm()));
    EXPECT_LT(read.Triple("e").norm(), 1e-3) << "the link's end is free";
    const Vector3d o = read.Triple("o"), p = read.Triple("p"), c = read.Triple("c");
    const Vector3d sum = o + p + rod + at_f + spring + 3.0 * g;
    const double size = o.norm() + p.norm() + rod.norm() + at_f.norm() + spring.norm() + 3.0 * g.norm();
    EXPECT_LT((sum - 3.0 * read.Triple("ca")).norm(), 1e-4 * size);
    const Vector3d moment = (read.At("O") - c).cross(o) + (read.At("P") - c).cross(p) +
                            (read.Triple("h") - c).cross(rod) + (read.Triple("f") - c).cross(at_f) +
                            (read.Triple("k") - c).cross(spring) +
                            std::stod(std::to_string(torque_Nm)) * torque.normalized();
    Eigen::Matrix3d rotation;
    Vector3d omega = Vector3d::Zero(), alpha = Vector3d::Zero();
    for (const auto& [axis, name] : {std::pair(0, "x"), std::pair(1, "y"), std::pair(2, "z")}) {
      rotation.col(axis) = read.At(name);
      omega += 0.5 * read.At(name).cross(read.Rate(name));
      alpha += 0.5 * read.At(name).cross(read.Acceleration(name));
    }
    const Eigen::Matrix3d world = rotation * inertia.asDiagonal() * rotation.transpose();
    EXPECT_LT((moment - world * alpha - omega.cross(world * omega)).norm(), 1e-4 * size);
    most_N = std::max(most_N, p.norm());
  }
  EXPECT_GT(most_N, 20.0);
}

}  // namespace
}  // namespace rodeira::multibody
