// SPDX-License-Identifier: Apache-2.0
// The tyres' aligning moment in every model: on the body, at the rim, and of a parked car.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/handling_rig.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

constexpr double kStep = 0.001;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// Keeps the speed while the steering wheel follows `wheel_rad(time)`.
void Steer(VehicleModel& car, double speed_mps, double seconds, const std::function<double(double)>& wheel_rad) {
  PlaneGround ground;
  ASSERT_TRUE(car.Initialise({.speed_mps = speed_mps}, ground).ok());
  Controls controls;
  double integral = 0.0;
  for (int i = 0; i < static_cast<int>(seconds / kStep); ++i) {
    const double off = speed_mps - car.state().speed_mps();
    integral += 0.2 * off * kStep;
    controls.throttle = std::clamp(0.3 * off + integral, 0.0, 1.0);
    controls.steering_wheel_rad = wheel_rad(kStep * i);
    car.Step(controls, ground, kStep);
  }
}

double FrontSideForce(const VehicleState& s) {
  return s.wheels[kFrontLeft].lateral_N + s.wheels[kFrontRight].lateral_N;
}

// The prototype as a single-track car: masses, places and tyres are its own, the front tyres' LKY stands for what its
// suspension yields, and the trail is that of its kingpins on the road.
BicycleSettings PrototypeAsBicycle(const MultibodySettings& car) {
  const AxleStiffness axles = MeasureAxles(car, 20.0);
  BicycleSettings b;
  b.body.mass_kg = car.mass_kg;
  b.body.roll_inertia_kgm2 = 180.0;
  b.body.pitch_inertia_kgm2 = 560.0;
  b.body.yaw_inertia_kgm2 = 680.0;
  b.body.cg_height_m = 0.41;
  b.body.cg_to_front_axle_m = axles.front_to_centre_m;
  b.body.wheelbase_m = axles.wheelbase_m();
  b.body.drag_area_m2 = car.drag_area_m2;
  b.dimensions = car.dimensions;
  b.steering.ratio = axles.steering_ratio;
  b.steering.limit_rad = car.steering.limit_rad;
  const auto at = [&](const char* name) {
    for (const auto& entity : car.mechanism.entities)
      if (entity.name == name) return entity.at;
    ADD_FAILURE() << name;
    return Eigen::Vector3d(0, 0, 1);
  };
  const Eigen::Vector3d low = at("fl_lower_ball"), high = at("fl_upper_ball");
  b.steering.mechanical_trail_m = (low - low.z() / (high.z() - low.z()) * (high - low)).x() - at("fl_hub").x();
  b.suspension = {SuspensionSettings{.spring_Npm = 15000.0, .anti_roll_Npm = 5000.0},
                  SuspensionSettings{.spring_Npm = 17000.0, .anti_roll_Npm = 0.0}};
  b.wheel = car.wheel;
  b.tyre = car.tyre;
  const double load = 0.5 * car.mass_kg * 9.81 * axles.centre_to_rear_m / axles.wheelbase_m();
  b.tyre[0].formula.lky *= 0.5 * axles.front_Nprad / CorneringStiffness(car.tyre[0], load);
  b.brakes = car.brakes;
  b.powertrain = car.powertrain;
  b.powertrain.driven = car.powertrain.driven;
  return b;
}

double TorqueAt40Degrees(VehicleModel& car) {
  Steer(car, 20.0, 6.0, [](double time_s) { return 40.0 * kDegree * std::min(1.0, time_s); });
  return car.state().steering_torque_Nm;
}

TEST(SteeringFeel, BicycleAndOdeOfOneCarAgree) {
  auto bicycle = MakeModel(kBicycle), ode = MakeModel(kOde);
  OdeSettings same = static_cast<const OdeModel&>(*ode).settings();
  same.car.tyre = static_cast<const BicycleModel&>(*bicycle).settings().tyre;
  OdeModel ode_with_its_tyres(same);
  ASSERT_TRUE(ode_with_its_tyres.Build().ok());
  const double torque_Nm = TorqueAt40Degrees(*bicycle);
  EXPECT_LT(torque_Nm, -1.0);
  EXPECT_NEAR(TorqueAt40Degrees(ode_with_its_tyres), torque_Nm, 0.15 * std::fabs(torque_Nm));
  EXPECT_NEAR(TorqueAt40Degrees(*ode), torque_Nm, 0.15 * std::fabs(torque_Nm)) << "with its slip curves";
}

TEST(SteeringFeel, BicycleAndMechanismOfOneCarAgree) {
  const MultibodySettings settings = static_cast<const MultibodyModel&>(*MakeModel(kMultibody)).settings();
  const auto mechanism = MakeModel(kMultibody);
  BicycleModel bicycle(PrototypeAsBicycle(settings));
  const double torque_Nm = TorqueAt40Degrees(*mechanism);
  EXPECT_LT(torque_Nm, -1.0);
  EXPECT_NEAR(TorqueAt40Degrees(bicycle), torque_Nm, 0.15 * std::fabs(torque_Nm));
}

class SteeringFeelOfEveryBody : public ::testing::TestWithParam<ModelCase> {};

// The pneumatic trail goes before the side force does: a driver feels the limit at the rim. Coasting, so that no drive
// force takes from the front tyres.
TEST_P(SteeringFeelOfEveryBody, TheRimTorquePeaksBeforeTheSideForce) {
  auto car = MakeModel(GetParam());
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.speed_mps = 20.0}, ground).ok());
  Controls controls = Neutral();
  double most_Nm = 0.0, most_N = 0.0, at_most_Nm_rad = 0.0, at_most_N_rad = 0.0;
  for (int i = 0; i < 5000; ++i) {
    controls.steering_wheel_rad = 60.0 * kDegree * kStep * i;
    car->Step(controls, ground, kStep);
    const VehicleState& s = car->state();
    if (-s.steering_torque_Nm > most_Nm) most_Nm = -s.steering_torque_Nm, at_most_Nm_rad = s.steering_wheel_rad;
    if (FrontSideForce(s) > most_N) most_N = FrontSideForce(s), at_most_N_rad = s.steering_wheel_rad;
  }
  EXPECT_GT(at_most_Nm_rad, 10.0 * kDegree);
  EXPECT_LT(at_most_Nm_rad, 0.8 * at_most_N_rad);
  EXPECT_LT(-car->state().steering_torque_Nm, 0.9 * most_Nm) << "and falls beyond";
}

// Standing: mu/3 sqrt(load³/p) a wheel over the ratio, as Gough's formula has it; then the car begins to roll, and the
// torque fades without a jump: in a millisecond by no more than the share of the patch that has rolled on.
TEST_P(SteeringFeelOfEveryBody, AParkedWheelIsAsHeavyAsItsPatchAndRollsOffWithoutAJump) {
  auto car = MakeModel(GetParam());
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({}, ground).ok());
  double gough_Nm = 0.0, half_patch_m = 1.0;
  for (const std::size_t i : {kFrontLeft, kFrontRight}) {
    const double load_N = car->state().wheels[i].load_N;
    gough_Nm += std::sqrt(std::pow(load_N, 3) / 220000.0) / 3.0 / car->dimensions().steering_ratio;
    half_patch_m = std::min(half_patch_m, 0.5 * std::sqrt(load_N / 220000.0));
  }
  Controls controls = Neutral();  // a wheel that is turned about its kingpin may roll
  for (int i = 0; i < 4000; ++i) {
    controls.steering_wheel_rad = std::min(180.0 * kDegree, 60.0 * kDegree * kStep * i);
    car->Step(controls, ground, kStep);
  }
  EXPECT_NEAR(car->state().steering_torque_Nm, -gough_Nm, 0.2 * gough_Nm);
  controls = {};
  controls.throttle = 0.3;
  controls.steering_wheel_rad = 180.0 * kDegree;
  double before_Nm = car->state().steering_torque_Nm;
  const double odometer_m = car->state().odometer_m;
  while (car->state().odometer_m < odometer_m + 0.5) {
    car->Step(controls, ground, kStep);
    const double rolled_m = std::fabs(car->state().speed_mps()) * kStep;
    // Loads shift as the car starts, which changes the torque too, by a little each step.
    EXPECT_NEAR(car->state().steering_torque_Nm, before_Nm, gough_Nm * (1.5 * rolled_m / half_patch_m + 0.01));
    before_Nm = car->state().steering_torque_Nm;
    ASSERT_LT(car->state().odometer_m, 1e3);
  }
  EXPECT_LT(std::fabs(before_Nm), 0.35 * gough_Nm);
}

INSTANTIATE_TEST_SUITE_P(Models, SteeringFeelOfEveryBody,
                         ::testing::Values(kBicycle, kOde, kMultibody, kSecondMultibody), NameOf);

// In a steady bend nothing yaws faster: the wheels' longitudinal forces, the axles' side forces and the aligning
// moments balance about the centre of gravity. The moments by the tyres' own formula.
TEST(SteeringFeel, TheMomentsTurnTheBodyToo) {
  auto car = MakeModel(kBicycle);
  Steer(*car, 20.0, 8.0, [](double time_s) { return 20.0 * kDegree * std::min(1.0, time_s); });
  const auto& settings = static_cast<const BicycleModel&>(*car).settings();
  const VehicleState& s = car->state();
  const BodySettings& body = settings.body;
  const Eigen::Vector3d centre_W =
      s.p_WB_W + s.q_WB * Eigen::Vector3d(0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0, body.cg_height_m);
  double sides_Nm = 0.0, moments_Nm = 0.0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = s.wheels[i];
    const double way = s.heading_rad() + w.steer_rad;
    const Eigen::Vector3d along(std::cos(way), std::sin(way), 0.0), across(-std::sin(way), std::cos(way), 0.0);
    const Eigen::Vector3d middle_W = 0.5 * (s.wheels[i & 2u].contact_W + s.wheels[(i & 2u) + 1].contact_W);
    sides_Nm += (w.contact_W - centre_W).cross(w.longitudinal_N * along).z() +
                (middle_W - centre_W).cross(w.lateral_N * across).z();
    moments_Nm += SteadyForcesWithMoment(settings.tyre[i / 2], {w.slip, w.slip_angle_tan, 0.0}, w.load_N, w.friction)
                      .aligning_Nm -
                  TwistOnABend(settings.tyre[i / 2], w.load_N, s.w_WB_B.z() / s.speed_mps());
  }
  EXPECT_LT(moments_Nm, -50.0);
  EXPECT_NEAR(sides_Nm, -moments_Nm, 0.02 * std::fabs(moments_Nm));
}

// Friction bounds the twist of the patch; the stiffness before that is the brush model's 2 c a³ / 3, with 2 c a² the
// cornering stiffness of bristles c on a patch of length 2 a.
TEST(TurnedPatch, IsABrushThatSlides) {
  TyreSettings tyre;
  const double load_N = 3000.0, a = 0.5 * std::sqrt(load_N / tyre.formula.inflpres);
  const double c = CorneringStiffness(tyre, load_N) / (2.0 * a * a);
  Tyre patch;
  const auto turn = [&](double rad) {
    patch.Advance(tyre, {0.0, 0.0, 0.0, 0.0, rad / kStep}, load_N, 0.8, kStep);
    return patch.Forces(tyre, {}, load_N, 0.8).aligning_Nm;
  };
  EXPECT_NEAR(turn(0.001), -2.0 / 3.0 * c * a * a * a * 0.001, 1e-9);
  EXPECT_NEAR(turn(1.0), -0.8 / 3.0 * std::sqrt(std::pow(load_N, 3) / tyre.formula.inflpres),
              0.06 * 0.8 / 3.0 * std::sqrt(std::pow(load_N, 3) / tyre.formula.inflpres));
  // Turned back by a hundredth it gives back what the hundredth is worth.
  const double slid = patch.Forces(tyre, {}, load_N, 0.8).aligning_Nm;
  EXPECT_NEAR(turn(-0.01) - slid, 2.0 / 3.0 * c * a * a * a * 0.01, 1e-9);
}

}  // namespace
}  // namespace rodeira::dynamics
