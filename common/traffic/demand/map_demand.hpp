// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/traffic/demand/demand_settings.hpp"
#include "common/world/traffic_map/heights.hpp"

namespace rodeira::traffic {

// The vehicles that a traffic map's companion wants on its start lanes (`flows_vehph`), as flows: Poisson, no vehicle
// has a route. `file` is the companion's, for what is wrong with it.
DemandSettings DemandOf(const traffic_map::Heights& companion, const std::filesystem::path& file);

}  // namespace rodeira::traffic
