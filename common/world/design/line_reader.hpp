// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// 'lines' of a road or of a template: what is painted along it. The road's lanes must be there already. A template's
// line at a lane that the road lacks is left out; a road's own is a problem.
void ReadLines(const config::DeclaredMap& map, bool of_template, double length_m, network::RoadSpec& spec);

}  // namespace rodeira::design
