// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using testing::HasSubstr;
const std::filesystem::path kDefault = std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml";

std::string DefaultText() {
  std::ifstream in(kDefault);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The message for the default file with one text replaced by another.
std::string ProblemAfter(const std::string& from, const std::string& to) {
  std::string text = DefaultText();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto path =
      std::filesystem::temp_directory_path() / ("rodeira-vehicle-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << text;
  const auto model = LoadVehicle(path);
  std::filesystem::remove(path);
  return model.ok() ? "" : model.error().Text();
}

TEST(VehicleFile, TheDefaultCarLoads) {
  const auto model = LoadVehicle(kDefault);
  ASSERT_TRUE(model.ok()) << model.error().Text();
  EXPECT_EQ(model.value()->dimensions().forward_gears, 5);
  EXPECT_NEAR(model.value()->dimensions().wheelbase_m, 2.46, 1e-12);
}

TEST(VehicleFile, RefusalsNamePlaceAndRemedy) {
  EXPECT_THAT(ProblemAfter("model: bicycle", "model: bycicle"),
              HasSubstr(":7: 'model' is 'bycicle'; did you mean 'bicycle'?"));
  EXPECT_THAT(ProblemAfter("vehicle/1", "vehicle/7"), HasSubstr("'rodeira' is 'vehicle/7'"));
  EXPECT_THAT(ProblemAfter("  mass_kg: 1050 ", "  mas_kg: 1050 "), HasSubstr("mass_kg"));
  EXPECT_THAT(ProblemAfter("  mass_kg: 1050 ", "  mass_t: 1.05 "), HasSubstr("mass_kg"));
  EXPECT_THAT(ProblemAfter("mass_kg: 1050", "mass_kg: -3"), HasSubstr("'body.mass_kg' is -3"));
  EXPECT_THAT(ProblemAfter("    - [1500, 95.0]", "    - [900, 95.0]"), HasSubstr("ascending order"));
  EXPECT_THAT(ProblemAfter("PCX1: 1.6", "PCX9: 1.6"), HasSubstr("'tyre.front.magic_formula.PCX9'"));
  EXPECT_THAT(ProblemAfter("resume_rpm: 6300", "resume_rpm: 6600"), HasSubstr("not below"));
  EXPECT_THAT(ProblemAfter("[3.46, 1.96,", "[1.96, 3.46,"), HasSubstr("does not fall"));
  EXPECT_THAT(ProblemAfter("automatic:  #", "differential: {locking_drive: 1.3}\nautomatic:  #"),
              HasSubstr("'differential.locking_drive' is 1.3"));
  EXPECT_THAT(ProblemAfter("automatic:  #", "differential: {locking: 0.3}\nautomatic:  #"), HasSubstr("locking_drive"));
  EXPECT_EQ(ProblemAfter("automatic:  #",
                         "differential: {preload_Nm: 40, locking_drive: 0.3, locking_overrun: 0.15}\nautomatic:  #"),
            "");
  EXPECT_EQ(ProblemAfter("vertical_Npm: 180000", "enveloping: ring\n  vertical_Npm: 180000"), "");
  EXPECT_THAT(ProblemAfter("vertical_Npm: 180000", "enveloping: rings\n  vertical_Npm: 180000"),
              HasSubstr("'wheel.enveloping' is 'rings'; did you mean 'ring'?"));
  EXPECT_THAT(ProblemAfter("driven_axle: front", "driven_axle: frnt"), HasSubstr("did you mean 'front'?"));
  EXPECT_THAT(ProblemAfter("cg_to_front_axle_m: 1.0 ", "cg_to_front_axle_m: 3.0 "), HasSubstr("between the axles"));
  EXPECT_EQ(LoadVehicle("/no/such/car.yaml").error().exit_status(), 2);
}

// The tyre of a maker's file beside the vehicle's, with coefficients of the vehicle file in the place of its own.
TEST(VehicleFile, TyresMayComeFromAPropertyFile) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-tyres-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto loaded = [&](const std::string& tyre, const std::string& tir) {
    std::string text = DefaultText();
    const auto from = text.find("    magic_formula: {"), to = text.find("}\n", from) + 2;
    text.replace(from, to - from, tyre);
    std::ofstream(folder / "car.yaml") << text;
    std::ofstream(folder / "t.tir") << tir;
    return LoadVehicle(folder / "car.yaml");
  };
  const std::string tir =
      "[MODEL]\nFITTYP = 52\nFNOMIN = 4100\nPCX1 = 1.6\nPDX1 = 1.1\nPKX1 = 21\nPCY1 = 1.3\nPDY1 = 0.95\nPHY3 = "
      "0.01\nPKY1 = -17\n";
  const auto car = loaded("    tir: t.tir\n    magic_formula: {PDY1: 0.9}\n", tir);
  ASSERT_TRUE(car.ok()) << car.error().Text();
  const MagicFormulaSettings& tyre = static_cast<const BicycleModel&>(*car.value()).settings().tyre[0].formula;
  EXPECT_EQ(tyre.version, MagicFormulaVersion::k52);
  EXPECT_EQ(tyre.pky1, -17.0);
  EXPECT_EQ(tyre.pdy1, 0.9);
  EXPECT_EQ(tyre.phy3, 0.01);
  EXPECT_THAT(loaded("    tir: t.tir\n", "[MODEL]\nFITTYP = 52\nPCX1 = x\n").error().Text(),
              Names("t.tir:3: 'PCX1' … 'x' … number"));
  EXPECT_THAT(loaded("    tir: none.tir\n", tir).error().Text(), HasSubstr("none.tir"));
  std::filesystem::remove_all(folder);
}

TEST(VehicleFile, AFurtherKindOfModelIsFound) {
  const ModelKind more[] = {{"other", [](const config::Map&) -> std::unique_ptr<VehicleModel> {
                               return std::make_unique<BicycleModel>(DefaultSettings());
                             }}};
  const auto path =
      std::filesystem::temp_directory_path() / ("rodeira-vehicle-kind-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << "rodeira: vehicle/1\nmodel: other\n";
  EXPECT_TRUE(LoadVehicle(path, {}, more).ok());
  EXPECT_FALSE(LoadVehicle(path).ok());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace rodeira::dynamics
