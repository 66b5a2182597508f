// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/design/road_fit.hpp"
#include "common/world/network/standing.hpp"

namespace rodeira::design {

// 'objects' of a file: what stands at no road; added to `standing`. Where there is no terrain under it, it is a
// problem.
void ReadStanding(const config::DeclaredMap& file, const TerrainIsAt& terrain_is_at, const terrain::GroundMove& move,
                  network::Standing& standing);

}  // namespace rodeira::design
