// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/bicycle_settings.hpp"

#include "common/core/base/constants.hpp"
#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;

BodySettings ReadBody(const Map& given) {
  const config::DeclaredMap map(given, BodyKeys());
  BodySettings body;
  body.mass_kg = map.Number("mass_kg");
  body.roll_inertia_kgm2 = map.Number("roll_inertia_kgm2");
  body.pitch_inertia_kgm2 = map.Number("pitch_inertia_kgm2");
  body.yaw_inertia_kgm2 = map.Number("yaw_inertia_kgm2");
  body.cg_height_m = map.Number("cg_height_m");
  body.wheelbase_m = map.Number("wheelbase_m");
  body.cg_to_front_axle_m = map.Number("cg_to_front_axle_m");
  body.drag_area_m2 = map.Number("drag_area_m2");
  body.air_density_kgpm3 = map.Number("air_density_kgpm3");
  if (body.cg_to_front_axle_m >= body.wheelbase_m) {
    map.map().Problem(
        "cg_to_front_axle_m", "config.wrong_order",
        "'body.cg_to_front_axle_m' is not below 'body.wheelbase_m'; the centre of gravity must lie between the axles");
  }
  return body;
}

SteeringSettings ReadBicycleSteering(const Map& given) {
  const config::DeclaredMap map(given, SteeringKeys());
  SteeringSettings steering;
  steering.ratio = map.Number("ratio");
  steering.limit_rad = map.Number("wheel_limit_rad");
  steering.mechanical_trail_m = map.Number("mechanical_trail_m");
  steering.scrub_radius_m = map.Number("scrub_radius_m");
  steering.pneumatic_trail_m = map.Number("pneumatic_trail_m");
  constexpr double kMaxLock_rad = 1.2;
  if (steering.limit_rad / steering.ratio > kMaxLock_rad) {
    map.map().Problem("wheel_limit_rad",
                      "'steering.wheel_limit_rad' over 'steering.ratio' turns the front wheels by more than 1.2 rad");
  }
  return steering;
}

VehicleDimensions ReadBicycleDimensions(const Map& root, const BicycleSettings& bicycle) {
  const config::DeclaredMap map(root.Child("dimensions"), DimensionKeys());
  VehicleDimensions dimensions;
  dimensions.wheelbase_m = bicycle.body.wheelbase_m;
  dimensions.track_front_m = map.Number("track_front_m");
  dimensions.track_rear_m = map.Number("track_rear_m");
  dimensions.front_m = map.Number("front_m");
  dimensions.rear_m = map.Number("rear_m");
  dimensions.width_m = map.Number("width_m");
  dimensions.height_m = map.Number("height_m");
  dimensions.wheel_radius_m = bicycle.wheel.radius_m;
  dimensions.wheel_width_m = bicycle.wheel.width_m;
  dimensions.mass_kg = bicycle.body.mass_kg;
  dimensions.steering_ratio = bicycle.steering.ratio;
  dimensions.steering_wheel_limit_rad = bicycle.steering.limit_rad;
  dimensions.forward_gears = static_cast<int>(bicycle.powertrain.gearbox.forward.size());
  return dimensions;
}

}  // namespace

BicycleSettings ReadBicycle(const Map& given) {
  const config::DeclaredMap root(given, VehicleSchema().keys);
  BicycleSettings bicycle;
  bicycle.body = ReadBody(root.Child("body").map());
  bicycle.steering = ReadBicycleSteering(root.Child("steering").map());
  const config::DeclaredMap suspension = root.Child("suspension");
  bicycle.suspension = {ReadSuspension(suspension.Child("front").map()),
                        ReadSuspension(suspension.Child("rear").map())};
  const config::DeclaredMap tyre = root.Child("tyre");
  bicycle.tyre = {ReadTyre(tyre.Child("front").map()), ReadTyre(tyre.Child("rear").map())};
  bicycle.wheel = ReadWheel(root.Child("wheel").map());
  for (TyreSettings& each : bicycle.tyre) {
    if (!each.aligning && each.pneumatic_trail_m == 0.0) each.pneumatic_trail_m = bicycle.steering.pneumatic_trail_m;
    if (each.aligning && each.aligning->unloaded_radius == 0.0) each.aligning->unloaded_radius = bicycle.wheel.radius_m;
  }
  bicycle.brakes = ReadBrakes(root.Child("brakes").map());
  bicycle.assists = ReadAssists(root.MapWith("assists"), bicycle.brakes);
  bicycle.powertrain = ReadPowertrain(given);
  bicycle.dimensions = ReadBicycleDimensions(root.MapWith("dimensions"), bicycle);
  return bicycle;
}

assists::AssistCar AssistCarOf(const BicycleSettings& car) {
  assists::AssistCar known;
  known.rolling_radius_m = car.wheel.rolling_radius_m;
  known.wheel_inertia_kgm2 = car.wheel.inertia_kgm2;
  known.wheelbase_m = car.body.wheelbase_m;
  known.track_m = {car.dimensions.track_front_m, car.dimensions.track_rear_m};
  known.mass_kg = car.body.mass_kg;
  known.cg_height_m = car.body.cg_height_m;
  const double rear_share = car.body.cg_to_front_axle_m / car.body.wheelbase_m;
  for (std::size_t i = 0; i < kWheels; ++i) {
    known.static_load_N[i] =
        0.5 * car.body.mass_kg * base::kGravity_mps2 * (AxleOf(i) == 0 ? 1.0 - rear_share : rear_share);
    known.driven[i] = Drives(car.powertrain.driven, AxleOf(i));
  }
  return known;
}

}  // namespace rodeira::dynamics
