// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/world/traffic_map/check.hpp"
#include "common/world/traffic_map/map_file.hpp"

namespace rodeira::traffic_map {

// A table for people: what the map holds, and how many errors and warnings were found.
std::string DescribeMap(const MapFile& map, const Heights& heights, const std::vector<Finding>& findings);

}  // namespace rodeira::traffic_map
