// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/road/world.hpp"

namespace rodeira::road {

// Each road along its length as SVG: heights of axis and terrain, grade, curvature (to the left upward, with the radii
// of its arcs), slope across to both sides. Empty where the world has no road.
std::string PlotProfiles(const World& world);

}  // namespace rodeira::road
