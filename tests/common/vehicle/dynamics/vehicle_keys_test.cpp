// SPDX-License-Identifier: Apache-2.0
// The keys of vehicle files: each with its type, its bounds and its default.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/multibody_settings.hpp"
#include "common/vehicle/dynamics/ode_settings.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::dynamics {
namespace {

// What every model's file begins with.
std::string ReadBeginning(const config::Map& root, const config::Schema& schema) {
  const config::DeclaredMap declared(root, schema.keys);
  (void)declared.Word("rodeira");
  (void)declared.Text("name");
  const config::Map models = declared.MapWith("models").OptionalChild("models");
  for (const std::string& name : models.Keys()) (void)models.Path(name);
  return declared.Word("model");
}

// What a slip curve needs beside each of its keys, and the bounds that its other keys forbid.
void AddSlipCurve(const std::string& axle, config::Companions& others, std::set<std::string>& no_bounds) {
  const config::Values curve{{axle + ".magic_formula", ""}};
  others[axle + ".slip_curve"] = curve;
  others[axle + ".aligning"] = {{axle + ".magic_formula", ""}, {axle + ".slip_curve.lateral.extremum_slip", "0.1"}};
  for (const config::Key& key : AligningKeys()) others[axle + ".aligning." + key.name] = others[axle + ".aligning"];
  for (const std::string& way : {axle + ".slip_curve.longitudinal", axle + ".slip_curve.lateral"}) {
    others[way] = others[way + ".asymptote_slip"] = others[way + ".extremum_slip"] = curve;
    others[way + ".asymptote_value"] = others[way + ".extremum_value"] = curve;
    others[way + ".extremum_slip"][way + ".asymptote_slip"] = "10";
    others[way + ".asymptote_value"][way + ".extremum_value"] = "5";
    others[way + ".extremum_value"][way + ".asymptote_value"] = "0";
    no_bounds.insert(way + ".asymptote_slip");
  }
}

// The differentials of a car with all wheels driven.
void AddAllWheelDrive(config::Companions& others) {
  const config::Values all{{"driven_axle", "all"}};
  for (const std::string name : {"centre_differential", "rear_differential"}) others[name] = all;
  for (const config::Key& key : CentreDifferentialKeys()) others["centre_differential." + key.name] = all;
  for (const config::Key& key : DifferentialKeys()) others["rear_differential." + key.name] = all;
}

// A generated file for each declared key. Speeds of the engine and points of a slip curve are bounds of each other; the
// wheels of the model `ode` are lighter than the car, and its body is over the ground.
TEST(VehicleKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto file = config::File::Parse(text, "car.yaml");
    if (!file) return file.error().Text();
    if (ReadBeginning(file.value().root(), VehicleSchema()) == "ode")
      (void)ReadOde(file.value().root());
    else
      (void)ReadBicycle(file.value().root());
    const auto status = file.value().Finish();
    return status ? "" : status.error().Text();
  };
  config::Companions others{{"model=ode", {{"ode.body_friction", "0.5"}}},
                            {"ode", {{"model", "ode"}}},
                            {"body.wheelbase_m", {{"body.cg_to_front_axle_m", "0.1"}}},
                            {"steering.ratio", {{"steering.wheel_limit_rad", "1"}}},
                            {"steering.wheel_limit_rad", {{"steering.ratio", "50"}}}};
  for (const config::Key& key : OdeKeys()) others["ode." + key.name] = {{"model", "ode"}};
  std::set<std::string> no_bounds{"engine.idle_rpm",   "engine.stall_rpm",      "engine.cut_rpm",
                                  "engine.resume_rpm", "automatic.bite_rpm",    "automatic.closed_rpm",
                                  "ode.wheel_mass_kg", "ode.wheel_across_kgm2", "ode.clearance_m"};
  for (const std::string axle : {"tyre.front", "tyre.rear"}) AddSlipCurve(axle, others, no_bounds);
  AddAllWheelDrive(others);
  config::ExpectEveryKey(VehicleSchema(), problem, others, no_bounds);
}

TEST(VehicleKeys, EveryDeclaredKeyOfAMultibodyCarKeepsItsTypeAndBounds) {
  const auto problem = [](const std::string& text) -> std::string {
    const auto file = config::File::Parse(text, "car.yaml");
    if (!file) return file.error().Text();
    (void)ReadBeginning(file.value().root(), MultibodySchema());
    (void)ReadMultibody(file.value().root());
    const auto status = file.value().Finish();
    return status ? "" : status.error().Text();
  };
  config::Companions others;
  std::set<std::string> no_bounds{"engine.idle_rpm",   "engine.stall_rpm",   "engine.cut_rpm",
                                  "engine.resume_rpm", "automatic.bite_rpm", "automatic.closed_rpm"};
  for (const std::string axle : {"tyre.front", "tyre.rear"}) AddSlipCurve(axle, others, no_bounds);
  AddAllWheelDrive(others);
  config::ExpectEveryKey(MultibodySchema(), problem, others, no_bounds);
}

// A shared object reads the others.
TEST(VehicleKeys, EveryDeclaredKeyOfALibraryKeepsItsType) {
  config::ExpectEveryKey(LibrarySchema(), [](const std::string& text) -> std::string {
    const auto file = config::File::Parse(text, "car.yaml");
    if (!file) return file.error().Text();
    (void)ReadBeginning(file.value().root(), LibrarySchema());
    (void)file.value().root().Path("library");
    const auto status = file.value().Finish();
    return status ? "" : status.error().Text();
  });
}

TEST(VehicleKeys, EveryDeclaredKeyOfAnFmuKeepsItsTypeAndBounds) {
  config::ExpectEveryKey(FmuSchema(), [](const std::string& text) -> std::string {
    const auto file = config::File::Parse(text, "car.yaml");
    if (!file) return file.error().Text();
    (void)ReadBeginning(file.value().root(), FmuSchema());
    (void)ReadFmu(file.value().root());
    const auto status = file.value().Finish();
    return status ? "" : status.error().Text();
  });
}

}  // namespace
}  // namespace rodeira::dynamics
