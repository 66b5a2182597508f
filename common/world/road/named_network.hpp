// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/world/design/design_reader.hpp"
#include "common/world/road/world_reader.hpp"

namespace rodeira::road {

// Reads a world file that names an OpenDRIVE file as `network`: that file's roads, with the name and the friction of
// `said`. The car starts as `start` of the world file says, in a pose or on a lane of a road; without it, as if the
// OpenDRIVE file were opened by itself.
WorldReading ReadNamedNetwork(const config::File& file, const std::filesystem::path& network_file, WorldSpec said,
                              const design::StartSpec& start_spec);

}  // namespace rodeira::road
