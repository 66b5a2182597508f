// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"
#include "common/world/road/world_spec.hpp"

// Worlds that are traffic maps.
namespace rodeira::road {

// By its name: `.motors`.
bool IsTrafficMap(const std::filesystem::path& file);

// A world of the map's lanes, each of them one whole road (traffic_map::LoadNetwork, with the heights, lights and signs
// beside it), with the start of StartOn. Its hash is that of the bytes of both files. Wrong input: the first error of
// the map or of its companion.
base::Result<WorldSpec> ReadMapWorld(const std::filesystem::path& file);

}  // namespace rodeira::road
