// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {
namespace {

using config::Key;
using config::MappingKey;
using config::Required;

// Keys of every model: its name comes from `models`.
std::vector<Key> FirstKeys(std::vector<std::string> models) {
  const std::string first = models.front();
  return config::FileKeys("vehicle/1",
                          {config::TextKey("name", "", "Name, for the reader."),
                           Required(config::WordKey("model", std::move(models), first, "Model of the car.")),
                           config::NamedValueKey("models", config::TextItem("ode.yaml"),
                                                 "Files of this car in other models, for --set vehicle.model=NAME.")});
}

config::Schema MakeVehicleSchema() {
  const Key driven = Required(config::WordKey("driven_axle", {"front", "rear"}, "front", "Driven axle."));
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
           MappingKey("differential", DifferentialKeys(), "Differential; open by default."),
           MappingKey("automatic", AutomaticKeys(), "Automatic gear changes."),
           MappingKey("ode", OdeKeys(), "Only for the model `ode`, which needs it.")})
    keys.push_back(std::move(key));
  return {"vehicle", "vehicle/1", "A car of the model 'bicycle' or 'ode'.", std::move(keys)};
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

const config::Schema& FmuSchema() {
  static const config::Schema schema = MakeFmuSchema();
  return schema;
}

}  // namespace rodeira::dynamics
