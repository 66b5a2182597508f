// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "common/core/base/result.hpp"
#include "common/world/network/network.hpp"
#include "common/world/traffic_map/check.hpp"
#include "common/world/traffic_map/lane_map.hpp"

namespace rodeira::traffic {

// The first lights of a traffic map that are green or amber together where their ways cross or merge
// (lanes::CheckLights), at the phase of its companion in which they are; nothing where there are none. `network` is the
// map's (traffic_map::ToNetwork).
std::optional<traffic_map::Finding> LightsTogether(const traffic_map::LaneMap& map,
                                                   const traffic_map::Heights& companion,
                                                   const network::Network& network);

// The same of a map's file and its companion: Wrong input with the companion's line.
base::Status CheckLightsOfMap(const std::filesystem::path& path);

}  // namespace rodeira::traffic
