// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {

FmuSettings ReadFmu(const config::Map& given) {
  const config::DeclaredMap declared(given, FmuSchema().keys);
  const config::Map& root = given;
  FmuSettings fmu;
  fmu.fmu = declared.MapWith("fmu").Path("fmu");
  const config::Map names = declared.MapWith("names").OptionalChild("names");
  for (const std::string& name : names.Keys()) {
    fmu.names.own[name] = names.Text(name);
    fmu.names.places[name] = names.Place(name);
  }
  const config::Map parameters = declared.MapWith("parameters").OptionalChild("parameters");
  for (const std::string& name : parameters.Keys()) {
    fmu.parameters[name] = parameters.Number(name);
    fmu.parameter_places[name] = parameters.Place(name);
  }
  fmu.enveloping = ReadEnveloping(declared.MapWith("enveloping"));
  const config::DeclaredMap map(root.Child("dimensions"), FmuDimensionKeys());
  VehicleDimensions& d = fmu.dimensions;
  d.wheelbase_m = map.Number("wheelbase_m");
  d.track_front_m = map.Number("track_front_m");
  d.track_rear_m = map.Number("track_rear_m");
  d.wheel_radius_m = map.Number("wheel_radius_m");
  d.wheel_width_m = map.Number("wheel_width_m");
  d.front_m = map.Number("front_m");
  d.rear_m = map.Number("rear_m");
  d.width_m = map.Number("width_m");
  d.height_m = map.Number("height_m");
  d.mass_kg = map.Number("mass_kg");
  d.steering_ratio = map.Number("steering_ratio");
  d.steering_wheel_limit_rad = map.Number("steering_wheel_limit_rad");
  d.forward_gears = static_cast<int>(map.Integer("forward_gears"));
  return fmu;
}

}  // namespace rodeira::dynamics
