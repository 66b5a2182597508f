// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "common/world/design/junction_builder.hpp"
#include "common/world/design/road_reader.hpp"

namespace rodeira::design {

// Whether there is terrain at (x, y); without one everywhere.
using TerrainIsAt = std::function<bool(double x_m, double y_m)>;

// Whether a road at grade keeps clear of itself and within the terrain; a problem of its map names the first station
// where it does not. Every metre its outermost lanes' edges and the middle between them are looked at. It meets itself
// where one of them lies within the lanes of another stretch, less than Network::kLevel_m above or below: bridges and
// tunnels, and what `pieces` (of all roads; `index` is this one) leaves to junctions, are passed over.
void CheckFits(std::size_t index, const RoadDesign& design, const network::Road& road, std::span<const Piece> pieces,
               const TerrainIsAt& terrain_is_at);

}  // namespace rodeira::design
