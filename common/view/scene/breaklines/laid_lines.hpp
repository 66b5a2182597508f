// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/view/scene/breaklines/road_lines.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

// A piece of a road's surface that is another one, in the road's coordinates: patches and bumps of world files.
bool IsLaid(const network::Object& object);

// Adds the lines around such pieces of a road, and within a bump as many lines along and across as its height needs, by
// SUELO.
void AddLaidLines(const road::World& world, const network::Road& road, const Tolerance& tolerance,
                  std::vector<Line3>& lines);

// Puts points into the lines of a road along which measured surfaces lie, and of ways through junctions, where SUELO's
// height is off them by more than the tolerance.
void MeetMeasured(const road::World& world, const network::Road& road, const Tolerance& tolerance,
                  std::vector<Line3>& lines);

}  // namespace rodeira::scene
