// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/context.hpp"

#include <fmt/format.h>

#include "common/core/base/assert.hpp"
#include "common/core/base/suggest.hpp"
#include "common/world/terrain/picture_file.hpp"

namespace rodeira::design {
namespace {

using ground::Surface;

// Widths after the habits of European guidelines for these kinds of road; a motorway is one carriageway.
constexpr const char* kTemplates = R"(
rural:
  lanes: [{id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}]
  crossfall: {kind: crown, fall: 0.025}
  shoulders: {left: {width_m: 0.75, fall: 0.025}, right: {width_m: 0.75, fall: 0.025}}
  verge: {width_m: 1.5, fall: 0.08, material: grass}
  lines:
    - {lane: 0, kind: dashed, stroke_m: 4, gap_m: 8, width_m: 0.12}
    - {lane: -1, kind: continuous, width_m: 0.12}
    - {lane: 1, kind: continuous, width_m: 0.12}
bypass:
  lanes: [{id: -2, width_m: 3.5}, {id: -1, width_m: 3.5}, {id: 1, width_m: 3.5}]
  crossfall: {kind: crown, fall: 0.025}
  shoulders: {left: {width_m: 1.5, fall: 0.025}, right: {width_m: 1.5, fall: 0.025}}
  verge: {width_m: 1.5, fall: 0.08, material: grass}
  lines:
    - {lane: 0, kind: mixed, left: continuous, right: dashed, stroke_m: 4, gap_m: 8, width_m: 0.12, apart_m: 0.14}
    - {lane: -1, kind: dashed, stroke_m: 4, gap_m: 8, width_m: 0.12}
    - {lane: -2, kind: continuous, width_m: 0.15}
    - {lane: 1, kind: continuous, width_m: 0.15}
motorway:
  lanes: [{id: -2, width_m: 3.75}, {id: -1, width_m: 3.75}]
  crossfall: {kind: right, fall: 0.025}
  shoulders: {left: {width_m: 1.0, fall: -0.025}, right: {width_m: 3.0, fall: 0.025}}
  verge: {width_m: 1.5, fall: 0.08, material: grass}
  lines:
    - {lane: 0, kind: continuous, width_m: 0.15}
    - {lane: -1, kind: dashed, stroke_m: 6, gap_m: 12, width_m: 0.15}
    - {lane: -2, kind: continuous, width_m: 0.3}
)";

const std::vector<Surface> kSurfaces = {Surface::kAsphalt, Surface::kConcrete, Surface::kGravel, Surface::kGrass,
                                        Surface::kSoil};

}  // namespace

const Material& Context::MaterialOf(const config::DeclaredMap& map, std::string_view key,
                                    std::string_view default_value) const {
  std::vector<std::string> names;
  for (const auto& [name, material] : materials) names.push_back(name);
  const auto found = materials.find(map.MapWith(key).Choice(key, names, default_value));
  return found == materials.end() ? materials.find("asphalt")->second : found->second;
}

std::map<std::string, Material> UsualMaterials(const std::array<double, 7>& friction) {
  std::map<std::string, Material> materials;
  for (const Surface surface : kSurfaces) {
    materials[std::string(SurfaceName(surface))] = {surface, friction[static_cast<std::size_t>(surface)], {}};
  }
  return materials;
}

void ReadMaterials(const config::DeclaredMap& file, Context& context) {
  for (const auto& [name, keys] : file.Named("materials")) {
    const config::Map& item = keys.map();
    Material material = context.MaterialOf(keys, "surface", "asphalt");
    material.friction = keys.Number("friction", material.friction);
    if (const auto texture = keys.MapWith("texture").OptionalPath("texture")) {
      const auto facts = terrain::LookAtPicture(*texture);
      if (!facts) context.missing.push_back(facts.error().WithContext(item.Place("texture")));
      material.texture = std::filesystem::absolute(*texture).string();
      material.texture_width_m = keys.Number("texture_m");
      material.texture_height_m = facts ? material.texture_width_m * facts.value().height_px / facts.value().width_px
                                        : material.texture_width_m;
    } else if (item.Has("texture_m")) {
      item.Problem("texture_m", "config.conflicting_keys",
                   "'texture_m' says how wide a 'texture' lies on the ground; there is none");
    }
    context.materials[name] = material;
  }
}

config::Map UsualTemplates() {
  const auto file =
      config::File::Parse(kTemplates, "templates of the program");  // each reader its own: it notes what is asked
  RODEIRA_ASSERT(file.ok());
  return file.value().root();
}

}  // namespace rodeira::design
