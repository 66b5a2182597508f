// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/world/design/design_reader.hpp"
#include "common/world/road/world_reader.hpp"

namespace rodeira::road {

// A world file with an OpenDRIVE file as `network`: that file's roads under the name and with the friction that `said`
// has. The car starts where the file wishes it, in a pose or on a lane of a road; where it says nothing, where it
// starts without a world file.
WorldReading ReadNamedNetwork(const config::File& file, const std::filesystem::path& network_file, WorldSpec said,
                              const design::StartSpec& start_spec);

}  // namespace rodeira::road
