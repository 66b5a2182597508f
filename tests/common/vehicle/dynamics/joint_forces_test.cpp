// SPDX-License-Identifier: Apache-2.0
// Forces in the joints of the multibody cars: against statics, against Newton's law of each arm, and far from the
// origin.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/base/constants.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

MultibodyModel& Multibody(VehicleModel& model) { return dynamic_cast<MultibodyModel&>(model); }

Vector3d ForceOn(const JointForces& forces, const std::string& body, const std::string& point) {
  const auto found = std::ranges::find_if(
      forces.joints, [&](const JointForce& joint) { return joint.body == body && joint.point == point; });
  if (found != forces.joints.end()) return found->force_B;
  ADD_FAILURE() << "no force on " << body << " at " << point;
  return Vector3d::Zero();
}

double ForceOf(const JointForces& forces, const std::string& element) {
  const auto found = std::ranges::find(forces.springs, element, &SpringForce::name);
  if (found != forces.springs.end()) return found->force_N;
  ADD_FAILURE() << "no force of " << element;
  return 0.0;
}

// In B, of a point of the mechanism.
Vector3d At(const MultibodyModel& car, const std::string& point) {
  const auto& entities = car.system().drawing().entities;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    if (entities[i].name == point) return car.X_WB().inverse() * car.system().motion().At(static_cast<int>(i));
  }
  ADD_FAILURE() << "no point " << point;
  return Vector3d::Zero();
}

Controls Bend(double t_s) {
  Controls controls = Neutral(t_s > 1.0 ? 0.3 : 0.0);
  controls.steering_wheel_rad = std::sin(3.0 * t_s);
  return controls;
}

// The left front corner of the car at rest: what the tyre bears, less the corner's weight, comes to the chassis through
// the arms' inner points, the rack and the damper.
TEST(CarJointForces, OfACarAtRestAreThoseOfStatics) {
  auto model = MakeModel(kMultibody);
  MultibodyModel& car = Multibody(*model);
  ground::PlaneGround ground;
  ASSERT_TRUE(car.Initialise({}, ground).ok());
  DriveFor(car, ground, Neutral(), 0.01);
  const JointForces forces = car.FindJointForces();
  Vector3d into_corner = Vector3d::Zero();
  for (const char* arm : {"fl_lower", "fl_upper"}) {
    for (const char* end : {"_front", "_rear"})
      into_corner += ForceOn(forces, arm + std::string("_arm"), arm + std::string(end));
  }
  into_corner += ForceOn(forces, "fl_tie_rod", "fl_rack");
  const Vector3d damper = (At(car, "fl_damper_top") - At(car, "fl_damper_foot")).normalized();
  into_corner += ForceOf(forces, "fl_damper") * damper;  // tension pulls at the foot towards the top
  const WheelState& wheel = car.state().wheels[kFrontLeft];
  constexpr double kCorner_kg = 23.0 + 3.5 + 2.0 + 0.8;
  EXPECT_NEAR(into_corner.z(), kCorner_kg * base::kGravity_mps2 - wheel.load_N, 0.5);
  EXPECT_NEAR(into_corner.y(), -wheel.lateral_N, 0.5);
  EXPECT_LT(ForceOf(forces, "fl_damper"), -1000.0) << "the spring is pressed";
  EXPECT_NEAR(ForceOf(forces, "front_bar"), 0.0, 1e-3);
}

// Each upper arm has three joints and no spring: their forces and its weight give its mass its acceleration.
TEST(CarJointForces, AddUpToNewtonsLawOfTheArms) {
  auto model = MakeModel(kMultibody);
  MultibodyModel& car = Multibody(*model);
  ground::PlaneGround ground;
  ASSERT_TRUE(car.Initialise({.heading_rad = 0.7, .speed_mps = 15.0}, ground).ok());
  double largest_N = 0.0;
  for (int i = 0; i < 1500; ++i) {
    car.Step(Bend(0.001 * i), ground, 0.001);
    if (i % 100 != 99) continue;
    const JointForces forces = car.FindJointForces();
    multibody::Balance balance;
    ASSERT_TRUE(car.system().FindBalance(balance));
    const auto& drawing = car.system().drawing();
    for (const std::string side : {"fl", "fr"}) {
      const auto body = std::ranges::find(drawing.body_names, side + "_upper_arm") - drawing.body_names.begin();
      const multibody::BodyParts& arm = drawing.bodies[static_cast<std::size_t>(body)];
      Vector3d sum = Vector3d::Zero();
      for (const char* end : {"_front", "_rear", "_ball"}) {
        const Vector3d force = ForceOn(forces, side + "_upper_arm", side + "_upper" + end);
        largest_N = std::max(largest_N, force.norm());
        sum += force;
      }
      const Vector3d a_W = multibody::Evaluate(arm.centre, balance.qdd.data());
      const Vector3d expected_B =
          car.X_WB().linear().transpose() * (arm.mass_kg * (a_W + Vector3d(0.0, 0.0, base::kGravity_mps2)));
      EXPECT_NEAR((sum - expected_B).norm(), 0.0, 1e-5) << side << " " << i;
    }
  }
  EXPECT_GT(largest_N, 500.0);
}

// The same drive at the origin and at (5 km, 3 km), where positions have 9e-13 m: through the weight of the
// constraints' violation these were up to 900 N.
TEST(CarJointForces, FarFromTheOriginAreThoseAtTheOrigin) {
  for (const ModelCase& each : {kMultibody, kSecondMultibody}) {
    auto here_model = MakeModel(each), there_model = MakeModel(each);
    MultibodyModel &here = Multibody(*here_model), &there = Multibody(*there_model);
    ground::PlaneGround ground;
    ASSERT_TRUE(here.Initialise({.speed_mps = 15.0}, ground).ok());
    ASSERT_TRUE(there.Initialise({.x_m = 5000.0, .y_m = 3000.0, .speed_mps = 15.0}, ground).ok());
    double joint_N = 0.0, spring_N = 0.0, largest_N = 0.0;
    for (int i = 0; i < 1500; ++i) {
      here.Step(Bend(0.001 * i), ground, 0.001);
      there.Step(Bend(0.001 * i), ground, 0.001);
      if (i % 20 != 0) continue;
      const JointForces at_origin = here.FindJointForces(), far = there.FindJointForces();
      ASSERT_EQ(at_origin.joints.size(), far.joints.size());
      ASSERT_GT(at_origin.joints.size(), 20u);
      for (std::size_t k = 0; k < far.joints.size(); ++k) {
        joint_N = std::max(joint_N, (far.joints[k].force_B - at_origin.joints[k].force_B).norm());
        largest_N = std::max(largest_N, far.joints[k].force_B.norm());
      }
      for (std::size_t k = 0; k < far.springs.size(); ++k)
        spring_N = std::max(spring_N, std::fabs(far.springs[k].force_N - at_origin.springs[k].force_N));
    }
    RecordProperty(std::string(each.name) + "_joint_N", fmt::format("{:.1e} N", joint_N));
    EXPECT_LT(joint_N, 0.01) << each.name;
    EXPECT_LT(spring_N, 0.01) << each.name;
    EXPECT_GT(largest_N, 1000.0) << each.name;
  }
}

TEST(CarJointForces, ChangeNoBitOfTheCar) {
  auto with = MakeModel(kMultibody), without = MakeModel(kMultibody);
  ground::PlaneGround ground;
  for (VehicleModel* car : {with.get(), without.get()})
    ASSERT_TRUE(car->Initialise({.x_m = 700.0, .speed_mps = 15.0}, ground).ok());
  for (int i = 0; i < 1200; ++i) {
    for (VehicleModel* car : {with.get(), without.get()}) car->Step(Bend(0.001 * i), ground, 0.001);
    (void)with->FindJointForces();
    base::StateWriter a, b;
    with->Save(a);
    without->Save(b);
    ASSERT_EQ(a.bytes(), b.bytes()) << i;
  }
}

TEST(CarJointForces, AreThoseOfModelsWithJoints) {
  EXPECT_TRUE(MakeModel(kMultibody)->has_joint_forces());
  for (const ModelCase& each : {kBicycle, kOde, kFmu}) {
    auto car = MakeModel(each);
    EXPECT_FALSE(car->has_joint_forces()) << each.name;
    EXPECT_TRUE(car->FindJointForces().joints.empty()) << each.name;
  }
}

}  // namespace
}  // namespace rodeira::dynamics
