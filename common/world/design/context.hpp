// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/core/ground/ground.hpp"
#include "common/world/terrain/ground_move.hpp"

namespace rodeira::design {

// What a lane is made of.
struct Material {
  ground::Surface surface = ground::Surface::kAsphalt;
  double friction = 1.0;
  std::string texture;                                   // a picture's file; empty: the surface's usual look
  double texture_width_m = 0.0, texture_height_m = 0.0;  // of the picture on the ground
};

// What the parts of a world file refer to.
struct Context {
  bool left_hand = false;                        // vehicles keep to the left
  std::map<std::string, Material> materials;     // the surfaces by their names, and the file's own
  std::map<std::string, config::Map> templates;  // by name: the mapping that has it
  terrain::GroundMove move;                      // of places of the elevation file's map; often empty
  std::vector<std::string> warnings;
  std::vector<base::Error> missing;  // pictures: wrong, but the world can be driven without them

  // The material that the key names. An unknown name is a problem of the map's file; the default comes instead.
  const Material& MaterialOf(const config::DeclaredMap& map, std::string_view key,
                             std::string_view default_value) const;
};

// The materials that are the surfaces themselves, with their friction.
std::map<std::string, Material> UsualMaterials(const std::array<double, 7>& friction);
// Reads 'materials', of the keys MaterialKeys each.
void ReadMaterials(const config::DeclaredMap& file, Context& context);
// The cross-sections that the program knows: rural, bypass, motorway.
config::Map UsualTemplates();

}  // namespace rodeira::design
