// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/design/road_fit.hpp"
#include "common/world/network/props.hpp"

namespace rodeira::design {

// Reads 'objects' of a world file, which stand at no road, into `props`. An object without terrain under it is a
// problem.
void ReadProps(const config::DeclaredMap& file, const TerrainIsAt& terrain_is_at, const terrain::GroundMove& move,
               network::Props& props);

}  // namespace rodeira::design
