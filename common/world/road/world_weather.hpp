// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "common/core/base/result.hpp"
#include "common/world/weather/weather_plan.hpp"

namespace rodeira::road {

// The weather that a world file of version 2 says for runs with a scenario that says no other, as a change at the run's
// beginning; nothing where it says none, as OpenDRIVE files do. It is no part of the content hash: SUELO does not know
// it, a scenario publishes it. Wrong input where the file cannot be read.
base::Result<std::optional<weather::Change>> WeatherOf(const std::filesystem::path& world_file);

}  // namespace rodeira::road
