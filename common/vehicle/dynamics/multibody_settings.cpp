// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/multibody_settings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"

namespace rodeira::dynamics {
namespace {

using config::DeclaredMap;
using multibody::DrawingReader;
using multibody::EntityKind;

constexpr std::array<const char*, kWheels> kWheelNames = {"front_left", "front_right", "rear_left", "rear_right"};

MultibodyWheelSettings ReadHungWheel(const DeclaredMap& declared, const DrawingReader& reader) {
  const config::Map& map = declared.map();
  MultibodyWheelSettings wheel;
  const auto& entities = reader.drawing().entities;
  if (const auto carrier = reader.Body(declared, "carrier")) {
    wheel.carrier = *carrier;
    if (!reader.drawing().bodies[static_cast<std::size_t>(*carrier)].turns)
      map.Problem("carrier", "config.wrong_kind", "a wheel's carrier must be a general body");
  }
  if (const auto centre = reader.Entity(map, "centre", declared.Text("centre"), false)) {
    wheel.centre = *centre;
    if (entities[static_cast<std::size_t>(*centre)].kind != EntityKind::kPoint)
      map.Problem("centre", "config.wrong_kind", "a wheel's centre must be a point");
  }
  if (const auto axle = reader.Entity(map, "axle", declared.Text("axle"), false)) {
    wheel.axle = *axle;
    const auto& entity = entities[static_cast<std::size_t>(*axle)];
    if (entity.kind != EntityKind::kVector || entity.at.y() < 0.8)
      map.Problem("axle", "config.wrong_kind", "a wheel's axle must be a vector that is drawn to the left");
  }
  if (const auto suspension = reader.LoadNamed(declared, "suspension")) wheel.suspension = *suspension;
  if (const auto travel = reader.Entity(map, "travel", declared.Text("travel"), true)) wheel.travel = *travel;
  return wheel;
}

MultibodySteeringSettings ReadMultibodySteering(const DeclaredMap& map, const DrawingReader& reader) {
  MultibodySteeringSettings steering;
  if (const auto angle = reader.Entity(map.map(), "angle", map.Text("angle"), true)) steering.angle = *angle;
  steering.ratio = map.Number("ratio");
  steering.limit_rad = map.Number("wheel_limit_rad");
  steering.column_Nmprad = map.Number("column_Nmprad");
  steering.column_Nmsprad = map.Number("column_Nmsprad");
  return steering;
}

double Mean(const MultibodySettings& car, std::size_t a, std::size_t b, int component) {
  const auto& entities = car.mechanism.entities;
  return 0.5 * (entities[static_cast<std::size_t>(car.wheels[a].centre)].at[component] +
                entities[static_cast<std::size_t>(car.wheels[b].centre)].at[component]);
}

VehicleDimensions ReadMultibodyDimensions(const DeclaredMap& map, const MultibodySettings& car) {
  const auto& entities = car.mechanism.entities;
  const auto track = [&](std::size_t left, std::size_t right) {
    return entities[static_cast<std::size_t>(car.wheels[left].centre)].at.y() -
           entities[static_cast<std::size_t>(car.wheels[right].centre)].at.y();
  };
  VehicleDimensions dimensions;
  dimensions.wheelbase_m = Mean(car, kFrontLeft, kFrontRight, 0) - Mean(car, kRearLeft, kRearRight, 0);
  dimensions.track_front_m = track(kFrontLeft, kFrontRight);
  dimensions.track_rear_m = track(kRearLeft, kRearRight);
  dimensions.front_m = map.Number("front_m");
  dimensions.rear_m = map.Number("rear_m");
  dimensions.width_m = map.Number("width_m");
  dimensions.height_m = map.Number("height_m");
  dimensions.wheel_radius_m = car.wheel.radius_m;
  dimensions.wheel_width_m = car.wheel.width_m;
  dimensions.mass_kg = car.mass_kg;
  dimensions.steering_ratio = car.steering.ratio;
  dimensions.steering_wheel_limit_rad = car.steering.limit_rad;
  dimensions.forward_gears = static_cast<int>(car.powertrain.gearbox.forward.size());
  return dimensions;
}

}  // namespace

MultibodySettings ReadMultibody(const config::Map& given) {
  MultibodySettings car;
  const DeclaredMap root(given, MultibodySchema().keys);
  const config::Map mechanism = root.MapWith("mechanism").Child("mechanism");
  const DrawingReader reader(mechanism);
  mechanism.IgnoreKey("outputs");  // MultibodyModel::ReadOutputs
  const DeclaredMap body = root.Child("body");
  if (const auto chassis = reader.Body(body, "chassis")) {
    car.chassis = *chassis;
    if (!reader.drawing().bodies[static_cast<std::size_t>(*chassis)].turns)
      body.map().Problem("chassis", "config.wrong_kind", "the chassis must be a general body");
  }
  car.drag_area_m2 = body.Number("drag_area_m2");
  car.air_density_kgpm3 = body.Number("air_density_kgpm3");
  car.drag_point_m.z() = body.Number("drag_height_m");
  car.longest_substep_s = root.Number("longest_substep_s");
  const DeclaredMap wheels = root.Child("wheels");
  for (std::size_t i = 0; i < kWheels; ++i) car.wheels[i] = ReadHungWheel(wheels.Child(kWheelNames[i]), reader);
  car.steering = ReadMultibodySteering(root.Child("steering"), reader);
  const DeclaredMap tyre = root.Child("tyre");
  car.tyre = {ReadTyre(tyre.Child("front").map()), ReadTyre(tyre.Child("rear").map())};
  car.wheel = ReadWheel(root.Child("wheel").map());
  for (TyreSettings& each : car.tyre)
    if (each.aligning && each.aligning->unloaded_radius == 0.0) each.aligning->unloaded_radius = car.wheel.radius_m;
  car.tyre_damping_Nspm = tyre.Number("vertical_damping_Nspm");
  car.brakes = ReadBrakes(root.Child("brakes").map());
  car.assists = ReadAssists(root.MapWith("assists"), car.brakes);
  car.powertrain = ReadPowertrain(given);
  car.mechanism = reader.drawing();
  for (const auto& part : car.mechanism.bodies) car.mass_kg += part.mass_kg;
  if (!car.mechanism.entities.empty()) car.dimensions = ReadMultibodyDimensions(root.Child("dimensions"), car);
  return car;
}

}  // namespace rodeira::dynamics
