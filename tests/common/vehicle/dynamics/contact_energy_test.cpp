// SPDX-License-Identifier: Apache-2.0
// The energy of a car that coasts over ramps, edges and kerbs never grows.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <map>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/contact_energy.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr double kG = base::kGravity_mps2;
constexpr double kStep = 0.001;

// A spring up to where the rim bears; from there the load grows no further.
double TyreEnergy(const WheelSettings& of, const VehicleState& s, const WheelState& w) {
  const Vector3d way = s.p_WB_W + s.q_WB * w.hub_B - w.contact_W;
  const double pressed_m = std::max(0.0, of.radius_m - std::copysign(way.norm(), way.dot(w.contact_normal_W)));
  const double spring_m = std::min(pressed_m, kMaxTyreDeflection * of.radius_m);
  return of.vertical_Npm * spring_m * (0.5 * spring_m + (pressed_m - spring_m));
}

double Turning(const Vector3d& inertia, const Vector3d& w) { return 0.5 * w.cwiseAbs2().dot(inertia); }

double Springs(const BicycleSettings& car, const VehicleState& s, double bears_N, std::size_t i) {
  const SuspensionSettings& of = car.suspension[i / 2];
  const double d = s.wheels[i].travel_m, bar_m = d - s.wheels[i ^ 1u].travel_m;
  return bears_N * d + 0.5 * of.spring_Npm * d * d + 0.25 * of.anti_roll_Npm * bar_m * bar_m;
}

double Energy(const BicycleModel& model) {
  const VehicleState& s = model.state();
  const BicycleSettings& car = model.settings();
  const BodySettings& body = car.body;
  const Vector3d p_BG_B(0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0, body.cg_height_m);
  const Vector3d v = s.v_WB_W + s.q_WB * s.w_WB_B.cross(p_BG_B);
  double energy_J = 0.5 * body.mass_kg * v.squaredNorm() + body.mass_kg * kG * (s.p_WB_W + s.q_WB * p_BG_B).z();
  energy_J += Turning({body.roll_inertia_kgm2, body.pitch_inertia_kgm2, body.yaw_inertia_kgm2}, s.w_WB_B);
  const double rear = body.cg_to_front_axle_m / body.wheelbase_m;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = s.wheels[i];
    energy_J += 0.5 * car.wheel.inertia_kgm2 * w.spin_radps * w.spin_radps;
    energy_J += Springs(car, s, 0.5 * body.mass_kg * kG * (i < 2 ? 1.0 - rear : rear), i);
    energy_J += TyreEnergy(car.wheel, s, w);
  }
  return energy_J;
}

double Energy(const OdeModel& model) {
  const VehicleState& s = model.state();
  const OdeSettings& of = model.settings();
  const BicycleSettings& car = of.car;
  const OdeChassis chassis = ChassisOf(of);
  const Vector3d v = s.v_WB_W + s.q_WB * s.w_WB_B.cross(chassis.p_BG_B);
  double energy_J =
      0.5 * chassis.mass_kg * v.squaredNorm() + chassis.mass_kg * kG * (s.p_WB_W + s.q_WB * chassis.p_BG_B).z();
  energy_J += Turning(chassis.inertia_kgm2, s.w_WB_B);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const WheelState& w = s.wheels[i];
    const SuspensionSettings& sus = car.suspension[i / 2];
    const Vector3d rate_B(0.0, 0.0, w.damper_N / sus.damper_Nspm);
    const Vector3d hub = s.v_WB_W + s.q_WB * (s.w_WB_B.cross(w.hub_B) + rate_B);
    energy_J += 0.5 * of.wheel_mass_kg * hub.squaredNorm() + of.wheel_mass_kg * kG * (s.p_WB_W + s.q_WB * w.hub_B).z();
    energy_J += Turning({of.wheel_across_kgm2, car.wheel.inertia_kgm2, of.wheel_across_kgm2},
                        s.w_WB_B + Vector3d(0.0, w.spin_radps, 0.0));
    energy_J += Springs(car, s, LoadAtRest(car, i) - of.wheel_mass_kg * kG, i);
    const double beyond = w.travel_m - std::clamp(w.travel_m, -sus.rebound_m, sus.bump_m);
    energy_J += 0.5 * of.stop_Npm * beyond * beyond;
    energy_J += TyreEnergy(car.wheel, s, w);
  }
  return energy_J;
}

// That of the mechanism's masses and springs is tested against closed forms (tests/common/vehicle/multibody).
double Energy(const MultibodyModel& model) {
  const VehicleState& s = model.state();
  double energy_J = model.system().Energy();
  for (const WheelState& w : s.wheels) {
    energy_J += 0.5 * model.settings().wheel.inertia_kgm2 * w.spin_radps * w.spin_radps;
    energy_J += TyreEnergy(model.settings().wheel, s, w);
  }
  return energy_J;
}

double Energy(const VehicleModel& model) {
  if (const auto* car = dynamic_cast<const BicycleModel*>(&model)) return Energy(*car);
  if (const auto* car = dynamic_cast<const OdeModel*>(&model)) return Energy(*car);
  return Energy(dynamic_cast<const MultibodyModel&>(model));
}

// Drives on with the clutch out over the ground, from 10 m before its first corner, until it has passed the last.
struct Coasting {
  double start_J = 0.0;  // above the lowest ground
  double most_J = 0.0;
  double gain_J = 0.0;  // largest over what there was least before
};

Coasting Coast(VehicleModel& car, double speed_mps, const std::vector<ProfileGround::Corner>& corners) {
  ProfileGround ground(corners);
  EXPECT_TRUE(car.Initialise({.x_m = corners.front().x_m - 6.0, .speed_mps = speed_mps}, ground).ok());
  const double zero_J = car.dimensions().mass_kg * kG * ground.lowest_m();
  Coasting coasting;
  coasting.start_J = coasting.most_J = Energy(car) - zero_J;
  double least_J = coasting.start_J;
  for (int i = 0; i < 6000 && car.state().p_WB_W.x() < corners.back().x_m + 10.0; ++i) {
    car.Step(Neutral(), ground, kStep);
    const double now_J = Energy(car) - zero_J;
    coasting.most_J = std::max(coasting.most_J, now_J);
    coasting.gain_J = std::max(coasting.gain_J, now_J - least_J);
    least_J = std::min(least_J, now_J);
  }
  return coasting;
}

void ExpectNoEnergyFromTheGround(const ModelCase& model, std::uint32_t seed, int pieces) {
  static std::map<std::string, std::unique_ptr<VehicleModel>> cars;
  std::unique_ptr<VehicleModel>& car = cars[model.name];
  if (!car) car = MakeModel(model);
  const double speed_mps = base::RandomUniform({seed, 1}, 2.0, 30.0);
  const Coasting coasting = Coast(*car, speed_mps, ProfileGround::Random(seed, pieces));
  RC_ASSERT(coasting.most_J <= 1.001 * coasting.start_J);
}

RC_GTEST_PROP(ContactEnergy, ABicycleCarGetsNoneFromRampsEdgesAndKerbs, (std::uint32_t seed)) {
  ExpectNoEnergyFromTheGround(kBicycle, seed, 8);
}
RC_GTEST_PROP(ContactEnergy, AnOdeCarGetsNoneFromRampsEdgesAndKerbs, (std::uint32_t seed)) {
  ExpectNoEnergyFromTheGround(kOde, seed, 4);
}
RC_GTEST_PROP(ContactEnergy, AMultibodyCarGetsNoneFromRampsEdgesAndKerbs, (std::uint32_t seed)) {
  ExpectNoEnergyFromTheGround(kMultibody, seed, 2);
}

class OverEdges : public ::testing::TestWithParam<ModelCase> {};

// At no time there is more than there was before: what friction takes in between hides nothing.
TEST_P(OverEdges, ASteepFaceThatTheTyreHasLeftGivesNothing) {
  auto car = MakeModel(GetParam());
  const std::vector<std::vector<ProfileGround::Corner>> faces{{{10.0, 1.0}, {10.1, 0.0}},
                                                              {{10.0, 1.0}, {10.02, 0.0}},
                                                              {{10.0, 0.3}, {10.02, 0.0}},
                                                              {{10.0, 0.0}, {14.0, -0.8}}};
  for (const auto& face : faces) {
    const Coasting coasting = Coast(*car, 10.0, face);
    EXPECT_LT(coasting.gain_J, 0.001 * coasting.start_J) << face.back().x_m << " " << face.front().z_m;
    EXPECT_GT(car->state().speed_mps(), 8.0);
  }
}

// From 4 m (tests of the case: 76 kJ became 1344 kJ) it lands on its nose.
TEST_P(OverEdges, ADeepFallGivesNoMoreThanTheHeight) {
  auto car = MakeModel(GetParam());
  const Coasting coasting = Coast(*car, 10.0, {{10.0, 4.0}, {10.1, 0.0}});
  EXPECT_LE(coasting.most_J, 1.001 * coasting.start_J);
}

TEST_P(OverEdges, AKerbIsClimbedAtTheCostOfSpeed) {
  auto car = MakeModel(GetParam());
  for (const double kerb_m : {0.03, 0.06, 0.1}) {
    const Coasting coasting = Coast(*car, 12.0, {{10.0, 0.0}, {10.0, kerb_m}});
    EXPECT_LT(coasting.gain_J, 0.001 * coasting.start_J) << kerb_m;
    EXPECT_LT(car->state().speed_mps(), 11.9);
    EXPECT_GT(car->state().speed_mps(), 8.0);
    for (const WheelState& wheel : car->state().wheels) EXPECT_NEAR(wheel.contact_W.z(), kerb_m, 1e-3);
    EXPECT_NEAR(car->state().p_WB_W.z(), kerb_m, 0.1);
  }
}

// A snapshot in each step of an edge and of a kerb holds all that the wheels go on by.
TEST_P(OverEdges, RestoredThereItGoesOnWithTheSameBits) {
  auto first = MakeModel(GetParam()), second = MakeModel(GetParam());
  ProfileGround ground({{6.0, 0.5}, {6.05, 0.2}, {9.0, 0.2}, {9.0, 0.26}});
  ASSERT_TRUE(first->Initialise({.x_m = 3.0, .speed_mps = 6.0}, ground).ok());
  std::size_t shortest = std::numeric_limits<std::size_t>::max(), longest = 0;
  for (int i = 0; i < 1500; ++i) {
    first->Step(Neutral(), ground, kStep);
    if (i % 10 != 0) continue;
    base::StateWriter now, later, later_too;
    first->Save(now);
    shortest = std::min(shortest, now.bytes().size());
    longest = std::max(longest, now.bytes().size());
    base::StateReader reader(now.bytes());
    second->Restore(reader);
    ASSERT_TRUE(reader.Finish().ok());
    for (int k = 0; k < 5; ++k) second->Step(Neutral(), ground, kStep);
    second->Save(later_too);
    auto third = MakeModel(GetParam());
    base::StateReader again(now.bytes());
    third->Restore(again);
    for (int k = 0; k < 5; ++k) third->Step(Neutral(), ground, kStep);
    third->Save(later);
    ASSERT_EQ(later.bytes(), later_too.bytes()) << i;
  }
  EXPECT_GT(longest, shortest) << "edges are saved only where there are any";
}

INSTANTIATE_TEST_SUITE_P(Models, OverEdges, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
