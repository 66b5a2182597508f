// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/traffic_map/open_drive.hpp"

namespace rodeira::traffic_map {

// The map as a world of this project: `path`, FILE.yaml, is a world file that names FILE.xodr, its roads as OpenDRIVE
// beside it; the latter alone is written where `path` ends so. `description` stands in the world file. Each file is
// whole or not there. Wrong input where the map cannot be written as OpenDRIVE, or FILE.xodr is there without FILE.yaml
// and so is not this world's; failed where a file cannot be written.
base::Result<OpenDrive> WriteWorld(const LaneMap& map, const std::filesystem::path& path,
                                   const std::string& description);

}  // namespace rodeira::traffic_map
