// SPDX-License-Identifier: Apache-2.0
// Vehicles of other makers: units, causalities and names of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/fmu_units.hpp"
#include "common/vehicle/dynamics/vehicle_notes.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"
#include "tests/names.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Changes = std::vector<std::pair<std::string, std::string>>;

const std::string kVx = "valueReference=\"6\" causality=\"output\"><Real unit=\"m/s\"";
const std::string kUnits =
    "<UnitDefinitions><Unit name=\"km/h\"><BaseUnit m=\"1\" s=\"-1\" factor=\"0.2777777777777778\"/></Unit>"
    "<Unit name=\"metre\"><BaseUnit m=\"1\"/></Unit><Unit name=\"mm\"><BaseUnit m=\"1\" factor=\"0.001\"/></Unit>"
    "<Unit name=\"deg\"><BaseUnit rad=\"1\" factor=\"0.0174532925199433\"/></Unit>"
    "<Unit name=\"degF\"><BaseUnit K=\"1\" factor=\"0.5555555555555556\" offset=\"255.372\"/></Unit></UnitDefinitions>"
    "<TypeDefinitions><SimpleType name=\"Speed\"><Real unit=\"km/h\"/></SimpleType></TypeDefinitions>\n  ";

class FmuMapping : public ::testing::Test {
 protected:
  base::Result<std::unique_ptr<VehicleModel>> Load(const Changes& changes, const std::string& names) const {
    folder_.Pack(changes);
    const auto file = folder_.WriteCar();
    std::string text = base::ReadText(file).value();
    const std::string from = "{heading_rad: body.yaw}";
    text.replace(text.find(from), from.size(), names);
    EXPECT_TRUE(base::WriteWhole(file, text).ok());
    return LoadVehicle(file);
  }
  std::unique_ptr<VehicleModel> Car(const Changes& changes,
                                    const std::string& names = "{heading_rad: body.yaw}") const {
    auto car = Load(changes, names);
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return std::move(car).value();
  }
  std::string Refusal(const Changes& changes, const std::string& names = "{heading_rad: body.yaw}") const {
    const auto car = Load(changes, names);
    EXPECT_FALSE(car.ok());
    if (car.ok()) return "";
    EXPECT_EQ(car.error().exit_status(), 2);
    return car.error().Text();
  }

  fmi::FmuFolder folder_;
};

Changes WithUnits(Changes more) {
  more.emplace_back("<ModelVariables>", kUnits + "<ModelVariables>");
  return more;
}

// A variable takes the unit of its declared type (FMI 2.0.4, 2.2.3); 36 of its km/h are 10 of our m/s.
TEST_F(FmuMapping, AUnitOfTheDeclaredTypeIsConverted) {
  auto car = Car(WithUnits({{kVx, "valueReference=\"6\" causality=\"output\"><Real declaredType=\"Speed\""}}));
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.speed_mps = 36.0}, ground).ok());
  EXPECT_NEAR(car->state().v_WB_W.x(), 10.0, 1e-12);
  EXPECT_THAT(NotesOn(*car, folder_.path() / "car.yaml"),
              ElementsAre(HasSubstr("units of the FMU are converted: velocity_x_mps (km/h to m/s)")));
}

// An input is told in its own unit: the car of 90 deg heads for 90 of them.
TEST_F(FmuMapping, InputsAreToldInTheUnitOfTheFmu) {
  auto car = Car(WithUnits({{"valueReference=\"22\" causality=\"parameter\"><Real unit=\"rad\"",
                             "valueReference=\"22\" causality=\"parameter\"><Real unit=\"deg\""},
                            {"valueReference=\"5\" causality=\"output\"><Real unit=\"rad\"",
                             "valueReference=\"5\" causality=\"output\"><Real unit=\"deg\""},
                            {"valueReference=\"19\" causality=\"parameter\"><Real unit=\"m\"",
                             "valueReference=\"19\" causality=\"parameter\"><Real unit=\"mm\""},
                            {"valueReference=\"0\" causality=\"output\"><Real unit=\"m\"",
                             "valueReference=\"0\" causality=\"output\"><Real unit=\"mm\""},
                            {"valueReference=\"1\" causality=\"output\"><Real unit=\"m\"",
                             "valueReference=\"1\" causality=\"output\"><Real unit=\"metre\""}}));
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.x_m = 2.5, .y_m = -4.0, .heading_rad = 0.7}, ground).ok());
  EXPECT_NEAR(car->state().p_WB_W.x(), 2.5, 1e-12);
  EXPECT_NEAR(car->state().p_WB_W.y(), -4.0, 1e-12);
  EXPECT_NEAR(car->state().heading_rad(), 0.7, 1e-12);
}

TEST_F(FmuMapping, AUnitOfAnotherQuantityIsRefusedWithItsLine) {
  EXPECT_THAT(Refusal(WithUnits({{kVx, "valueReference=\"6\" causality=\"output\"><Real unit=\"degF\""}})),
              Names("'velocity_x_mps' … 'degF' … 'm/s'"));
  EXPECT_THAT(Refusal({{kVx, "valueReference=\"6\" causality=\"output\"><Real unit=\"furlong/h\""}}),
              HasSubstr("car.fmu: modelDescription.xml:12: 'velocity_x_mps'"));
}

// Usual units count where the file defines none; radian may be missing in a definition of a degree.
TEST(FmuUnits, DefinitionsCountBeforeTheUsualUnits) {
  fmi::Description none, some;
  some.units["deg/s"] = {{0, 0, -1}, 1.0, 0.0};
  some.units["km/h"] = {{0, 1, -1}, 0.2777, 0.0};
  some.units["Hz"] = {{0, 0, -1}, 1.0, 0.0};
  EXPECT_NEAR(ConversionOf(none, "km/h", "m/s")->factor, 1.0 / 3.6, 1e-15);
  EXPECT_EQ(ConversionOf(some, "km/h", "m/s")->factor, 0.2777);
  EXPECT_NEAR(ConversionOf(some, "deg/s", "rad/s")->factor, M_PI / 180.0, 1e-15);
  EXPECT_NEAR(ConversionOf(none, "rev/min", "rad/s")->factor, M_PI / 30.0, 1e-15);
  EXPECT_FALSE(ConversionOf(some, "Hz", "rad/s").has_value()) << "a turn is no radian";
  EXPECT_FALSE(ConversionOf(none, "bar", "N").has_value());
  some.units["dm"] = {{0, 1}, std::nan(""), 0.0};
  some.units["cm"] = {{0, 1}, 0.01, std::nan("")};
  EXPECT_FALSE(ConversionOf(some, "dm", "m").has_value()) << "no number";
  EXPECT_FALSE(ConversionOf(some, "cm", "m").has_value()) << "no number";
  EXPECT_TRUE(ConversionOf(none, "", "N")->is_identity());
}

// FMI 2.0.4, 2.1.7: a variable of any causality may be read.
TEST_F(FmuMapping, VariablesOfOtherCausalitiesAreRead) {
  for (const char* causality : {"local", "calculatedParameter", "parameter"}) {
    auto car = Car({{"valueReference=\"0\" causality=\"output\"",
                     "valueReference=\"0\" causality=\"" + std::string(causality) + "\""}});
    PlaneGround ground;
    ASSERT_TRUE(car->Initialise({.x_m = 3.0}, ground).ok()) << causality;
    EXPECT_EQ(car->state().p_WB_W.x(), 3.0) << causality;
  }
  EXPECT_THAT(
      Refusal({{"valueReference=\"0\" causality=\"output\"", "valueReference=\"0\" causality=\"independent\""}}),
      HasSubstr("is declared 'independent'"));
}

const std::string kQuaternion =
    "<ScalarVariable name=\"q[1]\" valueReference=\"37\" causality=\"output\"><Real/></ScalarVariable>"
    "<ScalarVariable name=\"q[2]\" valueReference=\"38\" causality=\"output\"><Real/></ScalarVariable>"
    "<ScalarVariable name=\"q[3]\" valueReference=\"39\" causality=\"output\"><Real/></ScalarVariable>"
    "<ScalarVariable name=\"q[4]\" valueReference=\"40\" "
    "causality=\"output\"><Real/></ScalarVariable></ModelVariables>";

TEST_F(FmuMapping, AQuaternionStandsForTheAngles) {
  const Changes without_angles = {{"name=\"roll_rad\"", "name=\"r\""},
                                  {"name=\"pitch_rad\"", "name=\"p\""},
                                  {"name=\"body.yaw\"", "name=\"h\""},
                                  {"</ModelVariables>", kQuaternion}};
  auto car =
      Car(without_angles, "{quaternion_w: 'q[1]', quaternion_x: 'q[2]', quaternion_y: 'q[3]', quaternion_z: 'q[4]'}");
  PlaneGround ground;
  ASSERT_TRUE(car->Initialise({.heading_rad = 1.1}, ground).ok());
  EXPECT_NEAR(car->state().heading_rad(), 1.1, 1e-12);
  EXPECT_THAT(Refusal(without_angles, "{quaternion_w: 'q[1]', quaternion_x: 'q[2]', quaternion_y: 'q[3]'}"),
              HasSubstr("no variable 'quaternion_z'"));
}

TEST_F(FmuMapping, WrongMappingsAreRefusedWithTheLineOfTheFile) {
  EXPECT_THAT(Refusal({}, "{heading_rad: body.yaw, throttle: brake}"),
              HasSubstr("car.yaml:4: 'throttle' and 'brake' are both the variable 'brake' of the FMU"));
  EXPECT_THAT(Refusal({}, "{heading_rad: body.yaw, throttle: x_m}"), Names("car.yaml:4: 'x_m' … 'output' … 'input'"));
  EXPECT_THAT(Refusal({}, "{heading_rad: steering_wheel_rad}"),
              HasSubstr("is declared 'input'; 'output' was expected"));
  EXPECT_THAT(Refusal({}, "{heading_rad: body.jaw}"), HasSubstr("car.yaml:4: the FMU has no variable 'body.jaw'"));
}

}  // namespace
}  // namespace rodeira::dynamics
