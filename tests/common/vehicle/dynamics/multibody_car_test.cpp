// SPDX-License-Identifier: Apache-2.0
// The multibody car (prototype): what it is made of, how it stands, drives, turns, stops and holds, and that it
// repeats.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

constexpr double kStep = 0.001;
constexpr double kG = 9.81;

std::unique_ptr<VehicleModel> Prototype() {
  auto model = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml");
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return std::move(model).value();
}

MultibodyModel& Multibody(VehicleModel& model) { return static_cast<MultibodyModel&>(model); }

void DriveFor(VehicleModel& car, ground::Ground& ground, const Controls& controls, double seconds) {
  const auto steps = static_cast<int>(std::lround(seconds / kStep));
  for (int i = 0; i < steps; ++i) car.Step(controls, ground, kStep);
}

// C6: 44 points, 7 unit vectors, 1 angle, 5 distances: 159 variables. Eleven ways to move: body 6, wheels 4,
// steering 1.
TEST(Prototype, HasTheCoordinatesOfItsSource) {
  auto car = Prototype();
  const multibody::System& system = Multibody(*car).system();
  int points = 0, vectors = 0, angles = 0, distances = 0;
  for (const auto& entity : system.drawing().entities) {
    if (entity.fixed[0] && entity.fixed[1] && entity.fixed[2]) continue;  // the world's axes
    points += entity.kind == multibody::EntityKind::kPoint;
    vectors += entity.kind == multibody::EntityKind::kVector;
    angles += entity.kind == multibody::EntityKind::kAngle;
    distances += entity.kind == multibody::EntityKind::kDistance;
  }
  EXPECT_EQ(points, 44);
  EXPECT_EQ(vectors, 7);
  EXPECT_EQ(angles, 1);
  EXPECT_EQ(distances, 5);
  EXPECT_EQ(system.variables(), 159);
  EXPECT_EQ(system.constraints().count(), 148);
  EXPECT_EQ(system.degrees_of_freedom(), 11);
}

// The prototype with other outputs than its own (lines of `outputs`).
base::Result<std::unique_ptr<VehicleModel>> WithOutputs(const std::string& outputs) {
  std::string text = base::ReadText(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml").value();
  const auto from = text.find("  outputs:\n"), to = text.find("\nbody:");
  text.replace(from, to - from, "  outputs:\n" + outputs);
  const auto path =
      std::filesystem::temp_directory_path() / ("rodeira-outputs-" + std::to_string(::getpid()) + ".yaml");
  EXPECT_TRUE(base::WriteWhole(path, text).ok());
  auto model = LoadVehicle(path);
  std::filesystem::remove(path);
  return model;
}

// C5, in a car that drives: what acts on a carrier at its points bears its weight; on the chassis, at the damper's top,
// acts the damper alone.
TEST(Prototype, ForcesInItsJointsAreOutputs) {
  auto made = WithOutputs(
      "    low_N: joint fl_carrier fl_lower_ball.z\n    high_N: joint fl_carrier fl_upper_ball.z\n    tie_N: joint "
      "fl_carrier fl_tie_outer.z\n"
      "    hub_N: joint fl_carrier fl_hub.z\n    top_x_N: joint chassis fl_damper_top.x\n    top_y_N: joint chassis "
      "fl_damper_top.y\n"
      "    top_z_N: joint chassis fl_damper_top.z\n");
  ASSERT_TRUE(made.ok()) << made.error().Text();
  VehicleModel& car = *made.value();
  EXPECT_EQ(car.output_names()[3], "hub_N");
  PlaneGround ground;
  ASSERT_TRUE(car.Initialise({}, ground).ok());
  const std::vector<double> rests = car.Outputs();
  EXPECT_NEAR(rests[0] + rests[1] + rests[2] + rests[3], 23.0 * kG, 0.1);
  const auto top = [&](const std::vector<double>& at) { return Eigen::Vector3d(at[4], at[5], at[6]).norm(); };
  EXPECT_NEAR(top(rests), car.state().wheels[kFrontLeft].suspension_N, 1.0);
  ASSERT_TRUE(car.Initialise({.speed_mps = 25.0}, ground).ok());
  Controls controls;
  controls.brake = 0.7;
  DriveFor(car, ground, controls, 0.1);
  EXPECT_GT(std::fabs(car.state().wheels[kFrontLeft].damper_N), 100.0) << "it dives";
  EXPECT_NEAR(top(car.Outputs()), car.state().wheels[kFrontLeft].suspension_N, 1.0);
  const auto wrong = WithOutputs("    low_N: joint fl_carrier fl_lower_bal.z\n");
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().Text().find("did you mean 'fl_lower_ball'?"), std::string::npos) << wrong.error().Text();
  EXPECT_EQ(wrong.error().exit_status(), 2);
}

// The tie rod has joints at both ends. What it passes on across itself is its own 0.8 kg alone: of a uniform rod with
// ends accelerated by a and b, the end at b takes m (a/6 + b/3 - g/2). Found to 1 N of the some thousands along it. The
// brake's torque and the tyre's moment on the carrier are no forces of its joints. It passes the world's origin: far
// from it, coordinates are rounded more, which the multipliers of a step show.
TEST(Prototype, ATieRodBearsOnlyItselfAcrossWhileTheCarBrakes) {
  std::string outputs;
  for (const char c : {'x', 'y', 'z'}) outputs += fmt::format("    tie_{0}_N: joint fl_carrier fl_tie_outer.{0}\n", c);
  auto made = WithOutputs(outputs);
  ASSERT_TRUE(made.ok()) << made.error().Text();
  VehicleModel& car = *made.value();
  PlaneGround ground;
  ASSERT_TRUE(car.Initialise({.x_m = -10.0, .speed_mps = 100.0 / 3.6}, ground).ok());
  const multibody::System& system = Multibody(car).system();
  const auto of = [&](const auto& coordinates, const std::string& name) {
    const auto& entities = system.drawing().entities;
    for (std::size_t i = 0; i < entities.size(); ++i)
      if (entities[i].name == name)
        return Eigen::Vector3d(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    ADD_FAILURE() << name;
    return Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  Controls controls;
  controls.brake = 0.8;
  double along_N = 0.0, across_N = 0.0;
  for (int i = 0; i < 20; ++i) {
    DriveFor(car, ground, controls, 0.05);
    const std::vector<double> at = car.Outputs();
    const Eigen::Vector3d tie(at[0], at[1], at[2]);
    const Eigen::Vector3d rod = (of(system.q(), "fl_tie_outer") - of(system.q(), "fl_rack")).normalized();
    const Eigen::Vector3d inertia = -0.8 * (of(system.qdd(), "fl_rack") / 6.0 + of(system.qdd(), "fl_tie_outer") / 3.0 +
                                            Eigen::Vector3d(0.0, 0.0, 0.5 * kG));
    const auto across = [&](const Eigen::Vector3d& force) { return Eigen::Vector3d(force - force.dot(rod) * rod); };
    EXPECT_LT((across(tie) - across(inertia)).norm(), 1.0) << "at " << 0.05 * (i + 1) << " s";
    along_N = std::max(along_N, std::fabs(tie.dot(rod)));
    across_N = std::max(across_N, across(inertia).norm());
  }
  EXPECT_GT(along_N, 100.0);
  EXPECT_GT(across_N, 3.0);
}

TEST(PrototypeAtRest, StandsInEquilibrium) {
  auto car = Prototype();
  const double weight = Multibody(*car).settings().mass_kg * kG;
  for (const auto& [slope_x, slope_y] : {std::pair(0.0, 0.0), std::pair(0.1, 0.0), std::pair(-0.05, 0.08)}) {
    PlaneGround ground(Eigen::Vector3d(0, 0, 12.5), slope_x, slope_y);
    ASSERT_TRUE(car->Initialise({.x_m = 100.0, .y_m = -7.0, .heading_rad = 0.7}, ground).ok());
    const VehicleState& s = car->state();
    EXPECT_NEAR(s.p_WB_W.x(), 100.0, 1e-9);
    EXPECT_NEAR(s.p_WB_W.y(), -7.0, 1e-9);
    EXPECT_NEAR(s.heading_rad(), 0.7, 1e-9);
    double most = 0.0;
    for (const double each : Multibody(*car).system().qdd()) most = std::max(most, std::fabs(each));
    EXPECT_LE(most, 1e-6) << slope_x;
    if (slope_x == 0.0) {
      double sum = 0.0;
      for (const auto& wheel : s.wheels) sum += wheel.load_N;
      EXPECT_NEAR(sum, weight, 1e-9 * weight);
      EXPECT_NEAR(s.p_WB_W.z(), 12.5, 1e-7);
      EXPECT_NEAR(s.pitch_rad(), 0.0, 1e-7);
    }
  }
}

// Braking: the body pitches nose down, and what the front axle gains is m a h / L.
TEST(PrototypeDynamics, LoadTransferOfBraking) {
  auto car = Prototype();
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  const MultibodySettings& settings = Multibody(*car).settings();
  double front_at_rest = 0.0;
  for (const auto i : {kFrontLeft, kFrontRight}) front_at_rest += car->state().wheels[i].load_N;
  ASSERT_TRUE(car->Initialise({.speed_mps = 25.0}, ground).ok());
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = 0;
  controls.brake = 0.35;
  DriveFor(*car, ground, controls, 1.5);
  const VehicleState& s = car->state();
  double front = 0.0, along = 0.0, all = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    along += s.wheels[i].longitudinal_N;
    all += s.wheels[i].load_N;
    if (i < 2) front += s.wheels[i].load_N;
  }
  // Height and place of the whole car's mass, from the mechanism as drawn.
  double moment = 0.0;
  for (const auto& body : settings.mechanism.bodies) {
    std::vector<double> drawn;
    for (const auto& entity : settings.mechanism.entities)
      drawn.insert(drawn.end(), entity.at.data(), entity.at.data() + 3);
    moment += body.mass_kg * multibody::Evaluate(body.centre, drawn.data()).z();
  }
  const double height = moment / settings.mass_kg;
  EXPECT_GT(s.pitch_rad(), 0.003);
  EXPECT_LT(along, -2000.0);
  EXPECT_NEAR(all, settings.mass_kg * kG, 0.01 * settings.mass_kg * kG);
  // Air drag acts at its own height; the rest at the mass's. The body's lean moves it a little.
  const double deceleration = -s.a_WB_B().x();
  const double expected = (settings.mass_kg * deceleration * height - s.drag_N * settings.drag_point_m.z()) /
                          settings.dimensions.wheelbase_m;
  EXPECT_NEAR(front - front_at_rest, expected, 0.05 * expected);
  EXPECT_NEAR(-along + s.drag_N, settings.mass_kg * deceleration, 0.03 * settings.mass_kg * deceleration);
}

TEST(PrototypeDynamics, TurnsTowardsTheWheelAndLeansOut) {
  auto car = Prototype();
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.speed_mps = 15.0}, ground).ok());
  Controls controls;
  controls.steering_wheel_rad = 0.5;
  controls.throttle = 0.15;
  DriveFor(*car, ground, controls, 3.0);
  const VehicleState& s = car->state();
  const MultibodySettings& settings = Multibody(*car).settings();
  EXPECT_GT(s.w_WB_B.z(), 0.1);
  EXPECT_GT(s.roll_rad(), 0.01);
  EXPECT_LT(s.steering_torque_Nm, 0.0);  // the road turns the wheel back
  EXPECT_GT(s.wheels[kFrontRight].load_N, s.wheels[kFrontLeft].load_N);
  const double ay = s.w_WB_B.z() * s.speed_mps();
  double side = 0.0;
  for (const auto& wheel : s.wheels)
    side += wheel.lateral_N * std::cos(wheel.steer_rad) + wheel.longitudinal_N * std::sin(wheel.steer_rad);
  EXPECT_NEAR(side, settings.mass_kg * ay, 0.05 * side);
  // The steering ratio that the file names is that of rack and steering arms.
  const double steer = 0.5 * (s.wheels[kFrontLeft].steer_rad + s.wheels[kFrontRight].steer_rad);
  EXPECT_NEAR(0.5 / steer, settings.steering.ratio, 0.15 * settings.steering.ratio);
}

// Force feedback in a steady bend against the statics of the linkage: what tyre, weight and turning do about the
// kingpin (the line through both ball joints) the tie rod holds, the rods push the rack, and its pinion turns the
// column.
TEST(PrototypeDynamics, SteeringTorqueIsThatOfKingpinTieRodsAndPinion) {
  auto car = Prototype();
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.speed_mps = 15.0}, ground).ok());
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = car->state().gear;
  controls.throttle = 0.2;
  for (const double wheel_rad : {0.3, 0.6}) {
    controls.steering_wheel_rad = wheel_rad;
    DriveFor(*car, ground, controls, 4.0);
    const VehicleState& s = car->state();
    const MultibodyModel& model = Multibody(*car);
    const multibody::Drawing& drawing = model.system().drawing();
    const multibody::Motion motion = model.system().motion();
    const auto at = [&](const std::string& name) -> Eigen::Vector3d {
      for (std::size_t i = 0; i < drawing.entities.size(); ++i) {
        if (drawing.entities[i].name == name) return motion.At(static_cast<int>(i));
      }
      ADD_FAILURE() << name;
      return Eigen::Vector3d::Zero();
    };
    const Eigen::Vector3d turning = s.q_WB * s.w_WB_B,
                          pull = Eigen::Vector3d(0, 0, -kG) - turning.cross(s.v_WB_W);  // weight and centrifugal
    const Eigen::Vector3d rack_way = at("left");
    double pinion_N = -3.0 * pull.dot(rack_way);  // on the rack along its way
    for (const std::size_t i : {kFrontLeft, kFrontRight}) {
      const std::string side = i == kFrontLeft ? "fl_" : "fr_";
      const WheelState& w = s.wheels[i];
      const Eigen::Vector3d low = at(side + "lower_ball"), kingpin = (at(side + "upper_ball") - low).normalized();
      const Eigen::Vector3d hub = at(side + "hub"), axle = at(side + "axle"),
                            along = axle.cross(w.contact_normal_W).normalized();
      const Eigen::Vector3d force =
          w.longitudinal_N * along + w.lateral_N * w.contact_normal_W.cross(along) + w.load_N * w.contact_normal_W;
      Eigen::Vector3d about_hub = (w.contact_W - hub).cross(force) + w.aligning_Nm * w.contact_normal_W;
      about_hub -= about_hub.dot(axle) * axle;  // the wheel turns freely
      about_hub -= model.settings().wheel.inertia_kgm2 * w.spin_radps * turning.cross(axle);
      const auto& carrier = drawing.bodies[static_cast<std::size_t>(model.settings().wheels[i].carrier)];
      const Eigen::Vector3d outer = at(side + "tie_outer"), inner = at(side + "rack"),
                            rod = (outer - inner).normalized();
      const double moment = (about_hub + (hub - low).cross(force) +
                             (multibody::Evaluate(carrier.centre, motion.q) - low).cross(carrier.mass_kg * pull) +
                             (outer - low).cross(0.4 * pull))
                                .dot(kingpin);
      const double in_rod_N = -moment / (outer - low).cross(rod).dot(kingpin);
      pinion_N += (in_rod_N * rod - 0.4 * pull).dot(rack_way);
    }
    EXPECT_GT(std::fabs(pinion_N), 50.0);
    EXPECT_NEAR(s.steering_torque_Nm, 0.0069 * pinion_N, 0.01 * std::fabs(0.0069 * pinion_N) + 0.01) << wheel_rad;
    EXPECT_LT(s.steering_torque_Nm, 0.0);
  }
}

// Undivided steps of 10 ms against a tenth of a millisecond, steering a function of time (each step gets the angle at
// its end): yaw rate within 1 % RMS, path within 2 cm, at most four turns, and steps of half the length are off by a
// quarter, as tyres, wheels and mechanism are of second order.
TEST(PrototypeDynamics, LongStepsAgreeWithATenthOfAMillisecond) {
  PlaneGround ground;
  struct Point {
    double yaw_rate_radps = 0.0;
    Eigen::Vector3d at_m = Eigen::Vector3d::Zero();
  };
  const auto drive = [&](int steps_in_10_ms) {
    MultibodySettings settings = Multibody(*Prototype()).settings();
    settings.longest_substep_s = 0.01;
    MultibodyModel car(settings);
    EXPECT_TRUE(car.Build().ok());
    EXPECT_TRUE(car.Initialise({.speed_mps = 15.0}, ground).ok());
    const double step_s = 0.01 / steps_in_10_ms;
    std::vector<Point> points;
    Controls controls;
    controls.throttle = 0.15;
    for (int i = 1; i <= 400 * steps_in_10_ms; ++i) {
      controls.steering_wheel_rad = 0.8 * std::sin(2.0 * step_s * i);
      car.Step(controls, ground, step_s);
      EXPECT_TRUE(car.report().converged);
      EXPECT_LE(car.report().iterations, 4);
      if (i % steps_in_10_ms != 0) continue;
      EXPECT_LE(car.system().Violation(), 1e-8);
      EXPECT_LE(car.system().RateViolation(), 1e-6);
      points.push_back({car.state().w_WB_B.z(), car.state().p_WB_W});
    }
    return points;
  };
  const std::vector<Point> fine = drive(100);
  const auto compare = [&fine](const std::vector<Point>& coarse, double& yaw_rms) {
    double square = 0.0, difference = 0.0, path_m = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
      square += std::pow(fine[i].yaw_rate_radps, 2);
      difference += std::pow(fine[i].yaw_rate_radps - coarse[i].yaw_rate_radps, 2);
      path_m = std::max(path_m, (fine[i].at_m - coarse[i].at_m).norm());
    }
    yaw_rms = std::sqrt(difference / square);
    return path_m;
  };
  double yaw_rms = 0.0, yaw_rms_half = 0.0;
  const double path_m = compare(drive(1), yaw_rms), path_half_m = compare(drive(2), yaw_rms_half);
  EXPECT_LE(yaw_rms, 0.01);
  EXPECT_LE(path_m, 0.02);
  EXPECT_GT(yaw_rms / yaw_rms_half, 3.0);
  EXPECT_GT(path_m / path_half_m, 3.0);
}

// The prototype's mechanism without dampers, stops, weight and ground; its springs are released and swing by 250 J.
// Thrown at 20 m/s its energy stays within 1e-5 over 10 s at 1 ms. At rest as a whole, where rounding of large speeds
// does not count, it is off by at most 5e-4 of what swings, and by a quarter of that where the step is halved.
TEST(PrototypeDynamics, WithoutDampersItsEnergyStays) {
  std::string text = base::ReadText(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml").value();
  text = std::regex_replace(text, std::regex(R"(damper_mps_N: \[\[.*?\]\])"), "damping_Nspm: 0");
  text = std::regex_replace(text,
                            std::regex(R"(stops_m: \[[^\]]*\], stop_stiffness_Npm: [0-9]*, stop_damping_Nspm: [0-9]*)"),
                            "stops_m: [0.05, 0.9], stop_stiffness_Npm: 1000, stop_damping_Nspm: 0");
  const auto path =
      std::filesystem::temp_directory_path() / ("rodeira-undamped-" + std::to_string(::getpid()) + ".yaml");
  ASSERT_TRUE(base::WriteWhole(path, text).ok());
  const auto car = LoadVehicle(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(car.ok()) << car.error().Text();
  multibody::Drawing drawing = Multibody(*car.value()).settings().mechanism;
  drawing.gravity_mps2.setZero();
  struct Found {
    double energy_J = 0.0, off_J = 0.0, swings_J = 0.0;
  };
  const auto run = [&](double speed_mps, double step_s) {
    Found found;
    auto made = multibody::System::Make(drawing);
    EXPECT_TRUE(made.ok());
    multibody::System& system = *made.value();
    EXPECT_TRUE(system.Start().ok());
    for (std::size_t i = 0; i < drawing.entities.size(); ++i) {
      if (drawing.entities[i].kind == multibody::EntityKind::kPoint) system.qd()[3 * i] += speed_mps;
    }
    const double thrown_J = system.KineticEnergy();
    found.energy_J = system.Energy();
    for (int i = 0; i * step_s < 10.0 - 1e-9; ++i) {
      EXPECT_TRUE(system.Step(step_s).converged);
      found.off_J = std::max(found.off_J, std::fabs(system.Energy() - found.energy_J));
      found.swings_J = std::max(found.swings_J, system.KineticEnergy() - thrown_J);
    }
    return found;
  };
  const Found thrown = run(20.0, 0.001), coarse = run(0.0, 0.001), fine = run(0.0, 0.0005);
  EXPECT_LE(thrown.off_J, 1e-5 * thrown.energy_J);
  EXPECT_GT(coarse.swings_J, 200.0);
  EXPECT_LE(coarse.off_J, 5e-4 * coarse.swings_J);
  EXPECT_NEAR(coarse.off_J / fine.off_J, 4.0, 0.2);
}

// Other suspensions, driven by the front wheels: a matter of the file.
TEST(ASecondCar, IsMadeByItsFileAlone) {
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/double_wishbones.yaml");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  VehicleModel& car = *loaded.value();
  EXPECT_EQ(Multibody(car).system().degrees_of_freedom(), 11);
  PlaneGround ground;
  ASSERT_TRUE(car.Initialise({}, ground).ok());
  double most = 0.0;
  EXPECT_GT(Multibody(car).system().qdd().size(), 11u) << "of all coordinates, more than the degrees of freedom";
  for (const double each : Multibody(car).system().qdd()) most = std::max(most, std::fabs(each));
  EXPECT_LE(most, 1e-6);
  Controls controls;
  controls.throttle = 0.6;
  DriveFor(car, ground, controls, 6.0);
  EXPECT_GT(car.state().speed_mps(), 10.0);
  EXPECT_GT(car.state().wheels[kFrontLeft].drive_torque_Nm, 10.0);
  EXPECT_EQ(car.state().wheels[kRearLeft].drive_torque_Nm, 0.0);
  controls.steering_wheel_rad = 0.4;
  DriveFor(car, ground, controls, 2.0);
  EXPECT_GT(car.state().w_WB_B.z(), 0.05);
  EXPECT_GT(car.state().roll_rad(), 0.003);
}

// What is wrong with a car's mechanism is told with its place, as for any mechanism.
TEST(ASecondCar, WrongFilesAreRefused) {
  const auto root = std::filesystem::path(SourceDir());
  const std::string good = base::ReadText(root / "configs/vehicles/prototype.yaml").value();
  const auto path = std::filesystem::temp_directory_path() / ("rodeira-car-" + std::to_string(::getpid()) + ".yaml");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    EXPECT_TRUE(base::WriteWhole(path, text).ok());
    const auto car = LoadVehicle(path);
    EXPECT_FALSE(car.ok()) << from;
    if (car.ok()) return std::string();
    EXPECT_EQ(car.error().exit_status(), 2);
    EXPECT_NE(car.error().Text().find(".yaml:"), std::string::npos) << car.error().Text();
    return car.error().Text();
  };
  EXPECT_NE(refusal("carrier: fl_carrier", "carrier: fl_carier").find("did you mean 'fl_carrier'"), std::string::npos);
  EXPECT_NE(refusal("axle: rl_axle", "axle: up").find("drawn to the left"), std::string::npos);
  EXPECT_NE(refusal("mass_kg: 512", "mass_kg: -512").find("-512"), std::string::npos);
  EXPECT_NE(refusal("  constraints:\n",
                    "  constraints:\n    more: {kind: distance, points: [fl_lower_front, fl_lower_rear]}\n")
                .find("redundant"),
            std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace rodeira::dynamics
