// SPDX-License-Identifier: Apache-2.0
// Bends: the single-track car's closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

Controls Steering(double wheel_rad) {
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = 0;
  controls.steering_wheel_rad = wheel_rad;
  return controls;
}

BicycleSettings WithoutLosses(BicycleSettings settings) {
  settings.body.drag_area_m2 = 0.0;
  settings.wheel.rolling_resistance = 0.0;
  return settings;
}

// r / delta = V / (L + Kus V²), Kus = (m/L)(b/Cf - a/Cr), stiffness = the formula's slope at the loads at rest.
TEST(BicycleLateral, SteadyYawRateIsTheClosedForm) {
  const BicycleSettings settings = WithoutLosses(DefaultSettings());
  PlaneGround ground;
  const double a = 1.0, b = 1.46, l = 2.46, m = settings.body.mass_kg;
  const double cf = 2 * CorneringStiffness(settings.tyre[0].formula, m * kG_mps2 * b / l / 2);
  const double cr = 2 * CorneringStiffness(settings.tyre[1].formula, m * kG_mps2 * a / l / 2);
  // Each side force acts a pneumatic trail behind its wheel.
  const double trail = TrailAtNoSlip(settings.tyre[0], m * kG_mps2 * b / l / 2), front = a - trail,
               rear = b + TrailAtNoSlip(settings.tyre[1], m * kG_mps2 * a / l / 2);
  const double kus = m / l * (rear / cf - front / cr);
  for (const double speed : {5.0, 15.0, 30.0, 45.0}) {
    BicycleModel car = PlacedCar(settings, ground, {.speed_mps = speed});
    const double expected = speed / (l + kus * speed * speed);
    const double steer = 0.4 / (expected * speed);  // 0.4 m/s²
    Drive(car, ground, Steering(steer * settings.steering.ratio), 8.0);
    const VehicleState& s = car.state();
    EXPECT_LT(std::fabs(s.w_WB_B.z() * s.speed_mps()), 0.5);
    EXPECT_NEAR(s.w_WB_B.z() / steer, expected, 0.02 * expected) << speed;
    // The front axle bears m b / L of the lateral acceleration, by both trails: the tyres hardly slide.
    const SteeringSettings& steering = settings.steering;
    const double feedback =
        -((steering.mechanical_trail_m + trail) * m * rear / l * s.w_WB_B.z() * s.speed_mps() +
          2.0 * TwistOnABend(settings.tyre[0], m * kG_mps2 * b / l / 2, s.w_WB_B.z() / s.speed_mps())) /
        steering.ratio;
    EXPECT_NEAR(s.steering_torque_Nm, feedback, 0.03 * std::fabs(feedback)) << speed;
    // beta / delta at the centre of gravity, = (b - a m V² / (L Cr)) / (L + Kus V²).
    const double beta = (s.v_WB_B().y() + s.w_WB_B.z() * (l / 2 - a)) / s.speed_mps();
    const double beta_expected = (b - front * m * speed * speed / (l * cr)) / (l + kus * speed * speed) * steer;
    // It is a difference of two terms: within 2 % of the larger of itself and the first.
    const double first = b / (l + kus * speed * speed) * steer;
    EXPECT_NEAR(beta, beta_expected, 0.02 * std::max(first, std::fabs(beta_expected))) << speed;
  }
}

// The facts page's car at 100 km/h: r/delta 4.966065, overshoot 14.432 %, peak at .385 s. A low centre of gravity,
// stiff springs and a short relaxation leave the two degrees of freedom that the closed form has.
TEST(BicycleLateral, AStepOfSteerAnswersAsTheClosedFormSays) {
  BicycleSettings s = WithoutLosses(DefaultSettings());
  s.body = {.mass_kg = 1500,
            .roll_inertia_kgm2 = 400,
            .pitch_inertia_kgm2 = 2000,
            .yaw_inertia_kgm2 = 2500,
            .cg_height_m = 0.05,
            .cg_to_front_axle_m = 1.2,
            .wheelbase_m = 2.7,
            .drag_area_m2 = 0.0,
            .air_density_kgpm3 = 1.2};
  s.dimensions.wheelbase_m = 2.7;
  const double stiffness[] = {8e4, 1e5};
  const double load[] = {1500 * kG_mps2 * 1.5 / 2.7 / 2, 1500 * kG_mps2 * 1.2 / 2.7 / 2};
  for (std::size_t axle = 0; axle < 2; ++axle) {
    s.tyre[axle].relaxation_lateral_m = 0.05;
    s.tyre[axle].aligning.reset();
    s.tyre[axle].formula.lky *= 0.5 * stiffness[axle] / CorneringStiffness(s.tyre[axle].formula, load[axle]);
  }
  PlaneGround ground;
  BicycleModel car = PlacedCar(s, ground, {.speed_mps = 100 / 3.6});
  const double steer = 0.002;
  double most = 0.0, at = 0.0;
  Drive(car, ground, Steering(steer * s.steering.ratio), 4.0, [&](int step) {
    const double r = car.state().w_WB_B.z();
    if (r > most) {
      most = r;
      at = step * kStep_s;
    }
  });
  const double steady = car.state().w_WB_B.z();
  EXPECT_NEAR(steady / steer, 4.966065, 0.01 * 4.966065);
  EXPECT_NEAR(most / steady - 1.0, 0.14432, 0.01);
  EXPECT_NEAR(at, 0.385, 0.015);
}

// Roll moment: half track × load difference, summed over the axles = m a_y h. Stiff springs keep the body over its
// wheels.
TEST(BicycleLateral, LoadTransferIsMAHOverT) {
  BicycleSettings settings = WithoutLosses(DefaultSettings());
  for (auto& axle : settings.suspension) {
    axle.spring_Npm *= 10.0;
    axle.damper_Nspm *= 3.0;
  }
  PlaneGround ground;
  BicycleModel car = PlacedCar(settings, ground, {.speed_mps = 20.0});
  Drive(car, ground, Steering(0.37), 6.0);
  const VehicleState& s = car.state();
  const double ay = s.w_WB_B.z() * s.speed_mps();
  EXPECT_GT(ay, 2.5);
  const double moment = 0.71 * (s.wheels[kFrontRight].load_N - s.wheels[kFrontLeft].load_N) +
                        0.70 * (s.wheels[kRearRight].load_N - s.wheels[kRearLeft].load_N);
  const double expected = settings.body.mass_kg * 0.53 * ay;
  EXPECT_GT(s.roll_rad(), 0.001);  // it leans out of the bend
  EXPECT_NEAR(moment, expected, 0.02 * expected);
  double side = 0.0;
  for (const auto& wheel : s.wheels) side += wheel.lateral_N;
  EXPECT_NEAR(side, settings.body.mass_kg * ay, 0.02 * side);
  EXPECT_LT(s.steering_torque_Nm, 0.0);  // towards the middle
}

// A banked bend: with v² / R = g tan(bank) no side force is needed.
TEST(BicycleLateral, WeightActsAlongACrossSlope) {
  const BicycleSettings settings = WithoutLosses(DefaultSettings());
  PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.1);  // rises to the left of a car that goes east
  BicycleModel car = PlacedCar(settings, ground, {.speed_mps = 20.0});
  Drive(car, ground, Steering(0.0), 2.0);
  EXPECT_LT(car.state().heading_rad(), -0.01);  // without steering it turns downhill
  double side = 0.0;
  BicycleModel standing = PlacedCar(settings, ground);
  for (const auto& wheel : standing.state().wheels) side += wheel.lateral_N;
  EXPECT_NEAR(side, settings.body.mass_kg * kG_mps2 * std::sin(std::atan(0.1)), 1.0);
}

TEST(BicycleLateral, LeftAndRightAreMirrorImages) {
  PlaneGround ground;
  BicycleModel left = PlacedCar(DefaultSettings(), ground, {.speed_mps = 15.0});
  BicycleModel right = PlacedCar(DefaultSettings(), ground, {.speed_mps = 15.0});
  for (int i = 0; i < 10000; ++i) {
    Controls controls;
    controls.throttle = i % 3000 < 1500 ? 0.8 : 0.0;
    controls.brake = i % 5000 > 4500 ? 0.7 : 0.0;
    controls.steering_wheel_rad = 2.0 * std::sin(i * 0.002);
    left.Step(controls, ground, kStep_s);
    controls.steering_wheel_rad = -controls.steering_wheel_rad;
    right.Step(controls, ground, kStep_s);
  }
  const VehicleState& a = left.state();
  const VehicleState& b = right.state();
  EXPECT_GT(std::fabs(a.p_WB_W.y()), 1.0);
  EXPECT_NEAR(a.p_WB_W.x(), b.p_WB_W.x(), 1e-9);
  EXPECT_NEAR(a.p_WB_W.y(), -b.p_WB_W.y(), 1e-9);
  EXPECT_NEAR(a.heading_rad(), -b.heading_rad(), 1e-10);
  EXPECT_NEAR(a.wheels[kFrontLeft].load_N, b.wheels[kFrontRight].load_N, 1e-6);
}

TEST(BicycleLateral, FrictionBoundsTheLateralAcceleration) {
  for (const double friction : {1.0, 0.3}) {
    PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0, friction);
    BicycleModel car = PlacedCar(DefaultSettings(), ground, {.speed_mps = 25.0});
    double most = 0.0;
    Drive(car, ground, Steering(2.5), 4.0, [&](int) { most = std::max(most, std::fabs(car.state().a_WB_B().y())); });
    EXPECT_LT(most, 1.25 * friction * kG_mps2);
    EXPECT_GT(most, 0.6 * friction * kG_mps2);
  }
}

}  // namespace
}  // namespace rodeira::dynamics
