// SPDX-License-Identifier: Apache-2.0
// Values that can be computed with and that no car has are warned of.
#include "common/vehicle/dynamics/vehicle_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Of(const std::string& text) {
  const auto file = config::File::Parse(text, "car.yaml");
  EXPECT_TRUE(file.ok());
  return UnusualValues(file.value().root());
}

// The default car's file with one text in place of another.
std::vector<std::string> After(const std::string& from, const std::string& to) {
  std::string text = base::ReadText(SourceDir() + "/configs/vehicles/default.yaml").value();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return Of(text.replace(at, from.size(), to));
}

TEST(UsualValues, EveryShippedVehicleIsUsual) {
  int files = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(SourceDir() + "/configs/vehicles")) {
    if (file.path().extension() != ".yaml") continue;
    EXPECT_THAT(Of(base::ReadText(file.path()).value()), IsEmpty()) << file.path();
    ++files;
  }
  EXPECT_GT(files, 3);
}

TEST(UsualValues, ASpringInTheWrongUnitIsNamedWithTheUsualRange) {
  EXPECT_THAT(
      After("spring_Npm: 22000", "spring_Npm: 22"),
      ElementsAre("car.yaml:38: 'suspension.front.spring_Npm' is 22; 1000 to 2e+06 is usual of a road vehicle"));
  EXPECT_THAT(After("mass_kg: 1050", "mass_kg: 1.05"), ElementsAre(Names("body.mass_kg … 1.05")));
  EXPECT_THAT(After("vertical_Npm: 180000", "vertical_Npm: 180"), ElementsAre(Names("wheel.vertical_Npm … 180")));
}

// K = PKY1 FNOMIN sin(PKY4 atan(1 / PKY2)) LKY: 18 * 3500 * sin(2 atan(1 / 1.9)) * 0.8 N.
TEST(UsualValues, ATyreThatPushesTheWrongWayIsNamed) {
  EXPECT_THAT(After("PKY1: -18", "PKY1: +18"),
              ElementsAre(Names("car.yaml:61: … 'tyre.front.magic_formula.PKY1' … is 41544")));
  EXPECT_THAT(After("PKY1: -18", "PKY1: -0.018"), ElementsAre(Names("tyre.front … -41.5")));
  EXPECT_THAT(After("PDX1: 1.05", "PDX1: 105"), ElementsAre(Names("tyre.front … PDX1 … is 105")));
}

}  // namespace
}  // namespace rodeira::dynamics
