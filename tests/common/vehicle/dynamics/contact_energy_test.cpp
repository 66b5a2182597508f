// SPDX-License-Identifier: Apache-2.0
// The energy of a car that coasts over ramps, edges and kerbs never grows.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <map>

#include "tests/common/vehicle/dynamics/car_energy.hpp"
#include "tests/common/vehicle/dynamics/contact_energy.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kStep = 0.001;

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
