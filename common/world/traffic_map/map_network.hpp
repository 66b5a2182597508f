// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"
#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic_map {

// The map as a network of roads: what ToOpenDrive writes with direct junctions, so that every lane is one road, read
// again.
base::Result<std::shared_ptr<const network::Network>> ToNetwork(const LaneMap& map, const std::string& name);
// Of the file and its companion with the heights. Wrong input: the first error of either.
base::Result<std::shared_ptr<const network::Network>> LoadNetwork(const std::filesystem::path& path);

}  // namespace rodeira::traffic_map
