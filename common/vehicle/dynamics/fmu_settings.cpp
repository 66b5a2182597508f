// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/fmu_model.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"

namespace rodeira::dynamics {

using config::Range;

FmuSettings ReadFmu(const config::Map& root) {
  FmuSettings fmu;
  fmu.fmu = root.Path("fmu");
  const config::Map names = root.OptionalChild("names");
  for (const std::string& name : names.Keys()) {
    fmu.names.own[name] = names.Text(name);
    fmu.names.places[name] = names.Place(name);
  }
  const config::Map parameters = root.OptionalChild("parameters");
  for (const std::string& name : parameters.Keys()) {
    fmu.parameters[name] = parameters.Number(name);
    fmu.parameter_places[name] = parameters.Place(name);
  }
  fmu.enveloping = ReadEnveloping(root);
  const config::Map map = root.Child("dimensions");
  VehicleDimensions& d = fmu.dimensions;
  d.wheelbase_m = map.Number("wheelbase_m", {0.5, 20.0});
  d.track_front_m = map.Number("track_front_m", {0.3, 5.0});
  d.track_rear_m = map.Number("track_rear_m", {0.3, 5.0});
  d.wheel_radius_m = map.Number("wheel_radius_m", {0.05, 2.0});
  d.wheel_width_m = map.Number("wheel_width_m", {0.02, 1.0});
  d.front_m = map.Number("front_m", Range::Positive());
  d.rear_m = map.Number("rear_m", Range::Positive());
  d.width_m = map.Number("width_m", Range::Positive());
  d.height_m = map.Number("height_m", Range::Positive());
  d.mass_kg = map.Number("mass_kg", {50.0, 100000.0});
  d.steering_ratio = map.Number("steering_ratio", {1.0, 50.0});
  d.steering_wheel_limit_rad = map.Number("steering_wheel_limit_rad", {0.1, 50.0});
  d.forward_gears = static_cast<int>(map.Integer("forward_gears", 1, 30));
  return fmu;
}

}  // namespace rodeira::dynamics
