// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/core/config/declared.hpp"
#include "common/world/road/world_spec.hpp"

namespace rodeira::road {

// Reads 'texture' of 'terrain' or 'ground': {file, kind, repeat_m | west_m, south_m, east_m, north_m}. A picture that
// is not there, or is none, goes to `missing`: the world can be driven without it. Nothing where the key is not there.
std::optional<terrain::LaidPicture> ReadGroundPicture(const config::DeclaredMap& ground,
                                                      std::vector<base::Error>& missing);
// A draped picture without a place covers the whole terrain.
void SpreadPicture(WorldSpec& spec);

}  // namespace rodeira::road
