// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/person_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace rodeira::scene {
namespace {

TEST(Person, HasItsHeightAndStandsOnTheGround) {
  for (const double height_m : {1.1, 1.75, 1.95}) {
    const PersonMeshes person = BuildPerson(height_m, Colour::Of(0x805030));
    double low = 10.0, high = 0.0;
    const auto reach = [&](const Mesh& mesh, const Eigen::Vector3d& joint) {
      for (const Eigen::Vector3f& p : mesh.positions) {
        low = std::min(low, joint.z() + static_cast<double>(p.z()));
        high = std::max(high, joint.z() + static_cast<double>(p.z()));
      }
    };
    reach(person.trunk, Eigen::Vector3d::Zero());
    for (const Limb& limb : person.limbs) reach(limb.mesh, limb.joint_B);
    EXPECT_NEAR(high, height_m, 1e-5);
    EXPECT_NEAR(low, 0.0, 1e-5);
  }
}

// Feet that bear do not slide: over half a turn of the published wheel the body goes half its circumference, and one
// leg swings from fully before to fully behind, by which its foot goes as far.
TEST(Person, StepsAsFarAsItWalks) {
  const double leg_m = LegLength_m(1.75);
  for (const double radius_m : {0.15, 0.2, 0.24}) {
    const double before = LegSwing_rad(0.5 * std::numbers::pi, radius_m, leg_m),
                 behind = LegSwing_rad(1.5 * std::numbers::pi, radius_m, leg_m);
    EXPECT_NEAR(leg_m * (std::sin(before) - std::sin(behind)), std::numbers::pi * radius_m, 1e-9);
  }
  EXPECT_LT(LegSwing_rad(0.5 * std::numbers::pi, 2.0, leg_m), 0.6) << "nobody does the splits";
  const PersonMeshes person = BuildPerson(1.75, {});
  EXPECT_LT(person.limbs[0].swings * person.limbs[1].swings, 0.0) << "legs swing against one another";
  EXPECT_LT(person.limbs[0].swings * person.limbs[2].swings, 0.0) << "and each arm against its leg";
}

}  // namespace
}  // namespace rodeira::scene
