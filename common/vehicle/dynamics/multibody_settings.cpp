// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/multibody_settings.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"

namespace rodeira::dynamics {
namespace {

using config::Map;
using config::Range;
using multibody::DrawingReader;
using multibody::EntityKind;

constexpr std::array<const char*, kWheels> kWheelNames = {"front_left", "front_right", "rear_left", "rear_right"};

MultibodyWheelSettings ReadHungWheel(const Map& map, const DrawingReader& reader) {
  MultibodyWheelSettings wheel;
  const auto& entities = reader.drawing().entities;
  if (const auto carrier = reader.Body(map, "carrier")) {
    wheel.carrier = *carrier;
    if (!reader.drawing().bodies[static_cast<std::size_t>(*carrier)].turns)
      map.Problem("carrier", "config.wrong_kind", "a wheel's carrier must be a general body");
  }
  if (const auto centre = reader.Entity(map, "centre", map.Text("centre"), false)) {
    wheel.centre = *centre;
    if (entities[static_cast<std::size_t>(*centre)].kind != EntityKind::kPoint)
      map.Problem("centre", "config.wrong_kind", "a wheel's centre must be a point");
  }
  if (const auto axle = reader.Entity(map, "axle", map.Text("axle"), false)) {
    wheel.axle = *axle;
    const auto& entity = entities[static_cast<std::size_t>(*axle)];
    if (entity.kind != EntityKind::kVector || entity.at.y() < 0.8)
      map.Problem("axle", "config.wrong_kind", "a wheel's axle must be a vector that is drawn to the left");
  }
  if (const auto suspension = reader.LoadNamed(map, "suspension")) wheel.suspension = *suspension;
  if (const auto travel = reader.Entity(map, "travel", map.Text("travel"), true)) wheel.travel = *travel;
  return wheel;
}

MultibodySteeringSettings ReadMultibodySteering(const Map& map, const DrawingReader& reader) {
  MultibodySteeringSettings steering;
  if (const auto angle = reader.Entity(map, "angle", map.Text("angle"), true)) steering.angle = *angle;
  steering.ratio = map.Number("ratio", {1.0, 50.0});
  steering.limit_rad = map.Number("wheel_limit_rad", {0.1, 50.0});
  steering.column_Nmprad = map.Number("column_Nmprad", {1.0, 1e6});
  steering.column_Nmsprad = map.Number("column_Nmsprad", {0.0, 1e5});
  return steering;
}

double Mean(const MultibodySettings& car, std::size_t a, std::size_t b, int component) {
  const auto& entities = car.mechanism.entities;
  return 0.5 * (entities[static_cast<std::size_t>(car.wheels[a].centre)].at[component] +
                entities[static_cast<std::size_t>(car.wheels[b].centre)].at[component]);
}

VehicleDimensions ReadMultibodyDimensions(const Map& map, const MultibodySettings& car) {
  const auto& entities = car.mechanism.entities;
  const auto track = [&](std::size_t left, std::size_t right) {
    return entities[static_cast<std::size_t>(car.wheels[left].centre)].at.y() -
           entities[static_cast<std::size_t>(car.wheels[right].centre)].at.y();
  };
  VehicleDimensions dimensions;
  dimensions.wheelbase_m = Mean(car, kFrontLeft, kFrontRight, 0) - Mean(car, kRearLeft, kRearRight, 0);
  dimensions.track_front_m = track(kFrontLeft, kFrontRight);
  dimensions.track_rear_m = track(kRearLeft, kRearRight);
  dimensions.front_m = map.Number("front_m", Range::Positive());
  dimensions.rear_m = map.Number("rear_m", Range::Positive());
  dimensions.width_m = map.Number("width_m", Range::Positive());
  dimensions.height_m = map.Number("height_m", Range::Positive());
  dimensions.wheel_radius_m = car.wheel.radius_m;
  dimensions.wheel_width_m = car.wheel.width_m;
  dimensions.mass_kg = car.mass_kg;
  dimensions.steering_ratio = car.steering.ratio;
  dimensions.steering_wheel_limit_rad = car.steering.limit_rad;
  dimensions.forward_gears = static_cast<int>(car.powertrain.gearbox.forward.size());
  return dimensions;
}

}  // namespace

MultibodySettings ReadMultibody(const Map& root) {
  MultibodySettings car;
  const Map mechanism = root.Child("mechanism");
  const DrawingReader reader(mechanism);
  mechanism.IgnoreKey("outputs");  // MultibodyModel::ReadOutputs
  const Map body = root.Child("body");
  if (const auto chassis = reader.Body(body, "chassis")) {
    car.chassis = *chassis;
    if (!reader.drawing().bodies[static_cast<std::size_t>(*chassis)].turns)
      body.Problem("chassis", "config.wrong_kind", "the chassis must be a general body");
  }
  car.drag_area_m2 = body.Number("drag_area_m2", Range::NotNegative());
  car.air_density_kgpm3 = body.Number("air_density_kgpm3", {0.0, 3.0}, car.air_density_kgpm3);
  car.drag_point_m.z() = body.Number("drag_height_m", {0.0, 5.0});
  car.longest_substep_s = root.Number("longest_substep_s", {1e-5, 0.01}, car.longest_substep_s);
  const Map wheels = root.Child("wheels");
  for (std::size_t i = 0; i < kWheels; ++i) car.wheels[i] = ReadHungWheel(wheels.Child(kWheelNames[i]), reader);
  car.steering = ReadMultibodySteering(root.Child("steering"), reader);
  const Map tyre = root.Child("tyre");
  car.tyre = {ReadTyre(tyre.Child("front")), ReadTyre(tyre.Child("rear"))};
  car.wheel = ReadWheel(root.Child("wheel"));
  for (TyreSettings& each : car.tyre)
    if (each.aligning && each.aligning->unloaded_radius == 0.0) each.aligning->unloaded_radius = car.wheel.radius_m;
  car.tyre_damping_Nspm = tyre.Number("vertical_damping_Nspm", {0.0, 1e5}, 0.0);
  car.brakes = ReadBrakes(root.Child("brakes"));
  car.assists = ReadAssists(root, car.brakes);
  car.powertrain = ReadPowertrain(root);
  car.front_driven = root.Choice("driven_axle", {"front", "rear"}) != "rear";
  car.mechanism = reader.drawing();
  for (const auto& part : car.mechanism.bodies) car.mass_kg += part.mass_kg;
  if (!car.mechanism.entities.empty()) car.dimensions = ReadMultibodyDimensions(root.Child("dimensions"), car);
  return car;
}

}  // namespace rodeira::dynamics
