// SPDX-License-Identifier: Apache-2.0
// The car in ODE: how it stands, drives, turns, stops, holds and falls over, and that it repeats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ode/misc.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "common/core/base/files.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/same_bits.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;
using ::testing::HasSubstr;

constexpr double kStep = 0.001;
constexpr double kG = 9.81;
const auto kFile = std::filesystem::path(SourceDir()) / "configs/vehicles/ode.yaml";

OdeSettings Settings() {
  auto model = LoadVehicle(kFile);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
  return static_cast<const OdeModel&>(*model.value()).settings();
}

std::unique_ptr<OdeModel> Car(const OdeSettings& settings = Settings()) {
  auto car = std::make_unique<OdeModel>(settings);
  EXPECT_TRUE(car->Build().ok());
  return car;
}

void DriveFor(VehicleModel& car, ground::Ground& ground, const Controls& controls, double seconds) {
  const auto steps = static_cast<int>(std::lround(seconds / kStep));
  for (int i = 0; i < steps; ++i) car.Step(controls, ground, kStep);
}

Controls Rolling(double steering_wheel_rad = 0.0) {
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = 0;
  controls.steering_wheel_rad = steering_wheel_rad;
  return controls;
}

// The parts together have the mass, centre of gravity and inertia that the file says of the whole car.
TEST(OdeCar, ItsPartsAreTheWholeCar) {
  const OdeSettings settings = Settings();
  const OdeChassis chassis = ChassisOf(settings);
  const BodySettings& body = settings.car.body;
  double mass = chassis.mass_kg;
  Eigen::Vector3d first = chassis.mass_kg * chassis.p_BG_B;
  for (std::size_t i = 0; i < kWheels; ++i) {
    mass += settings.wheel_mass_kg;
    first += settings.wheel_mass_kg * HubAtRest_B(settings.car, i);
  }
  EXPECT_NEAR(mass, body.mass_kg, 1e-9);
  const Eigen::Vector3d centre = first / mass;
  EXPECT_NEAR(centre.x(), 0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 1e-12);
  EXPECT_NEAR(centre.z(), body.cg_height_m, 1e-12);
  double yaw = chassis.inertia_kgm2.z() + chassis.mass_kg * (chassis.p_BG_B - centre).head<2>().squaredNorm();
  for (std::size_t i = 0; i < kWheels; ++i) {
    yaw += settings.wheel_across_kgm2 +
           settings.wheel_mass_kg * (HubAtRest_B(settings.car, i) - centre).head<2>().squaredNorm();
  }
  EXPECT_NEAR(yaw, body.yaw_inertia_kgm2, 1e-9);
}

// INI by solving: with the brakes on, nothing accelerates in the first step.
TEST(OdeCarAtRest, StandsInEquilibrium) {
  auto car = Car();
  const double weight = car->settings().car.body.mass_kg * kG;
  for (const auto& [slope_x, slope_y] : {std::pair(0.0, 0.0), std::pair(0.1, 0.0), std::pair(-0.05, 0.08)}) {
    PlaneGround ground(Eigen::Vector3d(0, 0, 12.5), slope_x, slope_y);
    ASSERT_TRUE(car->Initialise({.x_m = 100.0, .y_m = -7.0, .heading_rad = 0.7}, ground).ok());
    const VehicleState s = car->state();
    EXPECT_NEAR(s.p_WB_W.x(), 100.0, 1e-9);
    EXPECT_NEAR(s.p_WB_W.y(), -7.0, 1e-9);
    EXPECT_NEAR(s.heading_rad(), 0.7, 1e-9);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& wheel : s.wheels) {
      const Eigen::Vector3d axle = s.q_WB * Eigen::Vector3d::UnitY();
      const Eigen::Vector3d along = axle.cross(wheel.contact_normal_W).normalized();
      sum += wheel.load_N * wheel.contact_normal_W + wheel.longitudinal_N * along +
             wheel.lateral_N * wheel.contact_normal_W.cross(along);
    }
    EXPECT_NEAR(sum.z(), weight, 1e-9 * weight);
    EXPECT_NEAR(sum.head<2>().norm(), 0.0, 1e-6);
    if (slope_x == 0.0) {
      EXPECT_NEAR(s.p_WB_W.z(), 12.5, 1e-9);
      EXPECT_NEAR(s.pitch_rad(), 0.0, 1e-9);
    }
    Controls controls = Rolling();
    controls.brake = 1.0;
    car->Step(controls, ground, kStep);
    EXPECT_LE(car->state().a_WB_W.norm(), 1e-6) << slope_x;
    EXPECT_LE(car->state().alpha_WB_B.norm(), 1e-6) << slope_x;
  }
}

// r / delta = V / (L + Kus V²), Kus = (m/L)(b/Cf - a/Cr), stiffness = the curve's slope at the loads at rest.
TEST(OdeCarDynamics, BelowOneMetrePerSecondSquaredItIsTheClosedForm) {
  OdeSettings settings = Settings();
  settings.car.body.drag_area_m2 = 0.0;
  settings.car.wheel.rolling_resistance = 0.0;
  auto car = Car(settings);
  PlaneGround ground;
  const BodySettings& body = settings.car.body;
  const double a = body.cg_to_front_axle_m, l = body.wheelbase_m, b = l - a, m = body.mass_kg;
  const double cf = 2 * CorneringStiffness(settings.car.tyre[0], m * kG * b / l / 2);
  const double cr = 2 * CorneringStiffness(settings.car.tyre[1], m * kG * a / l / 2);
  // Each side force acts a pneumatic trail behind its wheel.
  const double trail = TrailAtNoSlip(settings.car.tyre[0], m * kG * b / l / 2), front = a - trail,
               rear = b + TrailAtNoSlip(settings.car.tyre[1], m * kG * a / l / 2);
  const double kus = m / l * (rear / cf - front / cr);
  for (const double speed : {5.0, 15.0, 30.0, 45.0}) {
    ASSERT_TRUE(car->Initialise({.speed_mps = speed}, ground).ok());
    const double steer = 0.4 * (l + kus * speed * speed) / (speed * speed);  // 0.4 m/s²
    DriveFor(*car, ground, Rolling(steer * settings.car.steering.ratio), 6.0);
    const double v = car->state().speed_mps();
    const double expected = v / (l + kus * v * v);
    EXPECT_LT(std::fabs(car->state().w_WB_B.z() * v), 0.5);
    EXPECT_NEAR(car->state().w_WB_B.z() / steer, expected, 0.05 * expected) << speed;
    // The front axle bears m b / L of the lateral acceleration, by both trails: the tyres hardly slide.
    const SteeringSettings& steering = settings.car.steering;
    const double feedback =
        -((steering.mechanical_trail_m + trail) * m * rear / l * car->state().w_WB_B.z() * v +
          2.0 * TwistOnABend(settings.car.tyre[0], m * kG * b / l / 2, car->state().w_WB_B.z() / v)) /
        steering.ratio;
    EXPECT_NEAR(car->state().steering_torque_Nm, feedback, 0.03 * std::fabs(feedback)) << speed;
  }
}

// Newton on the whole car: what the tyres and the air do is mass times acceleration; what the front axle gains is m a h
// / L.
TEST(OdeCarDynamics, LoadTransferOfBraking) {
  auto car = Car();
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  const BodySettings& body = car->settings().car.body;
  const double front_at_rest = 2.0 * car->state().wheels[kFrontLeft].load_N;
  ASSERT_TRUE(car->Initialise({.speed_mps = 25.0}, ground).ok());
  Controls controls = Rolling();
  controls.brake = 0.4;
  DriveFor(*car, ground, controls, 1.5);
  const VehicleState& s = car->state();
  double front = 0.0, along = 0.0, all = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    along += s.wheels[i].longitudinal_N;
    all += s.wheels[i].load_N;
    if (i < 2) front += s.wheels[i].load_N;
  }
  const double deceleration = -s.a_WB_W.x();
  EXPECT_GT(deceleration, 3.0);
  EXPECT_GT(s.pitch_rad(), 0.003);
  EXPECT_NEAR(all, body.mass_kg * kG, 0.003 * body.mass_kg * kG);
  EXPECT_NEAR(-along + s.drag_N, body.mass_kg * deceleration, 0.01 * body.mass_kg * deceleration);
  const double gained = body.mass_kg * deceleration * body.cg_height_m / body.wheelbase_m;
  EXPECT_NEAR(front - front_at_rest, gained, 0.05 * gained);
}

TEST(OdeCarDynamics, TurnsTowardsTheWheelAndLeansOut) {
  auto car = Car();
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.speed_mps = 15.0}, ground).ok());
  Controls controls;
  controls.steering_wheel_rad = 0.8;
  controls.throttle = 0.2;
  DriveFor(*car, ground, controls, 3.0);
  const VehicleState& s = car->state();
  EXPECT_GT(s.w_WB_B.z(), 0.1);
  EXPECT_GT(s.roll_rad(), 0.01);
  EXPECT_LT(s.steering_torque_Nm, 0.0);
  EXPECT_GT(s.wheels[kFrontRight].load_N, s.wheels[kFrontLeft].load_N);
  EXPECT_NEAR(s.wheels[kFrontLeft].steer_rad, 0.8 / car->settings().car.steering.ratio, 1e-4);
  EXPECT_NEAR(s.wheels[kRearLeft].steer_rad, 0.0, 1e-4);
  double side = 0.0;
  for (const auto& wheel : s.wheels)
    side += wheel.lateral_N * std::cos(wheel.steer_rad) + wheel.longitudinal_N * std::sin(wheel.steer_rad);
  EXPECT_NEAR(side, car->settings().car.body.mass_kg * s.w_WB_B.z() * s.speed_mps(), 0.05 * side);
}

// The body is a box that the ground bears: on its roof the car comes to rest above the ground.
TEST(OdeCarDynamics, OnItsRoofItComesToRest) {
  auto car = Car();
  PlaneGround ground;
  // Thrown sideways onto ground that trips it: a half track over the height of its centre of gravity is 1.3 g.
  PlaneGround sticky(Eigen::Vector3d::Zero(), 0.0, 0.0, 3.0);
  ASSERT_TRUE(car->Initialise({.speed_mps = 3.0, .lateral_speed_mps = 14.0}, sticky).ok());
  DriveFor(*car, sticky, Rolling(), 1.0);
  for (int i = 0; i < 8000; ++i) {
    car->Step(Rolling(), ground, kStep);
    ASSERT_TRUE(car->state().p_WB_W.allFinite());
  }
  const VehicleState& s = car->state();
  EXPECT_LT(s.v_WB_W.norm(), 0.2);
  const Eigen::Vector3d up = s.q_WB * Eigen::Vector3d::UnitZ();
  EXPECT_LT(up.z(), 0.5) << "it lies on its side or its roof";
  // Every corner of the box is above the ground but for a little penetration.
  const VehicleDimensions& d = car->dimensions();
  for (const double x : {d.front_m, -d.rear_m}) {
    for (const double y : {-0.5 * d.width_m, 0.5 * d.width_m}) {
      for (const double z : {car->settings().clearance_m, d.height_m}) {
        EXPECT_GT((s.p_WB_W + s.q_WB * Eigen::Vector3d(x, y, z)).z(), -0.02);
      }
    }
  }
}

// ODE's random numbers, what other cars of the process do, and what a car did before do not matter.
TEST(OdeCarBits, RestoredItGoesOnWithTheSameBits) {
  auto first = Car();
  auto second = Car();
  auto other = Car();
  HillGround ground(3, {});
  ASSERT_TRUE(first->Initialise({.speed_mps = 10.0}, ground).ok());
  ASSERT_TRUE(second->Initialise({.x_m = 7.0, .speed_mps = 3.0}, ground).ok());
  ASSERT_TRUE(other->Initialise({.x_m = -5.0}, ground).ok());
  Controls controls;
  controls.throttle = 0.5;
  for (int i = 0; i < 700; ++i) {
    controls.steering_wheel_rad = 0.01 * (i % 90);
    first->Step(controls, ground, kStep);
    if (i < 50) second->Step(controls, ground, kStep);
  }
  ExpectTheSameBitsFromASnapshot(*first, *second, 1000, [&](VehicleModel& car, int i) {
    controls.steering_wheel_rad = 0.01 * (i % 70);
    dRandSetSeed(&car == first.get() ? 1UL : static_cast<unsigned long>(i) + 17);
    car.Step(controls, ground, kStep);
    if (&car == first.get()) other->Step(controls, ground, kStep);
  });
}

// The same where the body lies on the ground: contact joints leave nothing behind.
TEST(OdeCarBits, RestoredInACrashItGoesOnWithTheSameBits) {
  HillGround ground(5, {.amplitude_m = 3.0, .terrace_m = 1.0});
  auto first = Car();
  auto second = Car();
  ASSERT_TRUE(first->Initialise({.speed_mps = 25.0}, ground).ok());
  Controls controls;
  controls.throttle = 1.0;
  controls.steering_wheel_rad = 3.0;
  for (int i = 0; i < 1200; ++i) first->Step(controls, ground, kStep);
  ExpectTheSameBitsFromASnapshot(*first, *second, 1000,
                                 [&](VehicleModel& car, int) { car.Step(controls, ground, kStep); });
}

TEST(OdeCarFile, RefusalsNamePlaceAndRemedy) {
  const std::string good = base::ReadText(kFile).value();
  const auto path = std::filesystem::temp_directory_path() / ("rodeira-ode-" + std::to_string(::getpid()) + ".yaml");
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
    EXPECT_THAT(car.error().Text(), HasSubstr(".yaml:"));
    return car.error().Text();
  };
  EXPECT_THAT(refusal("wheel_mass_kg: 16", "wheel_mass_kg: 300"), HasSubstr("not below 'body.mass_kg'"));
  EXPECT_THAT(refusal("roll_inertia_kgm2: 360", "roll_inertia_kgm2: 20"), HasSubstr("more inertia"));
  EXPECT_THAT(refusal("mass_kg: 1050", "mass_kg: -1050"), HasSubstr("-1050"));
  EXPECT_THAT(refusal("asymptote_slip: 0.5,", "asymptote_slip: 0.05,"), HasSubstr("not above 'extremum_slip'"));
  EXPECT_THAT(refusal("    slip_curve:\n", "    magic_formula: {FNOMIN: 3000}\n    slip_curve:\n"),
              HasSubstr("stands beside 'slip_curve'"));
  EXPECT_THAT(refusal("clearance_m: 0.16", "clearence_m: 0.16"), HasSubstr("clearance_m"));
  std::filesystem::remove(path);
}

// One car in several models: a file names the others.
TEST(VehicleModels, AFileNamesTheSameCarInOtherModels) {
  const auto configs = std::filesystem::path(SourceDir()) / "configs/vehicles";
  const auto ode = LoadVehicle(configs / "default.yaml", "ode");
  ASSERT_TRUE(ode.ok()) << ode.error().Text();
  EXPECT_NE(dynamic_cast<const OdeModel*>(ode.value().get()), nullptr);
  const auto own = LoadVehicle(configs / "default.yaml", "bicycle");
  ASSERT_TRUE(own.ok());
  EXPECT_EQ(ode.value()->dimensions().wheelbase_m, own.value()->dimensions().wheelbase_m);
  const auto unknown = LoadVehicle(configs / "default.yaml", "multibdy");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().exit_status(), 2);
  EXPECT_THAT(unknown.error().Text(), HasSubstr("did you mean 'multibody'?"));
  const auto path = std::filesystem::temp_directory_path() / ("rodeira-models-" + std::to_string(::getpid()) + ".yaml");
  ASSERT_TRUE(base::WriteWhole(path, "rodeira: vehicle/1\nmodel: bicycle\nmodels: {ode: " +
                                         (configs / "default.yaml").string() + "}\n")
                  .ok());
  EXPECT_THAT(LoadVehicle(path, "ode").error().Text(), HasSubstr("'model' is 'bicycle'; 'ode' was expected"));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace rodeira::dynamics
