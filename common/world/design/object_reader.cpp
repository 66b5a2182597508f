// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/object_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <utility>
#include <vector>

namespace rodeira::design {
namespace {

// What the program draws, with usual sizes.
struct ObjectKind {
  const char* name;
  const char* type;  // OpenDRIVE's
  double length_m, width_m, height_m;
  bool continuous;
};
constexpr std::array<ObjectKind, 8> kObjects = {{
    {"tree", "tree", 0.0, 0.0, 8.0, false},
    {"bush", "vegetation", 0.0, 0.0, 1.5, false},
    {"house", "building", 12.0, 9.0, 7.0, false},
    {"filling_station", "building", 24.0, 14.0, 6.0, false},
    {"guard_rail", "barrier", 0.0, 0.3, 0.75, true},
    {"wall", "barrier", 0.0, 0.3, 1.2, true},
    {"post", "pole", 0.0, 0.12, 1.0, false},
    {"lamp", "pole", 0.0, 0.2, 8.0, false},
}};

}  // namespace

std::vector<std::string> ObjectTypes() {
  std::vector<std::string> names;
  for (const ObjectKind& kind : kObjects) names.emplace_back(kind.name);
  return names;
}

ObjectReading ReadObjectItself(const config::DeclaredMap& item, std::string id) {
  const std::string name = item.Word("type");
  const ObjectKind* kind = &kObjects[0];
  for (const ObjectKind& known : kObjects) {
    if (name == known.name) kind = &known;
  }
  ObjectReading reading;
  reading.continuous = kind->continuous;
  network::Object& object = reading.object;
  object.id = std::move(id);
  object.type = kind->type;
  object.subtype = name;
  object.name = item.Text("name", name);
  if (const auto model = item.MapWith("model").OptionalPath("model")) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(*model, problem))
      item.map().Problem("model", "file.not_found", fmt::format("there is no model file '{}'", model->string()));
    object.name = std::filesystem::absolute(*model).string();  // not to be looked for from where the program stands
  }
  object.length_m = item.Number("length_m", kind->length_m);
  object.width_m = item.Number("width_m", kind->width_m);
  object.height_m = item.Number("height_m", kind->height_m);
  if (name == "tree" || name == "bush") object.radius_m = item.Number("radius_m", 0.3 * object.height_m);
  object.z_offset_m = item.Number("z_m");
  object.orientation = "none";
  return reading;
}

}  // namespace rodeira::design
