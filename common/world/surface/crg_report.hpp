// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/surface/crg_file.hpp"

// What stands behind `rodeira surface check`: for people.
namespace rodeira::surface {

// What the file holds: grid, reference line, heights, what is missing, borders, warnings. Lines ending in newlines.
std::string DescribeCrg(const CrgFile& file);

// The grid as SVG: its outline in plan, its heights over u and v, and along three tracks.
std::string PlotCrg(const CrgSurface& surface);

}  // namespace rodeira::surface
