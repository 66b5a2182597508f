// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/bicycle_settings.hpp"

#include "common/vehicle/dynamics/parts_file.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;
using config::Range;

BodySettings ReadBody(const Map& map) {
  BodySettings body;
  body.mass_kg = map.Number("mass_kg", {50.0, 100000.0});
  body.roll_inertia_kgm2 = map.Number("roll_inertia_kgm2", Range::Positive());
  body.pitch_inertia_kgm2 = map.Number("pitch_inertia_kgm2", Range::Positive());
  body.yaw_inertia_kgm2 = map.Number("yaw_inertia_kgm2", Range::Positive());
  body.cg_height_m = map.Number("cg_height_m", {0.05, 5.0});
  body.wheelbase_m = map.Number("wheelbase_m", {0.5, 20.0});
  body.cg_to_front_axle_m = map.Number("cg_to_front_axle_m", Range::Positive());
  body.drag_area_m2 = map.Number("drag_area_m2", Range::NotNegative());
  body.air_density_kgpm3 = map.Number("air_density_kgpm3", {0.0, 3.0}, body.air_density_kgpm3);
  if (body.cg_to_front_axle_m >= body.wheelbase_m) {
    map.Problem(
        "cg_to_front_axle_m", "config.wrong_order",
        "'body.cg_to_front_axle_m' is not below 'body.wheelbase_m'; the centre of gravity must lie between the axles");
  }
  return body;
}

SteeringSettings ReadBicycleSteering(const Map& map) {
  SteeringSettings steering;
  steering.ratio = map.Number("ratio", {1.0, 50.0});
  steering.limit_rad = map.Number("wheel_limit_rad", {0.1, 50.0});
  steering.mechanical_trail_m = map.Number("mechanical_trail_m", {0.0, 0.2}, steering.mechanical_trail_m);
  steering.pneumatic_trail_m = map.Number("pneumatic_trail_m", {0.0, 0.2}, steering.pneumatic_trail_m);
  constexpr double kMaxLock_rad = 1.2;
  if (steering.limit_rad / steering.ratio > kMaxLock_rad) {
    map.Problem("wheel_limit_rad",
                "'steering.wheel_limit_rad' over 'steering.ratio' turns the front wheels by more than 1.2 rad");
  }
  return steering;
}

VehicleDimensions ReadBicycleDimensions(const Map& root, const BicycleSettings& bicycle) {
  const Map map = root.Child("dimensions");
  VehicleDimensions dimensions;
  dimensions.wheelbase_m = bicycle.body.wheelbase_m;
  dimensions.track_front_m = map.Number("track_front_m", {0.3, 5.0});
  dimensions.track_rear_m = map.Number("track_rear_m", {0.3, 5.0});
  dimensions.front_m = map.Number("front_m", Range::Positive());
  dimensions.rear_m = map.Number("rear_m", Range::Positive());
  dimensions.width_m = map.Number("width_m", Range::Positive());
  dimensions.height_m = map.Number("height_m", Range::Positive());
  dimensions.wheel_radius_m = bicycle.wheel.radius_m;
  dimensions.wheel_width_m = bicycle.wheel.width_m;
  dimensions.mass_kg = bicycle.body.mass_kg;
  dimensions.steering_ratio = bicycle.steering.ratio;
  dimensions.steering_wheel_limit_rad = bicycle.steering.limit_rad;
  dimensions.forward_gears = static_cast<int>(bicycle.powertrain.gearbox.forward.size());
  return dimensions;
}

}  // namespace

BicycleSettings ReadBicycle(const Map& root) {
  BicycleSettings bicycle;
  bicycle.body = ReadBody(root.Child("body"));
  bicycle.steering = ReadBicycleSteering(root.Child("steering"));
  const Map suspension = root.Child("suspension");
  bicycle.suspension = {ReadSuspension(suspension.Child("front")), ReadSuspension(suspension.Child("rear"))};
  const Map tyre = root.Child("tyre");
  bicycle.tyre = {ReadTyre(tyre.Child("front")), ReadTyre(tyre.Child("rear"))};
  bicycle.wheel = ReadWheel(root.Child("wheel"));
  bicycle.brakes = ReadBrakes(root.Child("brakes"));
  bicycle.powertrain = ReadPowertrain(root);
  bicycle.front_driven = root.Choice("driven_axle", {"front", "rear"}) != "rear";
  bicycle.dimensions = ReadBicycleDimensions(root, bicycle);
  return bicycle;
}

}  // namespace rodeira::dynamics
