// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/schema_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "common/analysis/measures/measures_schema.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/suggest.hpp"
#include "common/driving/driver/driver_schema.hpp"
#include "common/driving/scenario/scenario_schema.hpp"
#include "common/runtime/launch/lab_schema.hpp"
#include "common/runtime/launch/launch_schema.hpp"
#include "common/runtime/launch/manifest_schema.hpp"
#include "common/traffic/state/traffic_schema.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"
#include "common/vehicle/input_devices/keyboard_schema.hpp"
#include "common/vehicle/input_devices/wheel_schema.hpp"
#include "common/vehicle/multibody/mechanism_schema.hpp"
#include "common/world/design/design_schema.hpp"
#include "common/world/road/world_schema.hpp"
#include "common/world/traffic_map/companion_schema.hpp"

namespace rodeira::cli {
namespace {

const std::vector<const config::Schema*>& AllSchemas() {
  static const std::vector<const config::Schema*> all = {
      &driver::DriverSchema(),       &launch::LabSchema(),
      &launch::LaunchSchema(),       &measures::MeasuresSchema(),
      &multibody::MechanismSchema(), &traffic_map::CompanionSchema(),
      &launch::ManifestSchema(),     &input_devices::KeyboardSchema(),
      &scenario::ScenarioSchema(),   &traffic::TrafficSchema(),
      &dynamics::VehicleSchema(),    &dynamics::MultibodySchema(),
      &dynamics::FmuSchema(),        &dynamics::LibrarySchema(),
      &input_devices::WheelSchema(), &road::WorldSchema(),
      &design::IncludeSchema(),      &design::JunctionSchema(),
      &design::ObjectSchema(),       &design::RoadSchema(),
      &design::SectionSchema()};
  return all;
}

}  // namespace

int PrintSchema(const SchemaOptions& options) {
  if (options.kind.empty()) {
    for (const config::Schema* schema : AllSchemas()) fmt::print("{:<17} {}\n", schema->kind, schema->meaning);
    return 0;
  }
  std::vector<std::string> kinds;
  for (const config::Schema* schema : AllSchemas()) {
    kinds.push_back(schema->kind);
    if (schema->kind != options.kind) continue;
    const std::string text = options.json       ? config::SchemaJson(*schema)
                             : options.markdown ? config::SchemaMarkdown(*schema)
                                                : config::SchemaText(*schema);
    fmt::print("{}", text);
    return 0;
  }
  return base::PrintError(
      "rodeira schema",
      base::WrongInput("command.unknown_kind", fmt::format("there is no kind of file '{}'{}", options.kind,
                                                           base::DidYouMean(options.kind, kinds))));
}

}  // namespace rodeira::cli
