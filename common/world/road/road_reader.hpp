// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/config.hpp"
#include "common/core/ground/ground.hpp"
#include "common/world/road/road.hpp"

namespace rodeira::road {

// One road of a world file. What is wrong is added to the map's file as problems; where there are any, the spec must
// not be built into a Road.
RoadSpec ReadRoad(const config::Map& map);

// One of the surfaces that a person may name (asphalt, concrete, gravel, grass, soil).
ground::Surface ReadSurface(const config::Map& map, std::string_view key, ground::Surface default_value);

}  // namespace rodeira::road
