// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/road/world.hpp"

namespace rodeira::road {

// The world from above as SVG: shaded heights, contour lines, roads with their kilometres, the start. North is up.
std::string PlotWorld(const World& world);

}  // namespace rodeira::road
