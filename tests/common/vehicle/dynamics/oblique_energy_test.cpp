// SPDX-License-Identifier: Apache-2.0
// The energy of a car that coasts at an angle over an edge or a kerb, or lands from a ramp, does not grow.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <string>

#include "tests/common/vehicle/dynamics/car_energy.hpp"
#include "tests/common/vehicle/dynamics/contact_energy.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kDegree = base::kPi / 180.0;

// The profile along a direction that is turned from x by an angle.
class ObliqueGround final : public ground::Ground {
 public:
  ObliqueGround(const std::vector<ProfileGround::Corner>& corners, double turned_rad)
      : profile_(corners), turn_(Eigen::AngleAxisd(turned_rad, Eigen::Vector3d::UnitZ())) {}

  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      ground::GroundQuery along = queries[i];
      along.x_m = turn_.col(0).x() * queries[i].x_m + turn_.col(0).y() * queries[i].y_m;
      profile_.Query({&along, 1}, {&points[i], 1});
      points[i].normal_W = turn_ * points[i].normal_W;
    }
  }
  double lowest_m() const { return profile_.lowest_m(); }

 private:
  ProfileGround profile_;
  Eigen::Matrix3d turn_;
};

struct Oblique {
  double start_J = 0.0;  // above the lowest ground
  double most_J = 0.0;
  bool has_crossed = false;
};

// With the clutch out, along x, until the car is 10 m past the last corner's line, or turned off.
Oblique CoastAcross(VehicleModel& car, double speed_mps, const std::vector<ProfileGround::Corner>& corners,
                    double turned_rad) {
  ObliqueGround ground(corners, turned_rad);
  const double along = std::cos(turned_rad);
  EXPECT_TRUE(car.Initialise({.x_m = (corners.front().x_m - 6.0) / along, .speed_mps = speed_mps}, ground).ok());
  const double zero_J = car.dimensions().mass_kg * kG * ground.lowest_m();
  Oblique found;
  found.start_J = found.most_J = Energy(car) - zero_J;
  for (int i = 0; i < 6000 && !found.has_crossed; ++i) {
    car.Step(Neutral(), ground, 0.001);
    found.most_J = std::max(found.most_J, Energy(car) - zero_J);
    found.has_crossed = car.state().p_WB_W.x() * along > corners.back().x_m + 10.0;
  }
  return found;
}

// An approach angle of 90 degrees is straight across.
double TurnedBy(double approach_deg) { return (90.0 - approach_deg) * kDegree; }

void ExpectNoEnergyAtAnAngle(const ModelCase& model, std::uint32_t seed, int pieces) {
  static std::map<std::string, std::unique_ptr<VehicleModel>> cars;
  std::unique_ptr<VehicleModel>& car = cars[model.name];
  if (!car) car = MakeModel(model);
  const double speed_mps = base::RandomUniform({seed, 1}, 2.0, 25.0);
  const double approach_deg = base::RandomUniform({seed, 2}, 15.0, 75.0);
  const double side = base::RandomUniform({seed, 3}, 0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  const Oblique found =
      CoastAcross(*car, speed_mps, ProfileGround::Random(seed, pieces), side * TurnedBy(approach_deg));
  RC_ASSERT(found.most_J <= 1.001 * found.start_J);
}

RC_GTEST_PROP(ObliqueEnergy, ABicycleCarGetsNoneAtAnyAngle, (std::uint32_t seed)) {
  ExpectNoEnergyAtAnAngle(kBicycle, seed, 3);
}
RC_GTEST_PROP(ObliqueEnergy, AnOdeCarGetsNoneAtAnyAngle, (std::uint32_t seed)) {
  ExpectNoEnergyAtAnAngle(kOde, seed, 2);
}
RC_GTEST_PROP(ObliqueEnergy, AMultibodyCarGetsNoneAtAnyAngle, (std::uint32_t seed)) {
  ExpectNoEnergyAtAnAngle(kMultibody, seed, 1);
}

// Down a ramp of 2 m on 4 m at 10 m/s the front wheels land with another spin than the road has. Their tyres take 100 J
// into their deflection and give them back: with it, nothing is gained.
TEST(RampEnergy, ALandingGivesBackWhatTheTyresHold) {
  const auto model = MakeModel(kMultibody);
  auto& car = dynamic_cast<MultibodyModel&>(*model);
  ProfileGround ground({{10.0, 0.0}, {14.0, -2.0}});
  ASSERT_TRUE(car.Initialise({.x_m = 4.0, .speed_mps = 10.0}, ground).ok());
  double least_J = Energy(car), least_with_J = least_J + TangentialEnergy(car), gain_J = 0.0, gain_with_J = 0.0;
  for (int i = 0; i < 6000 && car.state().p_WB_W.x() < 24.0; ++i) {
    car.Step(Neutral(), ground, 0.001);
    const double now_J = Energy(car), with_J = now_J + TangentialEnergy(car);
    gain_J = std::max(gain_J, now_J - least_J);
    gain_with_J = std::max(gain_with_J, with_J - least_with_J);
    least_J = std::min(least_J, now_J);
    least_with_J = std::min(least_with_J, with_J);
  }
  EXPECT_LT(gain_with_J, 1.0);
  EXPECT_GT(gain_J, 50.0) << "the case holds something to give back";
}

class AtAnAngle : public ::testing::TestWithParam<ModelCase> {};

// Down a face of 7 in 1 that lies 45 degrees askew, which counted as a wall: the front wheel took 2 kJ from nothing.
TEST_P(AtAnAngle, ASteepFaceThatLiesAskewIsLeftAndGivesNothing) {
  auto car = MakeModel(GetParam());
  for (const double side : {-1.0, 1.0}) {
    const Oblique found = CoastAcross(*car, 10.0, {{10.0, 1.0}, {10.14, 0.0}}, side * TurnedBy(45.0));
    EXPECT_LE(found.most_J, 1.001 * found.start_J);
    EXPECT_TRUE(found.has_crossed);
  }
}

TEST_P(AtAnAngle, KerbsAndEdgesGiveNothing) {
  auto car = MakeModel(GetParam());
  for (const double approach_deg : {15.0, 30.0, 45.0, 60.0, 75.0}) {
    for (const double rise_m : {0.06, -0.3}) {
      SCOPED_TRACE(std::to_string(approach_deg) + " deg, " + std::to_string(rise_m) + " m");
      const Oblique found = CoastAcross(*car, 12.0, {{10.0, 0.0}, {10.0, rise_m}}, TurnedBy(approach_deg));
      EXPECT_LE(found.most_J, 1.001 * found.start_J);
      if (approach_deg >= 45.0) {
        EXPECT_TRUE(found.has_crossed);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, AtAnAngle, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
