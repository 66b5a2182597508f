#pragma once

#include <string>

#include "common/base/result.hpp"
#include "common/road/world.hpp"

namespace rodeira::road {

// The roads of a world file as OpenDRIVE 1.7: the axis, grades, lanes with their shoulders and verges, cross-section
// (as shape), speed limits, materials with friction, marks. What OpenDRIVE cannot say stays behind: terrain, blend, the
// length of dashes along a line beside the axis (they follow s). Wrong input where there is no road, or where the
// world is an OpenDRIVE file already.
base::Result<std::string> ExportOpenDrive(const World& world);

}  // namespace rodeira::road
