// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::road {

// The roads of a world file as OpenDRIVE (1.7, or 1.8 where a cross-section needs it): the axis, grades, lanes with
// their shoulders and verges, cross-section, speed limits, materials with friction, marks, measured surfaces. Made
// roughness stands in the data of users, which this program reads again. What OpenDRIVE cannot say stays behind:
// terrain, blend, the length of dashes along a line beside the axis (they follow s). Measured surfaces are named by
// their whole paths. Wrong input where there is no road, or where the world is an OpenDRIVE file already.
base::Result<std::string> ExportOpenDrive(const World& world);

// The same as a file, with copies of the measured surfaces beside it (MeasuredFiles), which it names.
base::Status WriteOpenDrive(const World& world, const std::filesystem::path& file);

}  // namespace rodeira::road
