// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_schema.hpp"

#include "common/vehicle/dynamics/multibody_settings.hpp"

namespace rodeira::dynamics {
namespace {

using config::Key;
using config::MappingKey;
using config::Required;

// For generated files: a mechanism with the names of the samples below.
constexpr const char* kSampleMechanism =
    "{points: {hub: {at_m: [0, 0, 1]}, foot: {at_m: [0, 0, 0]}}, vectors: {ahead: {direction: [1, 0, 0]}, "
    "axle: {direction: [0, 1, 0]}, up: {direction: [0, 0, 1]}}, "
    "bodies: {chassis: {points: [hub], vectors: [ahead, axle, up], mass_kg: 1000, centre_m: [0, 0, 1], "
    "inertia_kgm2: [1, 1, 1]}}, angles: {pinion: {rotor_kgm2: 1}}, distances: {strut: {points: [foot, hub]}}, "
    "forces: {spring: {kind: spring, coordinate: strut}}}";

// Keys of every model: its name comes from `models`.
std::vector<Key> FirstKeys(std::vector<std::string> models) {
  const std::string first = models.front();
  return config::FileKeys("vehicle/1",
                          {config::TextKey("name", "", "Name, for the reader."),
                           Required(config::WordKey("model", std::move(models), first, "Model of the car.")),
                           config::NamedValueKey("models", config::TextItem("ode.yaml"),
                                                 "Files for other models, for --set vehicle.model=NAME.")});
}

config::Schema MakeVehicleSchema() {
  const Key driven = DrivenAxleKeys().front();
  std::vector<Key> keys = FirstKeys({"bicycle", "ode"});
  for (Key& key : std::vector<Key>{
           driven, Required(MappingKey("body", BodyKeys(), "The whole car.")),
           Required(MappingKey("dimensions", DimensionKeys(), "Dimensions.")),
           Required(MappingKey("steering", SteeringKeys(), "Steering.")),
           Required(MappingKey(
               "suspension",
               {Required(MappingKey("front", SuspensionKeys(), "Front axle.")),
                Required(config::Summarised("as `front`", MappingKey("rear", SuspensionKeys(), "Rear axle.")))},
               "Suspension.")),
           Required(MappingKey("wheel", WheelKeys(), "Wheels.")),
           Required(
               MappingKey("tyre",
                          {Required(MappingKey("front", TyreKeys(), "Front tyres.")),
                           Required(config::Summarised("as `front`", MappingKey("rear", TyreKeys(), "Rear tyres.")))},
                          "Tyres.")),
           Required(MappingKey("brakes", BrakeKeys(), "Brakes.")),
           MappingKey("assists", AssistKeys(), "What intervenes in brakes and engine."),
           Required(MappingKey("engine", EngineKeys(), "Engine.")),
           Required(MappingKey("clutch", ClutchKeys(), "Clutch.")),
           Required(MappingKey("gearbox", GearboxKeys(), "Gearbox.")),
           MappingKey("differential", DifferentialKeys(),
                      "Differential, that of the front axle with all driven; open."),
           config::Summarised("as `differential`",
                              MappingKey("rear_differential", DifferentialKeys(), "Of the rear axle with all driven.")),
           MappingKey("centre_differential", CentreDifferentialKeys(), "Between the axles with all driven; open."),
           MappingKey("automatic", AutomaticKeys(), "Automatic gear changes."),
           MappingKey("ode", OdeKeys(), "Only for the model `ode`, which needs it.")})
    keys.push_back(std::move(key));
  return {"vehicle", "vehicle/1", "A car of the model 'bicycle' or 'ode'.", std::move(keys)};
}

config::Schema MakeMultibodySchema() {
  std::vector<Key> wheels{Required(MappingKey("front_left", HungWheelKeys(), "Front left wheel."))};
  for (const char* name : {"front_right", "rear_left", "rear_right"})
    wheels.push_back(
        Required(config::Summarised("as `front_left`", MappingKey(name, HungWheelKeys(), "The other wheels."))));
  std::vector<Key> keys = FirstKeys({"multibody"});
  for (Key& key : std::vector<Key>{
           DrivenAxleKeys().front(),
           config::NumberKey("longest_substep_s", {1e-5, 0.01}, MultibodySettings{}.longest_substep_s,
                             "Longer steps are divided."),
           Required(config::OtherKey("mechanism", "keys of a mechanism file", kSampleMechanism,
                                     "The car as it stands on z = 0: x forward, y left.")),
           Required(MappingKey("body", ChassisKeys(), "The chassis.")),
           Required(MappingKey("wheels", std::move(wheels), "How the wheels hang.")),
           Required(MappingKey("steering", ColumnKeys(), "Steering.")),
           Required(MappingKey("dimensions", OuterDimensionKeys(), "Dimensions.")),
           Required(config::Summarised("as of `bicycle`", MappingKey("wheel", WheelKeys(), "Wheels."))),
           Required(MappingKey(
               "tyre",
               {Required(config::Summarised("as of `bicycle`", MappingKey("front", TyreKeys(), "Front tyres."))),
                Required(config::Summarised("as of `bicycle`", MappingKey("rear", TyreKeys(), "Rear tyres."))),
                config::NumberKey("vertical_damping_Nspm", {0.0, 1e5}, 0.0, "Vertical damping of a tyre.")},
               "Tyres.")),
           Required(config::Summarised("as of `bicycle`", MappingKey("brakes", BrakeKeys(), "Brakes."))),
           config::Summarised("as of `bicycle`", MappingKey("assists", AssistKeys(), "Brakes and engine.")),
           Required(config::Summarised("as of `bicycle`", MappingKey("engine", EngineKeys(), "Engine."))),
           Required(config::Summarised("as of `bicycle`", MappingKey("clutch", ClutchKeys(), "Clutch."))),
           Required(config::Summarised("as of `bicycle`", MappingKey("gearbox", GearboxKeys(), "Gearbox."))),
           config::Summarised("as of `bicycle`", MappingKey("differential", DifferentialKeys(), "Differential.")),
           config::Summarised("as of `bicycle`",
                              MappingKey("rear_differential", DifferentialKeys(), "Of the rear axle.")),
           config::Summarised("as of `bicycle`",
                              MappingKey("centre_differential", CentreDifferentialKeys(), "Between the axles.")),
           config::Summarised("as of `bicycle`", MappingKey("automatic", AutomaticKeys(), "Automatic gear changes."))})
    keys.push_back(std::move(key));
  return {"vehicle.multibody", "vehicle/1", "A car of the model 'multibody'.", std::move(keys)};
}

config::Schema MakeLibrarySchema() {
  std::vector<Key> keys = FirstKeys({"library"});
  keys.push_back(
      config::RequiredTextKey("library", "car.so", "Shared object with the model; it reads all other keys."));
  return {"vehicle.library", "vehicle/1", "A car of a shared object.", std::move(keys), true};
}

config::Schema MakeFmuSchema() {
  std::vector<Key> keys = FirstKeys({"fmu"});
  for (Key& key : std::vector<Key>{
           config::RequiredTextKey("fmu", "car.fmu", "The FMU."),
           config::NamedValueKey("names", config::TextItem("x"), "Variable of the FMU for the quantity of this name."),
           config::NamedValueKey("parameters", config::NumberItem({}), "Value of the parameter of this name."),
           EnvelopingKey(), Required(MappingKey("dimensions", FmuDimensionKeys(), "Dimensions."))})
    keys.push_back(std::move(key));
  return {"vehicle.fmu", "vehicle/1", "A car of the model 'fmu'.", std::move(keys)};
}

}  // namespace

const config::Schema& VehicleSchema() {
  static const config::Schema schema = MakeVehicleSchema();
  return schema;
}

const config::Schema& MultibodySchema() {
  static const config::Schema schema = MakeMultibodySchema();
  return schema;
}

const config::Schema& LibrarySchema() {
  static const config::Schema schema = MakeLibrarySchema();
  return schema;
}

const config::Schema& FmuSchema() {
  static const config::Schema schema = MakeFmuSchema();
  return schema;
}

}  // namespace rodeira::dynamics
