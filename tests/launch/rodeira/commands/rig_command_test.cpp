// SPDX-License-Identifier: Apache-2.0
// `rodeira vehicle rig` as a user sees it.
#include "launch/rodeira/commands/rig_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

VehicleOptions Rig(const std::string& vehicle, const std::string& out) {
  VehicleOptions options;
  options.command = "rig";
  options.file = vehicle;
  options.out = out;
  options.travel_m = 0.03;
  return options;
}

TEST(RigCommand, PrintsFiguresAndWritesTablesAndPictures) {
  const TemporaryFolder folder;
  const Said said = SaidBy(Vehicle, Rig(SourceDir() + "/configs/vehicles/prototype.yaml", folder.path() / "rig"));
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_EQ(said.errors, "");
  for (const char* row :
       {"toe-in over travel", "height of the roll centre", "caster", "scrub radius", "toe-in by force outward"})
    EXPECT_THAT(said.out, HasSubstr(row));
  const std::string travel = base::ReadText(folder.path() / "rig/travel.csv").value();
  EXPECT_THAT(travel, StartsWith("travel_m,front_left_toe_in_deg,front_left_camber_deg,front_left_outward_m,"));
  EXPECT_EQ(std::ranges::count(travel, '\n'), 1 + 2 * 12 + 1) << "a row every 2.5 mm";
  EXPECT_THAT(base::ReadText(folder.path() / "rig/travel.svg").value(), HasSubstr("Camber"));
  EXPECT_THAT(base::ReadText(folder.path() / "rig/steering.svg").value(), HasSubstr("outer, without slip"));

  // To the left the left wheel is the inner one: it turns more, and the other one less without slip.
  const std::string steering = base::ReadText(folder.path() / "rig/steering.csv").value();
  std::istringstream last(steering.substr(steering.rfind('\n', steering.size() - 2) + 1));
  double wheel = 0.0, left = 0.0, right = 0.0, outer = 0.0;
  char comma = 0;
  last >> wheel >> comma >> left >> comma >> right >> comma >> outer;
  ASSERT_TRUE(last) << steering;
  EXPECT_GT(wheel, 400.0);
  EXPECT_GT(left, right);
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_NEAR(1.0 / std::tan(outer * degree) - 1.0 / std::tan(left * degree), 1.3 / 2.3, 1e-9)
      << "track over wheelbase as drawn";
}

TEST(RigCommand, AVehicleWithoutLinkagesAndAWrongTravelAreWrongInput) {
  Said said = SaidBy(Vehicle, Rig(SourceDir() + "/configs/vehicles/ode.yaml", ""));
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("multibody"));
  VehicleOptions far = Rig(SourceDir() + "/configs/vehicles/prototype.yaml", "");
  far.travel_m = 0.0;
  said = SaidBy(Vehicle, far);
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("--travel"));
}

}  // namespace
}  // namespace rodeira::cli
