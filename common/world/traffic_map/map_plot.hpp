// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic_map {

// The map from above as SVG, north up: lanes with their numbers and directions (start lanes green, end lanes red),
// borders by their type, STOP lines. What lies higher is drawn over what lies lower.
std::string PlotMap(const LaneMap& map);

}  // namespace rodeira::traffic_map
