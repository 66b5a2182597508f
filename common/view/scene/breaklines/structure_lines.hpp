// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/world/road/road_edge.hpp"

namespace rodeira::scene {

// Adds the lines across a road where its bridges and tunnels, and decks that are found, begin and end: on the one side
// of them ground lies under or over the road, on the other side it does not.
void AddStructureLines(const network::Road& road, std::span<const road::Stretch> decks, std::vector<Line3>& lines);

}  // namespace rodeira::scene
